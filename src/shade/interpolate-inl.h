// Perspective-correct interpolation of fragments' attributes, with analytic derivatives of the texture coordinates. T
// is Float (lanes), float or double.

#if defined(FACET_SHADE_INTERPOLATE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FACET_SHADE_INTERPOLATE_INL_H_
#undef FACET_SHADE_INTERPOLATE_INL_H_
#else
#define FACET_SHADE_INTERPOLATE_INL_H_
#endif

#include "facet/shader/lookup-inl.h"
#include "facet/shader/surface-inl.h"
#include "shade/attribute_setup.h"
#include "shade/shade_task.h"

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace HWY_NAMESPACE {

static_assert(kMaxUvSlots <= kSurfaceUvSlots);

template <class T>
struct Barycentric {
  T b[3];                // weights, >= 0, sum 1
  T inverse;             // 1 / (e_0 + e_1 + e_2)
  T db_dx[3], db_dy[3];  // per pixel
};

// The index of the setup that all fragments of a packet share, when they belong to one triangle: each of its components
// is then loaded once and broadcast.
struct UniformSetup {
  std::int32_t base;
};
template <class T>
FACET_INLINE Vec4<T> FetchVec4(const float* p, UniformSetup setup) {
  return {T(p[setup.base]), T(p[setup.base + 1]), T(p[setup.base + 2]), T(p[setup.base + 3])};
}

template <class T>
FACET_INLINE T Fetch(const float* p, UniformSetup setup) {
  return T(p[setup.base]);
}

// `base`: for each lane the index of its setup times the stride, or UniformSetup.
template <class T, class Base>
FACET_INLINE Barycentric<T> InterpolationWeights(const float* setups, Base base, T x, T y) {
  const float* planes = setups + AttributeLayout::kPlanes;
  T a[3], b[3], e[3];
  for (int i = 0; i < 3; ++i) {
    const Vec4<T> plane = FetchVec4<T>(planes + 3 * i, base);  // the fourth component is not used
    a[i] = plane.x;
    b[i] = plane.y;
    // Snapping and partial coverage can place a fragment a little outside of its triangle. Clamping moves it to the
    // edge.
    e[i] = Max((plane.z + a[i] * x) + b[i] * y, T(0.0f));
  }
  const T sum = (e[0] + e[1]) + e[2];
  const MaskOf<T> good = (sum > T(0.0f)) & IsFinite(sum);
  const T inverse = Select(good, T(1.0f) / sum, T(0.0f));
  const T sum_a = (a[0] + a[1]) + a[2], sum_b = (b[0] + b[1]) + b[2];
  Barycentric<T> w{};
  w.inverse = inverse;
  for (int i = 0; i < 3; ++i) {
    w.b[i] = Select(good, e[i] * inverse, T(i == 0 ? 1.0f : 0.0f));
    w.db_dx[i] = (a[i] - w.b[i] * sum_a) * inverse;
    w.db_dy[i] = (b[i] - w.b[i] * sum_b) * inverse;
  }
  return w;
}

template <class T>
FACET_INLINE T Weigh(const T (&weights)[3], T v0, T v1, T v2) {
  return (weights[0] * v0 + weights[1] * v1) + weights[2] * v2;
}

// Interpolates a four-component attribute whose vertices are `stride` floats apart, from setups[base + first] on.
template <class T, class Base>
FACET_INLINE Vec4<T> InterpolateVec4(const float* setups, Base base, const Barycentric<T>& w, int first, int stride) {
  const Vec4<T> p = FetchVec4<T>(setups + first, base), q = FetchVec4<T>(setups + first + stride, base),
                r = FetchVec4<T>(setups + first + 2 * stride, base);
  return {Weigh(w.b, p.x, q.x, r.x), Weigh(w.b, p.y, q.y, r.y), Weigh(w.b, p.z, q.z, r.z), Weigh(w.b, p.w, q.w, r.w)};
}

// Surface::footprint_alpha2 from the solid angle that the normal sweeps over the pixel. Reflections of a pixel come
// from normals all over a patch of that size, which half of GGX's facets are in if alpha^2 is 1 / (2 pi) of it (half
// are tilted by less than alpha). As GGX has tails beyond, which a pixel does not, less has the least error: 1/16
// (docs/accuracy.md). The geometric mean of the two ways in which a surface curves is what the solid angle gives. It
// does not blur cylinders, as the arithmetic mean would (Tokuyoshi and Kaplanyan, 2019, Improved Geometric Specular
// Antialiasing, whose bound of 0.18 this is): a lobe of one width cannot filter along one axis only.
template <class T>
FACET_INLINE T FootprintAlpha2(T normal_sweep, const Vec3<T>& normal, T inverse) {
  constexpr float kAlpha2OfSolidAngle = 1.0f / 16.0f, kMost = 0.18f;
  const T zero(0.0f), scale = inverse / Sqrt(Dot(normal, normal));
  const T alpha2 = normal_sweep * T(kAlpha2OfSolidAngle) * scale * scale * scale;
  return Select(alpha2 > zero, Min(alpha2, T(kMost)), zero);  // not a number is 0, too
}

template <class T, class Base>
FACET_INLINE void InterpolateFrom(const ShadeTask& task, Base base, T x, T y, Surface<T>& s) {
  const FrameMaterial& material = *task.material;
  const float* setups = task.setups;
  const Barycentric<T> w = InterpolationWeights(setups, base, x, y);
  s.position = s.view = s.normal = s.interpolated_normal = Vec3<T>{};
  s.tangent = Vec4<T>{};
  s.footprint_alpha2 = T(0.0f);
  s.color = {T(1.0f), T(1.0f), T(1.0f), T(1.0f)};
  if (material.vertex_colors) s.color = InterpolateVec4(setups, base, w, AttributeLayout::kColors, 4);
  if (material.Has(kLit)) {
    const Vec3<T> up{T(0.0f), T(0.0f), T(1.0f)};
    s.position = Xyz(InterpolateVec4(setups, base, w, AttributeLayout::kPositions, 3));
    s.view = task.orthographic
                 ? Vec3<T>{T(task.view_direction[0]), T(task.view_direction[1]), T(task.view_direction[2])}
                 : NormalizeOr(-s.position, up);
    const float* normals = setups + AttributeLayout::kNormals;
    const Vec4<T> p = FetchVec4<T>(normals, base), q = FetchVec4<T>(normals + 3, base),
                  r = FetchVec4<T>(normals + 6, base);
    s.interpolated_normal = {Weigh(w.b, p.x, q.x, r.x), Weigh(w.b, p.y, q.y, r.y), Weigh(w.b, p.z, q.z, r.z)};
    s.normal = NormalizeOr(s.interpolated_normal, s.view);
    const T sweep = r.w;
    static_assert(AttributeLayout::kNormalSweep == AttributeLayout::kNormals + 9);
    if (Any(sweep > T(0.0f))) s.footprint_alpha2 = FootprintAlpha2(sweep, s.interpolated_normal, w.inverse);
  }
  if (material.Has(kTangentSpaceBits)) s.tangent = InterpolateVec4(setups, base, w, AttributeLayout::kTangents, 4);
  if (material.Has(kVolume)) {
    s.metres_per_unit = Fetch<T>(setups + AttributeLayout::MetresPerUnit(material.uv_slots), base);
  }
  for (int slot = 0; slot < material.uv_slots; ++slot) {
    const float* p = setups + AttributeLayout::kTexCoords + 6 * slot;
    const Vec4<T> uv01 = FetchVec4<T>(p, base), uv12 = FetchVec4<T>(p + 2, base);
    const auto weigh = [&](const T (&weights)[3]) HWY_ATTR {
      return Vec2<T>{Weigh(weights, uv01.x, uv01.z, uv12.z), Weigh(weights, uv01.y, uv01.w, uv12.w)};
    };
    s.uv[slot] = weigh(w.b);
    s.duv_dx[slot] = weigh(w.db_dx);
    s.duv_dy[slot] = weigh(w.db_dy);
  }
}

// Interpolates the attributes that the material reads for fragment i of `task`, or for all lanes from i on. Others
// become zero, except for the vertex colour, which becomes 1, and texture coordinates and metres per unit, which are
// left unchanged.
template <class T>
FACET_INLINE void InterpolateSurface(const ShadeTask& task, std::size_t i, Surface<T>& s) {
  const T x = Load<T>(task.x + i), y = Load<T>(task.y + i);
  const std::int32_t first = task.setup[i];
  const std::int32_t stride = AttributeLayout::Stride(task.material->uv_slots);
  const IntOf<T> setup = LoadIntOf<T>(task.setup + i);
  if (All(setup == IntOf<T>(first))) return InterpolateFrom(task, UniformSetup{first * stride}, x, y, s);
  InterpolateFrom(task, setup * IntOf<T>(stride), x, y, s);
}
template <class T>
FACET_INLINE Surface<T> InterpolateSurface(const ShadeTask& task, std::size_t i) {
  Surface<T> s{};
  InterpolateSurface(task, i, s);
  return s;
}

}  // namespace HWY_NAMESPACE
}  // namespace facet
HWY_AFTER_NAMESPACE();

#endif
