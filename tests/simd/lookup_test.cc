// Reading tables on lanes, against indexing, on every instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simd/lookup_test.cc"
#include "hwy/foreach_target.h"
// Must come after foreach_target.h.
#include "facet/shader/dispatch.h"
#include "facet/shader/lookup-inl.h"

#ifndef FACET_TESTS_SIMD_LOOKUP_ONCE
#define FACET_TESTS_SIMD_LOOKUP_ONCE
namespace facet {

struct LookupTask {
  const std::int32_t* index;
  int count;                 // a multiple of 16
  const float* floats;
  const std::int32_t* ints;
  float* four;               // 4 arrays
  std::int32_t* of_16;       // of index mod 16
};

}  // namespace facet
#endif

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace HWY_NAMESPACE {

void LookupAll(const LookupTask& task) {
  const int n = task.count;
  for (int i = 0; i < n; i += static_cast<int>(LaneCount())) {
    const Int index = LoadInt(task.index + i);
    const Vec4<Float> four = FetchVec4<Float>(task.floats, index);
    Store(four.x, task.four + i);
    Store(four.y, task.four + n + i);
    Store(four.z, task.four + 2 * n + i);
    Store(four.w, task.four + 3 * n + i);
    Store(FetchOf16(task.ints, index & Int(15)), task.of_16 + i);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace facet
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace facet {
namespace {

FACET_EXPORT(LookupAll);

TEST(Lookup, ReadsWhatIndexingReads) {
  constexpr int kEntries = 1000, kCount = 256;
  std::mt19937 random(7);
  std::vector<float> floats(kEntries + 3);
  std::vector<std::int32_t> ints(16), index(kCount);
  for (float& f : floats) f = float(random());
  for (std::int32_t& k : ints) k = std::int32_t(random());
  for (std::int32_t& k : index) k = std::int32_t(random() % kEntries);
  index[3] = 0, index[18] = kEntries - 1;
  for (const Target target : {Target::Scalar, Target::Sse4, Target::Avx2, Target::Avx3, Target::Neon}) {
    if (!TargetIsAvailable(target)) continue;
    std::vector<float> four(4 * kCount);
    std::vector<std::int32_t> of_16(kCount);
    LookupAllForTarget(target)({index.data(), kCount, floats.data(), ints.data(), four.data(), of_16.data()});
    for (std::size_t i = 0; i < kCount; ++i) {
      const std::size_t k = std::size_t(index[i]);
      for (std::size_t c = 0; c < 4; ++c) ASSERT_EQ(four[c * kCount + i], floats[k + c]) << TargetName(target) << " " << i;
      ASSERT_EQ(of_16[i], ints[k & 15]) << TargetName(target) << " " << i;
    }
  }
}

}  // namespace
}  // namespace facet
#endif
