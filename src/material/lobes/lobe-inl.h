// What every lobe of a closure shares. A lobe is one way in which a surface reflects light, in a file of its own, and
// has
//   a constructor:                                   what of it depends on the view alone;
//   Vec3<T> Direct(const Incidence<T>&, ...) const;  its BRDF, in 1/steradian, for light from one direction;
//   EnvironmentTerms<T> Environment(...) const;      what it reflects of light from all around.
// The closure (material/closure-inl.h) adds up the lobes that a material has.

#if defined(FACET_MATERIAL_LOBES_LOBE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FACET_MATERIAL_LOBES_LOBE_INL_H_
#undef FACET_MATERIAL_LOBES_LOBE_INL_H_
#else
#define FACET_MATERIAL_LOBES_LOBE_INL_H_
#endif

#include "facet/shader/brdf-inl.h"
#include "facet/shader/lane-inl.h"
#include "facet/shader/vec-inl.h"

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace HWY_NAMESPACE {

// Albedos of GGX at one roughness: where Fresnel is Schlick's with F0, single scattering reflects F0 * a + b.
template <class T>
struct SpecularAlbedo {
  T a{}, b{};
};

// What single scattering loses.
template <class T>
HWY_INLINE T LostEnergy(SpecularAlbedo<T> albedo) {
  return Max(T(1.0f) - (albedo.a + albedo.b), T(0.0f));
}

// Light from one direction.
template <class T>
struct LightSample {
  Vec3<T> direction;   // unit, from the surface to the light
  Vec3<T> irradiance;  // on a surface that faces it: lux
};

// A point of a surface seen from one direction.
template <class T>
struct SurfaceView {
  Vec3<T> normal, view;  // unit; the normal is on the viewer's side
  T n_dot_v{};           // kMinNDotV or more
};

// Light from one direction on that point.
template <class T>
struct Incidence {
  Vec3<T> half;  // unit, between the view and the light
  T n_dot_l{}, v_dot_h{};
};

// Light from all around, as one lobe reflects it: what it gathers itself, and how much of the irradiance, divided by
// pi, it reflects besides. All lobes on one normal share one look at the irradiance.
template <class T>
struct EnvironmentTerms {
  Vec3<T> radiance;
  Vec3<T> of_irradiance_over_pi;
};

}  // namespace HWY_NAMESPACE
}  // namespace facet
HWY_AFTER_NAMESPACE();

#endif
