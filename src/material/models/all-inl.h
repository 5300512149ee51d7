// The functors of all shading models, and the one that a material asks for.

#if defined(FACET_MATERIAL_MODELS_ALL_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FACET_MATERIAL_MODELS_ALL_INL_H_
#undef FACET_MATERIAL_MODELS_ALL_INL_H_
#else
#define FACET_MATERIAL_MODELS_ALL_INL_H_
#endif

#include "material/models/metallic_roughness-inl.h"
#include "material/models/models.h"
#include "material/models/unlit-inl.h"

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace HWY_NAMESPACE {

// What the material shows without a shader of a user's own.
struct ModelOfMaterial {
  template <class T, class Material, class Lighting>
  HWY_INLINE Shaded<T> operator()(const Surface<T>& surface, const Material& material, const Lighting& lighting) const {
    switch (material.Model()) {
#define FACET_MODEL_CASE(Name) \
  case ShadingModel::Name: return Name()(surface, material, lighting);
      FACET_SHADING_MODELS(FACET_MODEL_CASE)
#undef FACET_MODEL_CASE
    }
    return {};
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace facet
HWY_AFTER_NAMESPACE();

#endif
