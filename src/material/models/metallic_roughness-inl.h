// glTF 2.0's metallic-roughness material as a fragment shader.

#if defined(FACET_MATERIAL_MODELS_METALLIC_ROUGHNESS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FACET_MATERIAL_MODELS_METALLIC_ROUGHNESS_INL_H_
#undef FACET_MATERIAL_MODELS_METALLIC_ROUGHNESS_INL_H_
#else
#define FACET_MATERIAL_MODELS_METALLIC_ROUGHNESS_INL_H_
#endif

#include "facet/shader/surface-inl.h"
#include "material/models/seen_through-inl.h"

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace HWY_NAMESPACE {

// A model that is lit by its closure. `kCoreOf`: the lobes of its materials that have no layers.
template <MaterialFeatures kCoreOf>
struct LitModel {
  template <class T, class Material, class Lighting>
  FACET_INLINE Shaded<T> operator()(const Surface<T>& surface, const Material& material,
                                    const Lighting& lighting) const {
    return With<kAllLobes>(surface, material, lighting);
  }

  // For materials whose lobes are all in `kPossible`.
  static constexpr MaterialFeatures kCore = kCoreOf;
  template <MaterialFeatures kPossible, class T, class Material, class Lighting>
  static FACET_INLINE Shaded<T> With(const Surface<T>& surface, const Material& material, const Lighting& lighting) {
    const MaterialInputs<T> inputs = material.template Inputs<kPossible>(surface);
    return {ShadeClosure<T, kPossible>(inputs, surface.view, surface.position, lighting), inputs.alpha_coverage};
  }

  // For materials with transmission.
  template <class T, class Material, class Lighting>
  static FACET_INLINE ShadedThrough<T> Through(const Surface<T>& surface, const Material& material,
                                               const Lighting& lighting) {
    return ShadeThrough(material.template Inputs<kAllLobes>(surface), surface, lighting);
  }
};

struct MetallicRoughness : LitModel<kCoreLobes> {};

}  // namespace HWY_NAMESPACE
}  // namespace facet
HWY_AFTER_NAMESPACE();

#endif
