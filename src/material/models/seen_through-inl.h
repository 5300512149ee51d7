// A surface that light passes through, as the blending stage needs it: its own light, and what it does to what is seen
// through it.

#if defined(FACET_MATERIAL_MODELS_SEEN_THROUGH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FACET_MATERIAL_MODELS_SEEN_THROUGH_INL_H_
#undef FACET_MATERIAL_MODELS_SEEN_THROUGH_INL_H_
#else
#define FACET_MATERIAL_MODELS_SEEN_THROUGH_INL_H_
#endif

#include "facet/shader/surface-inl.h"
#include "material/closure-inl.h"

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace HWY_NAMESPACE {

template <class T>
struct ShadedThrough {
  Shaded<T> own;
  Vec3<T> tint;  // of what is seen through the surface
  // From where the view enters the medium to where it leaves it, by channel: metres, world axes. Zero for thin walls.
  // Without dispersion all are the first.
  Vec3<T> path[3];
  T spread{};  // TransmissionLobe::Spread()
};

// Where and how sharply things are seen through the surface. `in`: of the closure.
template <class T>
FACET_INLINE void SetPaths(const Closure<T>& closure, const MaterialInputs<T>& in, ShadedThrough<T>& out) {
  const T thickness = in.volume.thickness;
  const Vec3<T>& ior = in.transmission.ior;
  out.spread = closure.transmission.Spread(thickness, ior.y);
  if ((in.lobes & kVolume) == 0) return;
  out.path[0] = RefractedPath(closure.at, ior.x, thickness);
  if ((in.lobes & kDispersion) != 0) {
    out.path[1] = RefractedPath(closure.at, ior.y, thickness);
    out.path[2] = RefractedPath(closure.at, ior.z, thickness);
  }
}

template <class T, class Lighting>
FACET_INLINE ShadedThrough<T> ShadeThrough(const MaterialInputs<T>& in, const Surface<T>& surface,
                                           const Lighting& lighting) {
  const Closure<T> closure(in, surface.view, lighting);
  ShadedThrough<T> out{};
  out.own = {ShadeClosure(closure, in, surface.position, lighting), in.alpha_coverage};
  if (!closure.Has(kTransmission)) return out;
  out.tint = closure.transmission.color;
  SetPaths(closure, in, out);
  return out;
}

}  // namespace HWY_NAMESPACE
}  // namespace facet
HWY_AFTER_NAMESPACE();

#endif
