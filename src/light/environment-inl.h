// Lookups in an EnvironmentMap. Directions are in the environment's axes; lighting-inl.h rotates them from world axes.

#if defined(FACET_LIGHT_ENVIRONMENT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FACET_LIGHT_ENVIRONMENT_INL_H_
#undef FACET_LIGHT_ENVIRONMENT_INL_H_
#else
#define FACET_LIGHT_ENVIRONMENT_INL_H_
#endif

#include "facet/shader/elementary-inl.h"
#include "light/environment.h"
#include "light/octahedron-inl.h"

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace HWY_NAMESPACE {

// The radiance reflected along `direction` by a surface of this roughness, interpolated between the two nearest levels.
template <class T>
FACET_INLINE Vec3<T> PrefilteredRadiance(const EnvironmentMap& map, Vec3<T> direction, T perceptual_roughness) {
  const float last = static_cast<float>(EnvironmentMap::kLevels - 1);
  const TablePosition<T> at = PositionInTable(perceptual_roughness * T(last), last);
  const Vec2<T> uv = OctahedronFromDirection(direction);
  const auto level = [&](IntOf<T> k) HWY_ATTR {
    const T size = Fetch<T>(map.level_size, k);
    const IntOf<T> row = TruncateToInt(size + T(1.0f)) * IntOf<T>(4);
    return SampleOctahedron<T>(map.texel_data, size, row, FetchInt(map.level_offset, k), uv);
  };
  return Mix(level(at.index), level(at.index + IntOf<T>(1)), at.fraction);
}

// The roughness at which the mixture of two levels is as wide as the lobe of `perceptual_roughness`, by the mean square
// of their alphas. It is lower, because mixtures are wider than what lies between: halfway from a mirror to the first
// rough level half of that level's square is in the mixture, and a sixteenth in the lobe.
template <class T>
FACET_INLINE T RoughnessOfMixture(T perceptual_roughness) {
  constexpr float kLast = static_cast<float>(EnvironmentMap::kLevels - 1);
  const auto fourth = [](T x) HWY_ATTR { return (x * x) * (x * x); };
  const T at = perceptual_roughness * T(kLast), level = Floor(at), first = fourth(level);
  return (level + (fourth(at) - first) / (fourth(level + T(1.0f)) - first)) * T(1.0f / kLast);
}

// Irradiance on a surface facing `normal`, divided by pi.
template <class T>
FACET_INLINE Vec3<T> IrradianceOverPi(const EnvironmentMap& map, Vec3<T> normal) {
  const std::int32_t size = map.irradiance.size;
  return SampleOctahedron<T>(map.texel_data, T(static_cast<float>(size)), IntOf<T>((size + 1) * 4),
                             IntOf<T>(map.irradiance.offset), OctahedronFromDirection(normal));
}

// Bilinear lookup in an equirectangular image of 4-float pixels. `direction`: of any length but 0.
template <class T>
FACET_INLINE Vec3<T> SampleEquirectangular(const float* image, std::int32_t width, std::int32_t height,
                                           Vec3<T> direction) {
  const T length = Sqrt(Dot(direction, direction));
  const T y_unit = Clamp(direction.y / Max(length, T(1e-30f)), T(-1.0f), T(1.0f));
  const T w = T(static_cast<float>(width));
  const T h = T(static_cast<float>(height));
  const T u = T(0.5f) + Atan2(direction.z, direction.x) * T(0.159154943091895336f);
  const T v = Acos(y_unit) * T(0.318309886183790672f);
  const T x = Clamp(u * w - T(0.5f), T(-0.5f), w);
  const T y = Clamp(v * h - T(0.5f), T(0.0f), h - T(1.0f));
  const T x_floor = Floor(x);
  const T y0 = Min(Floor(y), h - T(2.0f));  // images have at least two rows
  const T fx = x - x_floor;
  const T fy = y - y0;
  const T x0 = Select(x_floor < T(0.0f), w - T(1.0f), Select(x_floor >= w, x_floor - w, x_floor));
  const T x_next = x0 + T(1.0f);
  const T x1 = Select(x_next >= w, T(0.0f), x_next);
  const IntOf<T> four = 4;
  const IntOf<T> row = IntOf<T>(width * 4);
  const IntOf<T> top = TruncateToInt(y0) * row;
  const IntOf<T> i00 = top + TruncateToInt(x0) * four;
  const IntOf<T> i10 = top + TruncateToInt(x1) * four;
  const T left = T(1.0f) - fx, above = T(1.0f) - fy;
  return WeighFour<T>(image, {i00, i10, i00 + row, i10 + row}, {left * above, fx * above, left * fy, fx * fy});
}

// The environment as it is visible in a direction: from the image if that was kept, otherwise from level 0.
template <class T>
FACET_INLINE Vec3<T> SharpRadiance(const EnvironmentMap& map, Vec3<T> direction) {
  if (map.image_data != nullptr) {
    return SampleEquirectangular(map.image_data, map.image_width, map.image_height, direction);
  }
  return PrefilteredRadiance(map, direction, T(0.0f));
}

}  // namespace HWY_NAMESPACE
}  // namespace facet
HWY_AFTER_NAMESPACE();

#endif
