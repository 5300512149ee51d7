// Diffuse transmission (KHR_materials_diffuse_transmission): light from behind the surface that leaves it in all
// directions, in place of a share of the diffuse reflection. It crosses the interface as the diffuse reflection does,
// with the same shares left by specular reflection on both sides.

#if defined(FACET_MATERIAL_LOBES_DIFFUSE_TRANSMISSION_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FACET_MATERIAL_LOBES_DIFFUSE_TRANSMISSION_INL_H_
#undef FACET_MATERIAL_LOBES_DIFFUSE_TRANSMISSION_INL_H_
#else
#define FACET_MATERIAL_LOBES_DIFFUSE_TRANSMISSION_INL_H_
#endif

#include "material/lobes/diffuse-inl.h"

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace HWY_NAMESPACE {

template <class T>
struct DiffuseTransmissionInputs {
  T factor{};     // [0, 1]
  Vec3<T> color{};  // of the light that passes, [0, 1]
};

template <class T>
struct DiffuseTransmissionLobe {
  Vec3<T> color;  // (1 - metallic) * factor * colour

  FACET_INLINE DiffuseTransmissionLobe() {}  // for a lobe that a material does not have

  // Takes its share from the diffuse reflection.
  FACET_INLINE DiffuseTransmissionLobe(const DiffuseTransmissionInputs<T>& in, T metallic, DiffuseLobe<T>& diffuse) {
    const T factor = Clamp(in.factor, T(0.0f), T(1.0f));
    color = in.color * (factor * (T(1.0f) - metallic));
    diffuse.color = diffuse.color * (T(1.0f) - factor);
  }

  // The BTDF times the cosine, for light from behind. `behind`: the cosine of the light with the normal that points
  // away from the viewer. `albedo_at`: of a cosine, the specular lobe's albedo for the light's direction.
  template <class AlbedoAt>
  FACET_INLINE Vec3<T> Direct(const DiffuseLobe<T>& diffuse, const SpecularLobe<T>& above, T behind,
                              const AlbedoAt& albedo_at) const {
    const T cosine = Clamp(behind, T(0.0f), T(1.0f));
    const T left_for_light = above.EnergyLeftByDielectric(albedo_at(cosine));
    return color * (diffuse.left_for_view * left_for_light * diffuse.scale * cosine);
  }

  template <class Lighting>
  FACET_INLINE Vec3<T> Environment(const SurfaceView<T>& at, const DiffuseLobe<T>& diffuse,
                                   const Lighting& lighting) const {
    return color * diffuse.left_for_view * lighting.IrradianceOverPi(-at.normal);
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace facet
HWY_AFTER_NAMESPACE();

#endif
