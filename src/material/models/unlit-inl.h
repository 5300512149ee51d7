// The unlit model: shows the base colour as it is (KHR_materials_unlit). It is also used for points and lines without
// normals, which show their emission as well (glTF 2.0 specification, 3.9.6).

#if defined(FACET_MATERIAL_MODELS_UNLIT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FACET_MATERIAL_MODELS_UNLIT_INL_H_
#undef FACET_MATERIAL_MODELS_UNLIT_INL_H_
#else
#define FACET_MATERIAL_MODELS_UNLIT_INL_H_
#endif

#include "facet/shader/surface-inl.h"

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace HWY_NAMESPACE {

struct Unlit {
  template <class T, class Material, class Lighting>
  FACET_INLINE Shaded<T> operator()(const Surface<T>& surface, const Material& material,
                                    const Lighting& lighting) const {
    return With<kCore>(surface, material, lighting);
  }

  static constexpr MaterialFeatures kCore = 0;
  template <MaterialFeatures, class T, class Material, class Lighting>
  static FACET_INLINE Shaded<T> With(const Surface<T>& surface, const Material& material, const Lighting&) {
    const Vec4<T> color = material.BaseColor(surface);
    return {material.Emits() ? Xyz(color) + material.Emissive(surface) : Xyz(color), color.w};
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace facet
HWY_AFTER_NAMESPACE();

#endif
