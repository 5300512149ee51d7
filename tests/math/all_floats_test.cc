#include "math/all_floats.h"

#include <gtest/gtest.h>

#include "facet/shader/dispatch.h"
#include "math/elementary_lanes.h"

namespace facet::testing {
namespace {

// Recorded once; equal with every compiler, instruction set and processor. `float_checksums 4099` prints them.
constexpr std::uint64_t kEvery4099th[kOneArgumentFunctionCount] = {
    0x194a2a6e70efa933, 0xd1fc36ffbef703e6, 0xc5b67e44a47e9acd, 0x2f279453a91878f4, 0xb721584e421fa85d,
    0x33a3de5ab7b0824b, 0x4070b889cac40866, 0x8fb5e01d8ab71497, 0x6664e13f9d6c2116};

TEST(AllFloats, EveryTargetHasTheRecordedBits) {
  for (Target target : {Target::Scalar, Target::Sse4, Target::Avx2, Target::Avx3, Target::Neon}) {
    if (!TargetIsAvailable(target)) continue;
    const ScopedTarget scoped(target);
    for (int function = 0; function < kOneArgumentFunctionCount; ++function) {
      EXPECT_EQ(ChecksumOverFloats(function, 4099), kEvery4099th[function])
          << kLaneFunctionNames[static_cast<std::size_t>(function)] << " on " << TargetName(target);
    }
  }
}

}  // namespace
}  // namespace facet::testing
