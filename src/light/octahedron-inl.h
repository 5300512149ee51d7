// Octahedral maps: the mapping from directions to the unit square and back, and bilinear lookup. environment.h
// describes the layout.

#if defined(FACET_LIGHT_OCTAHEDRON_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FACET_LIGHT_OCTAHEDRON_INL_H_
#undef FACET_LIGHT_OCTAHEDRON_INL_H_
#else
#define FACET_LIGHT_OCTAHEDRON_INL_H_
#endif

#include "facet/shader/lookup-inl.h"
#include "facet/shader/vec-inl.h"

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace HWY_NAMESPACE {

// Maps a direction of any length to [0, 1]^2. Zero is mapped to the centre.
template <class T>
FACET_INLINE Vec2<T> OctahedronFromDirection(Vec3<T> d) {
  const T norm = Abs(d.x) + Abs(d.y) + Abs(d.z);
  const T scale = T(1.0f) / Max(norm, T(1e-30f));
  const T x = d.x * scale;
  const T z = d.z * scale;
  const auto below = d.y < T(0.0f);
  const T folded_x = CopySign(T(1.0f) - Abs(z), d.x);
  const T folded_z = CopySign(T(1.0f) - Abs(x), d.z);
  return {Select(below, folded_x, x) * T(0.5f) + T(0.5f), Select(below, folded_z, z) * T(0.5f) + T(0.5f)};
}

// The inverse mapping; returns a unit vector.
template <class T>
FACET_INLINE Vec3<T> DirectionFromOctahedron(Vec2<T> uv) {
  const T x = uv.x * T(2.0f) - T(1.0f);
  const T z = uv.y * T(2.0f) - T(1.0f);
  const T y = T(1.0f) - Abs(x) - Abs(z);
  const auto below = y < T(0.0f);
  const Vec3<T> d = {Select(below, (T(1.0f) - Abs(z)) * CopySign(T(1.0f), x), x), y,
                     Select(below, (T(1.0f) - Abs(x)) * CopySign(T(1.0f), z), z)};
  return d * (T(1.0f) / Sqrt(Dot(d, d)));
}

// Interpolates between the four texels around column x and row y, both in [0, last + 1]. A texel has four floats; `row`
// is the distance between rows and `offset` the index of the first texel, both in floats. `last`, `row` and `offset`
// may differ between lanes.
template <class T>
FACET_INLINE Vec3<T> SampleTexels(const float* texels, T x, T y, T last, IntOf<T> row, IntOf<T> offset) {
  const T x0 = Min(Floor(x), last);
  const T y0 = Min(Floor(y), last);
  const T fx = x - x0;
  const T fy = y - y0;
  const IntOf<T> i00 = offset + TruncateToInt(y0) * row + TruncateToInt(x0) * IntOf<T>(4);
  const IntOf<T> i01 = i00 + row;
  const IntOf<T> four = 4;
  const T left = T(1.0f) - fx, top = T(1.0f) - fy;
  return WeighFour<T>(texels, {i00, i00 + four, i01, i01 + four}, {left * top, fx * top, left * fy, fx * fy});
}

// Looks up a map of `size` x `size` cells with texels at the nodes, at uv in [0, 1]^2.
template <class T>
FACET_INLINE Vec3<T> SampleOctahedron(const float* texels, T size, IntOf<T> row, IntOf<T> offset, Vec2<T> uv) {
  return SampleTexels<T>(texels, Clamp(uv.x * size, T(0.0f), size), Clamp(uv.y * size, T(0.0f), size),
                         size - T(1.0f), row, offset);
}

}  // namespace HWY_NAMESPACE
}  // namespace facet
HWY_AFTER_NAMESPACE();

#endif
