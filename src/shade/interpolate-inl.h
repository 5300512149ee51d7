// Attributes of a packet of fragments, perspective-correct, with analytic derivatives of the texture coordinates.

#if defined(FACET_SHADE_INTERPOLATE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FACET_SHADE_INTERPOLATE_INL_H_
#undef FACET_SHADE_INTERPOLATE_INL_H_
#else
#define FACET_SHADE_INTERPOLATE_INL_H_
#endif

#include "facet/shader/surface-inl.h"
#include "shade/shade_task.h"
#include "shade/triangle_setup.h"

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace HWY_NAMESPACE {

struct Barycentric {
  Float b[3];             // weights, >= 0, sum 1
  Float db_dx[3], db_dy[3];  // per pixel
};

// `base`: index of each lane's setup times its stride.
HWY_INLINE Barycentric InterpolationWeights(const float* setups, Int base, Float x, Float y) {
  const float* planes = setups + SetupLayout::kPlanes;
  Float a[3], b[3], e[3];
  for (int i = 0; i < 3; ++i) {
    a[i] = Gather(planes + 3 * i, base);
    b[i] = Gather(planes + 3 * i + 1, base);
    // Snapping and partly covered pixels put fragments a little outside their triangle; clamped, they read its edge.
    e[i] = Max((Gather(planes + 3 * i + 2, base) + a[i] * x) + b[i] * y, Float(0.0f));
  }
  const Float sum = (e[0] + e[1]) + e[2];
  const Mask good = (sum > Float(0.0f)) & IsFinite(sum);
  const Float inverse = Select(good, Float(1.0f) / sum, Float(0.0f));
  const Float sum_a = (a[0] + a[1]) + a[2], sum_b = (b[0] + b[1]) + b[2];
  Barycentric w;
  for (int i = 0; i < 3; ++i) {
    w.b[i] = Select(good, e[i] * inverse, Float(i == 0 ? 1.0f : 0.0f));
    w.db_dx[i] = (a[i] - w.b[i] * sum_a) * inverse;
    w.db_dy[i] = (b[i] - w.b[i] * sum_b) * inverse;
  }
  return w;
}

HWY_INLINE Float Weigh(const Float (&weights)[3], Float v0, Float v1, Float v2) {
  return (weights[0] * v0 + weights[1] * v1) + weights[2] * v2;
}

// A number of each vertex, `stride` apart, at setups[base + first].
HWY_INLINE Float InterpolateOne(const float* setups, Int base, const Barycentric& w, int first, int stride) {
  return Weigh(w.b, Gather(setups + first, base), Gather(setups + first + stride, base),
               Gather(setups + first + 2 * stride, base));
}

HWY_INLINE Vec3<Float> InterpolateVec3(const float* setups, Int base, const Barycentric& w, int first, int stride) {
  return {InterpolateOne(setups, base, w, first, stride), InterpolateOne(setups, base, w, first + 1, stride),
          InterpolateOne(setups, base, w, first + 2, stride)};
}

// The surface under fragments [i, i + lanes) of `task`: only what its material reads.
HWY_INLINE Surface<Float> InterpolateSurface(const ShadeTask& task, std::size_t i) {
  const FrameMaterial& material = *task.material;
  const float* setups = task.setups;
  const Int base = LoadInt(task.setup + i) * Int(SetupLayout::kStride);
  const Barycentric w = InterpolationWeights(setups, base, LoadFloat(task.x + i), LoadFloat(task.y + i));
  Surface<Float> s{};
  s.color = {Float(1.0f), Float(1.0f), Float(1.0f), Float(1.0f)};
  if (material.vertex_colors) {
    const Vec3<Float> rgb = InterpolateVec3(setups, base, w, SetupLayout::kColors, 4);
    s.color = {rgb.x, rgb.y, rgb.z, InterpolateOne(setups, base, w, SetupLayout::kColors + 3, 4)};
  }
  if (material.Has(kLit)) {
    const Vec3<Float> up{Float(0.0f), Float(0.0f), Float(1.0f)};
    s.position = InterpolateVec3(setups, base, w, SetupLayout::kPositions, 3);
    s.view = task.orthographic ? Vec3<Float>{Float(task.view_direction[0]), Float(task.view_direction[1]),
                                             Float(task.view_direction[2])}
                               : NormalizeOr(-s.position, up);
    s.interpolated_normal = InterpolateVec3(setups, base, w, SetupLayout::kNormals, 3);
    s.normal = NormalizeOr(s.interpolated_normal, s.view);
  }
  if (material.Has(kNormalTexture)) {
    const Vec3<Float> t = InterpolateVec3(setups, base, w, SetupLayout::kTangents, 4);
    s.tangent = {t.x, t.y, t.z, InterpolateOne(setups, base, w, SetupLayout::kTangents + 3, 4)};
  }
  for (int slot = 0; slot < material.uv_slots; ++slot) {
    const float* p = setups + SetupLayout::kTexCoords + 6 * slot;
    const Float u0 = Gather(p, base), v0 = Gather(p + 1, base), u1 = Gather(p + 2, base), v1 = Gather(p + 3, base),
                u2 = Gather(p + 4, base), v2 = Gather(p + 5, base);
    s.uv[slot] = {Weigh(w.b, u0, u1, u2), Weigh(w.b, v0, v1, v2)};
    s.duv_dx[slot] = {Weigh(w.db_dx, u0, u1, u2), Weigh(w.db_dx, v0, v1, v2)};
    s.duv_dy[slot] = {Weigh(w.db_dy, u0, u1, u2), Weigh(w.db_dy, v0, v1, v2)};
  }
  return s;
}

}  // namespace HWY_NAMESPACE
}  // namespace facet
HWY_AFTER_NAMESPACE();

#endif
