#include "reference/models_exact.h"

#include "material/models/models.h"
#include "reference/exact_source-inl.h"

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace {

glm::dvec3 MetallicRoughness(const ExactMaterial& material, const glm::dvec3& base_color, const SurfacePoint& point,
                             const ExactLight& light, const SampleRun& run) {
  return RadianceTowardEye(material, base_color, point, light, run);
}

constexpr auto SpecularGlossiness = MetallicRoughness;  // they differ in how the material is read

constexpr auto Lecture = RadianceOfOwnModel, Filament = RadianceOfOwnModel, Enterprise = RadianceOfOwnModel;

glm::dvec3 Unlit(const ExactMaterial& material, const glm::dvec3& base_color, const SurfacePoint& point,
                 const ExactLight&, const SampleRun&) {
  const ExactSource source{material, point};
  return source.Has(kEmission) ? base_color + FromLanes(lanes::ReadEmission<double>(source)) : base_color;
}

}  // namespace

glm::dvec3 RadianceByModel(const ExactMaterial& material, const glm::dvec3& base_color, const SurfacePoint& point,
                           const ExactLight& light, const SampleRun& run) {
  switch (material.Frame().model) {
#define FACET_MODEL_CASE(Name) \
  case ShadingModel::Name: return Name(material, base_color, point, light, run);
    FACET_SHADING_MODELS(FACET_MODEL_CASE)
#undef FACET_MODEL_CASE
  }
  return glm::dvec3(0.0);
}

}  // namespace facet
HWY_AFTER_NAMESPACE();
