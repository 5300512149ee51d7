// glTF 2.0's material as a fragment shader.

#if defined(FACET_SHADE_METALLIC_ROUGHNESS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FACET_SHADE_METALLIC_ROUGHNESS_INL_H_
#undef FACET_SHADE_METALLIC_ROUGHNESS_INL_H_
#else
#define FACET_SHADE_METALLIC_ROUGHNESS_INL_H_
#endif

#include "light/lighting-inl.h"
#include "shade/material_view-inl.h"

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace HWY_NAMESPACE {

struct MetallicRoughness {
  template <class T>
  HWY_INLINE Shaded<T> operator()(const Surface<T>& surface, const MaterialView<T>& material,
                                  const LightingView<T>& lighting) const {
    if (!material.Lit()) {
      const Vec4<T> color = material.BaseColor(surface);
      return {material.Emits() ? Xyz(color) + material.Emissive(surface) : Xyz(color), color.w};
    }
    const MaterialInputs<T> inputs = material.Inputs(surface);
    return {ShadeMetallicRoughness(inputs, surface.view, surface.position, lighting), inputs.alpha_coverage};
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace facet
HWY_AFTER_NAMESPACE();

#endif
