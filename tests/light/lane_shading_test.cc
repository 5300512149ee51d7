// The whole closure, lit by everything, on lanes: the bits of plain floats, on every instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "light/lane_shading_test.cc"
#include "hwy/foreach_target.h"

#include "facet/shader/dispatch.h"
#include "light/lighting-inl.h"
#include "material/closure-inl.h"

#ifndef FACET_TESTS_LANE_SHADING_ONCE
#define FACET_TESTS_LANE_SHADING_ONCE
namespace facet {

constexpr int kShadingComponents = 18;  // inputs of a fragment
struct ShadingTask {
  const LightingData* lighting;
  const float* in;  // kShadingComponents arrays of `count`
  int count;        // a multiple of 64
  bool anisotropic;
  bool lanes;       // else float by float
  float* out;       // 3 arrays of `count`
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
FACET_INLINE void ShadeOne(const ShadingTask& task, int first) {
  const auto number = [&](int i) HWY_ATTR { return LoadAs(task.in + i * task.count + first, T()); };
  const auto vector = [&](int i) HWY_ATTR { return Vec3<T>{number(i), number(i + 1), number(i + 2)}; };
  MaterialInputs<T> in{};
  in.base_color = vector(0);
  in.metallic = number(3);
  in.perceptual_roughness = number(4);
  in.occlusion = number(5);
  in.emissive = vector(6);
  in.normal = vector(9);
  const Vec3<T> tangent = NormalizeOr(Cross(in.normal, vector(15)), vector(12));
  in.anisotropy = {tangent, Cross(in.normal, tangent), number(6)};
  if (task.anisotropic) in.lobes |= kAnisotropy;
  const Vec3<T> out = ShadeClosure(in, vector(12), vector(15), LightingView<T>(*task.lighting));
  StoreAs(out.x, task.out + first);
  StoreAs(out.y, task.out + task.count + first);
  StoreAs(out.z, task.out + 2 * task.count + first);
}

void ShadeAll(const ShadingTask& task) {
  if (task.lanes) {
    for (int i = 0; i < task.count; i += static_cast<int>(LaneCount())) ShadeOne<Float>(task, i);
  } else {
    for (int i = 0; i < task.count; ++i) ShadeOne<float>(task, i);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace facet
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>
#include <vector>

#include "light/studio.h"

namespace facet {
namespace {

FACET_EXPORT(ShadeAll);

std::vector<float> RandomFragments(int count) {
  std::mt19937 random(5);
  const auto uniform = [&] { return float(random() >> 8) / 16777216.0f; };
  std::vector<float> in(std::size_t(kShadingComponents) * std::size_t(count));
  for (int i = 0; i < count; ++i) {
    const auto at = [&](int k) -> float& { return in[std::size_t(k) * count + i]; };
    const auto unit = [&](int k) {
      const float z = 2.0f * uniform() - 1.0f, angle = 6.2831853f * uniform(), s = std::sqrt(1.0f - z * z);
      at(k) = s * std::cos(angle);
      at(k + 1) = s * std::sin(angle);
      at(k + 2) = z;
    };
    for (int k = 0; k < 9; ++k) at(k) = uniform();
    if (i % 7 == 0) at(4) = 0.0f;
    if (i % 5 == 0) at(3) = 1.0f;
    unit(9);
    unit(12);
    for (int k = 15; k < 18; ++k) at(k) = 6.0f * uniform() - 3.0f;
  }
  return in;
}

TEST(LaneShading, HasTheBitsOfFloatsOnEveryInstructionSet) {
  std::vector<PunctualLight> lights(3);
  lights[0].type = LightType::Directional;
  lights[1].position_eye[1] = 2.0f;
  lights[1].inverse_range2 = 0.02f;
  lights[2].type = LightType::Spot;
  lights[2].spot_scale = 4.0f;
  lights[2].spot_offset = -2.0f;
  for (PunctualLight& light : lights) light.intensity[0] = light.intensity[1] = light.intensity[2] = 3.0f;
  const auto studio = StudioEnvironment();
  const LightingData lighting = MakeLightingData(lights, studio.get(), 1.0, 1.5, {.anisotropic_dfg = true});
  constexpr int kCount = 4096;
  const std::vector<float> in = RandomFragments(kCount);
  std::vector<float> expected(3 * kCount), out(3 * kCount);
  for (bool anisotropic : {false, true}) {
    ShadeAllForTarget(Target::Scalar)({&lighting, in.data(), kCount, anisotropic, false, expected.data()});
    for (float value : expected) ASSERT_TRUE(std::isfinite(value) && value >= 0.0f);
    for (Target target : {Target::Scalar, Target::Sse4, Target::Avx2, Target::Avx3, Target::Neon}) {
      if (!TargetIsAvailable(target)) continue;
      for (bool use_lanes : {false, true}) {
        std::fill(out.begin(), out.end(), -1.0f);
        ShadeAllForTarget(target)({&lighting, in.data(), kCount, anisotropic, use_lanes, out.data()});
        EXPECT_EQ(std::memcmp(out.data(), expected.data(), out.size() * sizeof(float)), 0)
            << TargetName(target) << (use_lanes ? " lanes" : " floats") << (anisotropic ? ", anisotropic" : "");
      }
    }
  }
}

}  // namespace
}  // namespace facet
#endif
