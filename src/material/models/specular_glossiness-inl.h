// The specular-glossiness material of older files (KHR_materials_pbrSpecularGlossiness): a dielectric whose F0 is a
// colour, with glossiness = 1 - roughness. Its diffuse colour is the base colour. The text multiplies it by 1 -
// max(F0); here it gets what the specular reflection leaves at each angle, which is that and loses no energy.

#if defined(FACET_MATERIAL_MODELS_SPECULAR_GLOSSINESS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FACET_MATERIAL_MODELS_SPECULAR_GLOSSINESS_INL_H_
#undef FACET_MATERIAL_MODELS_SPECULAR_GLOSSINESS_INL_H_
#else
#define FACET_MATERIAL_MODELS_SPECULAR_GLOSSINESS_INL_H_
#endif

#include "facet/shader/surface-inl.h"
#include "material/models/seen_through-inl.h"

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace HWY_NAMESPACE {

struct SpecularGlossiness {
  template <class T, class Material, class Lighting>
  HWY_INLINE Shaded<T> operator()(const Surface<T>& surface, const Material& material, const Lighting& lighting) const {
    return With<kAllLobes>(surface, material, lighting);
  }

  // For materials whose lobes are all in `kPossible`.
  static constexpr MaterialFeatures kCore = kCoreLobes | kIor;
  template <MaterialFeatures kPossible, class T, class Material, class Lighting>
  static HWY_INLINE Shaded<T> With(const Surface<T>& surface, const Material& material, const Lighting& lighting) {
    const MaterialInputs<T> inputs = material.template Inputs<kPossible>(surface);
    return {ShadeClosure<T, kPossible>(inputs, surface.view, surface.position, lighting), inputs.alpha_coverage};
  }

  // For materials with transmission.
  template <class T, class Material, class Lighting>
  static HWY_INLINE ShadedThrough<T> Through(const Surface<T>& surface, T metres_per_unit, const Material& material,
                                             const Lighting& lighting) {
    return ShadeThrough(material.template Inputs<kAllLobes>(surface), surface, metres_per_unit, lighting);
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace facet
HWY_AFTER_NAMESPACE();

#endif
