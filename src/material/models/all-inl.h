// The functors of all shading models, and the choice of the one that a material has.

#if defined(FACET_MATERIAL_MODELS_ALL_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FACET_MATERIAL_MODELS_ALL_INL_H_
#undef FACET_MATERIAL_MODELS_ALL_INL_H_
#else
#define FACET_MATERIAL_MODELS_ALL_INL_H_
#endif

#include "material/models/enterprise-inl.h"
#include "material/models/filament-inl.h"
#include "material/models/lecture-inl.h"
#include "material/models/metallic_roughness-inl.h"
#include "material/models/models.h"
#include "material/models/specular_glossiness-inl.h"
#include "material/models/unlit-inl.h"

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace HWY_NAMESPACE {

// Shades by the material's own model, as long as no user's shader replaces it.
struct ModelOfMaterial {
  template <class T, class Material, class Lighting>
  FACET_INLINE Shaded<T> operator()(const Surface<T>& surface, const Material& material,
                                    const Lighting& lighting) const {
    switch (material.Model()) {
#define FACET_MODEL_CASE(Name) \
  case ShadingModel::Name: return Name()(surface, material, lighting);
      FACET_SHADING_MODELS(FACET_MODEL_CASE)
#undef FACET_MODEL_CASE
    }
    return {};
  }
};

// A model, for materials whose lobes are all in `kPossible`.
template <class Model, MaterialFeatures kPossible>
struct ModelWith {
  template <class T, class Material, class Lighting>
  FACET_INLINE Shaded<T> operator()(const Surface<T>& surface, const Material& material,
                                    const Lighting& lighting) const {
    return Model::template With<kPossible>(surface, material, lighting);
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace facet
HWY_AFTER_NAMESPACE();

#endif
