// The model "lecture" on lanes: the bits of plain floats, on every instruction set, whatever is chosen.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "material/lecture_lanes_test.cc"
#include "hwy/foreach_target.h"

#include "facet/shader/dispatch.h"
#include "light/lighting-inl.h"
#include "material/models/lecture-inl.h"

#ifndef FACET_TESTS_LECTURE_LANES_ONCE
#define FACET_TESTS_LECTURE_LANES_ONCE
namespace facet {

constexpr int kLectureComponents = 12;  // of a fragment: its colour, its normal, the view and the light
struct LectureTask {
  const LightingData* lighting;
  const LectureParameters* parameters;
  const float* in;  // kLectureComponents arrays of `count`
  int count;        // a multiple of 64
  bool lanes;       // else float by float
  float* out;       // 6 arrays of `count`
};

}  // namespace facet
#endif

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace HWY_NAMESPACE {

template <class T>
struct UntexturedSource {
  const LectureParameters& parameters;
  Vec3<T> normal;

  FACET_INLINE bool Has(MaterialFeatures) const { return false; }
  template <class Block>
  FACET_INLINE const Block& Parameters() const {
    return parameters;
  }
  template <int kChannels>
  FACET_INLINE Vec4<T> Read(Slot) const {
    return {T(1.0f), T(1.0f), T(1.0f), T(1.0f)};
  }
  FACET_INLINE Vec3<T> Normal() const { return normal; }
  FACET_INLINE Vec3<T> InterpolatedNormal() const { return normal; }
  FACET_INLINE Vec4<T> Tangent() const { return {T(1.0f), T(0.0f), T(0.0f), T(1.0f)}; }
};

FACET_INLINE float LoadAs(const float* p, float) { return *p; }
FACET_INLINE Float LoadAs(const float* p, Float) { return LoadFloat(p); }
FACET_INLINE void StoreAs(float value, float* p) { *p = value; }
FACET_INLINE void StoreAs(Float value, float* p) { Store(value, p); }

template <class T>
FACET_INLINE void ShadeLectureOne(const LectureTask& task, int first) {
  const auto vector = [&](int i) HWY_ATTR {
    const auto number = [&](int k) HWY_ATTR { return LoadAs(task.in + k * task.count + first, T()); };
    return Vec3<T>{number(i), number(i + 1), number(i + 2)};
  };
  const Vec3<T> color = vector(0);
  const UntexturedSource<T> source{*task.parameters, vector(3)};
  const LightingView<T> lighting(*task.lighting);
  const auto s = Lecture::Make<T>(source, Vec4<T>{color.x, color.y, color.z, T(1.0f)}, vector(6), lighting);
  const Vec3<T> direct = s.Direct(vector(9), lighting), image = s.Environment(lighting);
  const T results[6] = {direct.x, direct.y, direct.z, image.x, image.y, image.z};
  for (int k = 0; k < 6; ++k) StoreAs(results[k], task.out + k * task.count + first);
}

void ShadeLectureAll(const LectureTask& task) {
  if (task.lanes) {
    for (int i = 0; i < task.count; i += static_cast<int>(LaneCount())) ShadeLectureOne<Float>(task, i);
  } else {
    for (int i = 0; i < task.count; ++i) ShadeLectureOne<float>(task, i);
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
#include <utility>
#include <vector>

#include "light/studio.h"

namespace facet {
namespace {

FACET_EXPORT(ShadeLectureAll);

std::vector<float> RandomFragments(int count) {
  std::mt19937 random(7);
  const auto uniform = [&] { return float(random() >> 8) / 16777216.0f; };
  std::vector<float> in(std::size_t(kLectureComponents) * std::size_t(count));
  for (int i = 0; i < count; ++i) {
    const auto at = [&](int k) -> float& { return in[std::size_t(k) * std::size_t(count) + std::size_t(i)]; };
    for (int k = 0; k < 3; ++k) at(k) = uniform();
    for (int k = 3; k < kLectureComponents; k += 3) {
      const float z = 2.0f * uniform() - 1.0f, angle = 6.2831853f * uniform(), s = std::sqrt(1.0f - z * z);
      at(k) = s * std::cos(angle);
      at(k + 1) = s * std::sin(angle);
      at(k + 2) = z;
    }
    if (i % 3 == 0) {  // a mirrored light: the middle of the highlight
      float dot = 0.0f;
      for (int k = 0; k < 3; ++k) dot += at(3 + k) * at(6 + k);
      for (int k = 0; k < 3; ++k) at(9 + k) = 2.0f * dot * at(3 + k) - at(6 + k);
    }
  }
  return in;
}

TEST(LectureLanes, HaveTheBitsOfFloatsOnEveryInstructionSet) {
  const auto studio = StudioEnvironment();
  const LightingData lighting = MakeLightingData({}, studio.get(), 1.0, 1.5, {.schlick_dfg = {true, true}});
  constexpr int kCount = 256;
  const std::vector<float> in = RandomFragments(kCount);
  std::vector<float> expected(6 * kCount), out(6 * kCount);
  LectureParameters p;
  p.metalness.value = 0.4f;
  for (int choice = 0; choice < 3 * 4 * 2 * 2 * 2 * 2; ++choice) {
    int rest = choice;
    const auto next = [&](int count) { return std::exchange(rest, rest / count) % count; };
    p.specular = static_cast<LectureSpecular>(next(3));
    p.distribution = static_cast<LectureDistribution>(next(4));
    p.geometry = static_cast<LectureGeometry>(next(2));
    p.fresnel = static_cast<LectureFresnel>(next(2));
    p.alpha = static_cast<LectureAlpha>(next(2));
    p.workflow = static_cast<LectureWorkflow>(next(2));
    for (const float roughness : {0.0f, 0.3f, 1.0f}) {
      p.roughness.value = roughness;
      p.glossiness.value = 1.0f - roughness;
      ShadeLectureAllForTarget(Target::Scalar)({&lighting, &p, in.data(), kCount, false, expected.data()});
      for (float value : expected) ASSERT_TRUE(std::isfinite(value) && value >= 0.0f) << choice;
      for (Target target : {Target::Scalar, Target::Sse4, Target::Avx2, Target::Avx3, Target::Neon}) {
        if (!TargetIsAvailable(target)) continue;
        for (bool use_lanes : {false, true}) {
          std::fill(out.begin(), out.end(), -1.0f);
          ShadeLectureAllForTarget(target)({&lighting, &p, in.data(), kCount, use_lanes, out.data()});
          ASSERT_EQ(std::memcmp(out.data(), expected.data(), out.size() * sizeof(float)), 0)
              << TargetName(target) << (use_lanes ? " lanes" : " floats") << ", choice " << choice;
        }
      }
    }
  }
}

}  // namespace
}  // namespace facet
#endif
