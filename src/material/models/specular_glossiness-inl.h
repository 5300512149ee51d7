// The specular-glossiness material of older files (KHR_materials_pbrSpecularGlossiness): a dielectric whose F0 is a
// colour, with glossiness = 1 - roughness. Its diffuse colour is the base colour. The text multiplies it by 1 -
// max(F0); here it gets what the specular reflection leaves at each angle, which is that and loses no energy.

#if defined(FACET_MATERIAL_MODELS_SPECULAR_GLOSSINESS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FACET_MATERIAL_MODELS_SPECULAR_GLOSSINESS_INL_H_
#undef FACET_MATERIAL_MODELS_SPECULAR_GLOSSINESS_INL_H_
#else
#define FACET_MATERIAL_MODELS_SPECULAR_GLOSSINESS_INL_H_
#endif

#include "material/models/metallic_roughness-inl.h"

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace HWY_NAMESPACE {

struct SpecularGlossiness : LitModel<kCoreLobes | kIor> {};

}  // namespace HWY_NAMESPACE
}  // namespace facet
HWY_AFTER_NAMESPACE();

#endif
