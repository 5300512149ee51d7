// What all lobes of a closure share. A lobe is one way in which a surface reflects light. Each has a file of its own
// and these members:
//   a constructor:                                   computes what depends on the view only;
//   Vec3<T> Direct(const Incidence<T>&, ...) const;  its BRDF, in 1/steradian, for light from one direction;
//   EnvironmentTerms<T> Environment(...) const;      its reflection of the environment.
// The closure (material/closure-inl.h) sums the lobes that a material has.

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

// The albedo of GGX at one roughness: with Schlick's Fresnel of F0, single scattering reflects F0 * a + b.
template <class T>
struct SpecularAlbedo {
  T a{}, b{};
};

// The energy that single scattering loses.
template <class T>
FACET_INLINE T LostEnergy(SpecularAlbedo<T> albedo) {
  return Max(T(1.0f) - (albedo.a + albedo.b), T(0.0f));
}

// Light from one direction.
template <class T>
struct LightSample {
  Vec3<T> direction;   // unit, from the surface to the light
  Vec3<T> irradiance;  // on a surface that faces the light: lux
};

// A point of a surface seen from one direction.
template <class T>
struct SurfaceView {
  Vec3<T> normal, view;  // unit; the normal is on the viewer's side
  T n_dot_v{};           // kMinNDotV or more
};

// Light from one direction that arrives at that point.
template <class T>
struct Incidence {
  Vec3<T> half;  // unit, between the view and the light
  T n_dot_l{}, v_dot_h{};
};

template <class T>
FACET_INLINE Incidence<T> IncidenceFrom(const SurfaceView<T>& at, const Vec3<T>& light) {
  Incidence<T> from{};
  from.n_dot_l = Clamp(Dot(at.normal, light), T(0.0f), T(1.0f));
  from.half = NormalizeOr(at.view + light, at.normal);
  from.v_dot_h = Clamp(Dot(at.view, from.half), T(0.0f), T(1.0f));
  return from;
}

// The reflection of the environment by one lobe: radiance that it looks up itself, and the factor of irradiance / pi
// that it reflects in addition. The closure looks up the irradiance once for all lobes.
template <class T>
struct EnvironmentTerms {
  Vec3<T> radiance;
  Vec3<T> of_irradiance_over_pi;
};

}  // namespace HWY_NAMESPACE
}  // namespace facet
HWY_AFTER_NAMESPACE();

#endif
