// The sheen lobe on lanes: the bits of plain floats, on every instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "light/lane_sheen_test.cc"
#include "hwy/foreach_target.h"

#include "facet/shader/dispatch.h"
#include "light/lighting-inl.h"
#include "material/lobes/sheen-inl.h"

#ifndef FACET_TESTS_LANE_SHEEN_ONCE
#define FACET_TESTS_LANE_SHEEN_ONCE
namespace facet {

constexpr int kSheenInputs = 13, kSheenOutputs = 7;  // of a fragment
struct SheenTask {
  const LightingData* lighting;
  const float* in;  // kSheenInputs arrays of `count`
  int count;        // a multiple of 64
  bool lanes;       // else float by float
  float* out;       // kSheenOutputs arrays of `count`
};

}  // namespace facet
#endif

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace HWY_NAMESPACE {

FACET_INLINE float LoadAs(const float* p, float) { return *p; }
FACET_INLINE Float LoadAs(const float* p, Float) { return LoadFloat(p); }
FACET_INLINE void StoreAs(float value, float* p) { *p = value; }
FACET_INLINE void StoreAs(Float value, float* p) { Store(value, p); }

template <class T>
FACET_INLINE void ReflectOne(const SheenTask& task, int first) {
  const auto number = [&](int i) HWY_ATTR { return LoadAs(task.in + i * task.count + first, T()); };
  const auto vector = [&](int i) HWY_ATTR { return Vec3<T>{number(i), number(i + 1), number(i + 2)}; };
  const auto write = [&](int i, T value) HWY_ATTR { StoreAs(value, task.out + i * task.count + first); };
  const LightingView<T> lighting(*task.lighting);
  const Vec3<T> normal = vector(4), view = vector(7), light = vector(10);
  const SurfaceView<T> at{normal, view, Clamp(Dot(normal, view), T(kMinNDotV), T(1.0f))};
  const SheenLobe<T> lobe(at, {vector(0), number(3)}, lighting);
  Incidence<T> from{};
  from.n_dot_l = Clamp(Dot(normal, light), T(0.0f), T(1.0f));
  from.half = NormalizeOr(view + light, normal);
  from.v_dot_h = Clamp(Dot(view, from.half), T(0.0f), T(1.0f));
  const Vec3<T> direct = lobe.Direct(at, from), environment = lobe.Environment(at, lighting).radiance;
  write(0, direct.x);
  write(1, direct.y);
  write(2, direct.z);
  write(3, environment.x);
  write(4, environment.y);
  write(5, environment.z);
  write(6, lobe.EnergyLeft());
}

void ReflectAll(const SheenTask& task) {
  if (task.lanes) {
    for (int i = 0; i < task.count; i += static_cast<int>(LaneCount())) ReflectOne<Float>(task, i);
  } else {
    for (int i = 0; i < task.count; ++i) ReflectOne<float>(task, i);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace facet
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>
#include <vector>

#include "light/studio.h"

namespace facet {
namespace {

FACET_EXPORT(ReflectAll);

std::vector<float> RandomSheen(int count) {
  std::mt19937 random(9);
  const auto uniform = [&] { return float(random() >> 8) / 16777216.0f; };
  std::vector<float> in(std::size_t(kSheenInputs) * std::size_t(count));
  for (int i = 0; i < count; ++i) {
    const auto at = [&](int k) -> float& { return in[std::size_t(k) * std::size_t(count) + std::size_t(i)]; };
    for (int k = 0; k < 4; ++k) at(k) = uniform();
    if (i % 7 == 0) at(3) = 0.0f;
    for (int k = 4; k < kSheenInputs; k += 3) {
      const float z = 2.0f * uniform() - 1.0f, angle = 6.2831853f * uniform(), s = std::sqrt(1.0f - z * z);
      at(k) = s * std::cos(angle);
      at(k + 1) = s * std::sin(angle);
      at(k + 2) = z;
    }
  }
  return in;
}

TEST(LaneSheen, HasTheBitsOfFloatsOnEveryInstructionSet) {
  const auto studio = StudioEnvironment();
  const LightingData lighting = MakeLightingData({}, studio.get(), 1.0, 1.5, {.sheen = true});
  constexpr int kCount = 4096;
  const std::vector<float> in = RandomSheen(kCount);
  std::vector<float> expected(kSheenOutputs * kCount), out(kSheenOutputs * kCount);
  ReflectAllForTarget(Target::Scalar)({&lighting, in.data(), kCount, false, expected.data()});
  for (float value : expected) ASSERT_TRUE(std::isfinite(value) && value >= 0.0f);
  for (Target target : {Target::Scalar, Target::Sse4, Target::Avx2, Target::Avx3, Target::Neon}) {
    if (!TargetIsAvailable(target)) continue;
    for (bool use_lanes : {false, true}) {
      std::fill(out.begin(), out.end(), -1.0f);
      ReflectAllForTarget(target)({&lighting, in.data(), kCount, use_lanes, out.data()});
      EXPECT_EQ(std::memcmp(out.data(), expected.data(), out.size() * sizeof(float)), 0)
          << TargetName(target) << (use_lanes ? " lanes" : " floats");
    }
  }
}

}  // namespace
}  // namespace facet
#endif
