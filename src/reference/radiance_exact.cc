#include "reference/radiance_exact.h"

#include <optional>
#include <vector>

#include "light/lighting-inl.h"
#include "material/models/all-inl.h"
#include "reference/exact_source-inl.h"
#include "reference/lighting_exact-inl.h"
#include "reference/sampling_exact-inl.h"

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace {

using ExactClosure = lanes::Closure<double>;

// Ways to choose a direction, besides by the environment's light: one for each lobe that has a shape of its own.
struct Techniques {
  explicit Techniques(const ExactClosure& c) : diffuse(FromLanes(c.at.normal)) {
    const glm::dvec3 normal = FromLanes(c.at.normal), view = FromLanes(c.at.view);
    if (c.Has(kAnisotropy)) {
      const Frame axes(FromLanes(c.anisotropic.tangent), FromLanes(c.anisotropic.bitangent), normal);
      specular.emplace(axes, view, c.anisotropic.alpha_t, c.anisotropic.alpha_b);
    } else {
      specular.emplace(Frame(normal), view, c.microfacets.alpha, c.microfacets.alpha);
    }
    if (c.Has(kDiffuseTransmission)) behind.emplace(-normal);
    if (c.Has(kClearcoat)) {
      clearcoat.emplace(Frame(FromLanes(c.clearcoat.at.normal)), view, c.clearcoat.microfacets.alpha,
                        c.clearcoat.microfacets.alpha);
    }
  }

  // Calls visit(technique) for each that there is, in the order in which they take random numbers.
  template <class Visit>
  void ForEach(const Visit& visit) const {
    visit(*specular);
    visit(diffuse);
    if (behind) visit(*behind);
    if (clearcoat) visit(*clearcoat);
  }

  std::optional<VisibleNormals> specular, clearcoat;
  Cosine diffuse;
  std::optional<Cosine> behind;
};

// The same for the models that are not glTF's.
struct TechniquesOfShapes {
  // Of lobes that are equally wide in all directions, or not.
  struct Add {
    std::vector<VisibleNormals>& to;
    glm::dvec3 view;
    void operator()(const lanes::Vec3<double>& normal, double alpha) const {
      to.emplace_back(Frame(FromLanes(normal)), view, alpha, alpha);
    }
    void operator()(const lanes::Vec3<double>& tangent, const lanes::Vec3<double>& bitangent,
                    const lanes::Vec3<double>& normal, double alpha_t, double alpha_b) const {
      to.emplace_back(Frame(FromLanes(tangent), FromLanes(bitangent), FromLanes(normal)), view, alpha_t, alpha_b);
    }
  };

  template <class Scattering>
  explicit TechniquesOfShapes(const Scattering& s) : diffuse(FromLanes(s.normal)) {
    s.ForEachShape(Add{specular, FromLanes(s.view)});
    if (s.TransmitsDiffusely()) behind.emplace(-FromLanes(s.normal));
  }

  template <class Visit>
  void ForEach(const Visit& visit) const {
    for (const VisibleNormals& lobe : specular) visit(lobe);
    visit(diffuse);
    if (behind) visit(*behind);
  }

  std::vector<VisibleNormals> specular;
  Cosine diffuse;
  std::optional<Cosine> behind;
};

// The environment's light times scattered(direction), integrated over all directions.
template <class Techniques, class Scattered>
glm::dvec3 ScatteredEnvironment(const Techniques& techniques, const Scattered& scattered, const ExactLight& light,
                                const SampleRun& run) {
  const ExactEnvironment& environment = *light.environment;
  glm::dvec3 sum(0.0);
  const auto add = [&](const ExactEnvironment::Light& from) {
    double density = from.density;
    techniques.ForEach([&](const auto& technique) { density += technique.Density(from.direction); });
    if (density > 0.0) sum += FromLanes(scattered(ToLanes(from.direction))) * from.radiance / density;
  };
  for (std::uint32_t k = 0; k < light.environment_samples; ++k) {
    std::uint32_t pair = run.pair;
    const auto random = [&] { return run.sequence.Point(pair++, run.index + k); };
    add(environment.Sample(random()));
    techniques.ForEach([&](const auto& technique) { add(environment.Toward(technique.Sample(random()))); });
  }
  return sum / double(light.environment_samples);
}

}  // namespace

glm::dvec3 RadianceTowardEye(const ExactMaterial& material, const glm::dvec3& base_color, const SurfacePoint& point,
                             const ExactLight& light, const SampleRun& run) {
  const ExactSource source{material, point};
  auto in = lanes::ReadInputs<double>(source, ToLanes(glm::dvec4(base_color, 1.0)), material.Frame().features);
  if (material.Frame().model == ShadingModel::SpecularGlossiness) lanes::SetSpecularGlossiness(source, in);
  const ExactLighting lighting(light.albedos);
  const ExactClosure closure(in, ToLanes(point.view), lighting);

  glm::dvec3 radiance = FromLanes(lanes::EmissionThroughLayers(closure, in));
  for (const PunctualLight& punctual : light.punctual) {
    const auto sample = lanes::SamplePunctual(punctual, ToLanes(point.position));
    radiance += FromLanes(lanes::EvaluateClosure(closure, sample.direction, lighting) * sample.irradiance);
  }
  if (light.environment != nullptr && !light.environment->IsBlack()) {
    const auto scattered = [&](const lanes::Vec3<double>& direction) {
      return lanes::EvaluateClosure(closure, direction, lighting);
    };
    radiance += ScatteredEnvironment(Techniques(closure), scattered, light, run) * in.occlusion;
  }
  return radiance;
}

namespace {

template <class Model>
glm::dvec3 RadianceOfModel(const ExactMaterial& material, const glm::dvec3& base_color, const SurfacePoint& point,
                           const ExactLight& light, const SampleRun& run) {
  const ExactSource source{material, point};
  const ExactLighting lighting(light.albedos);
  // Models may reflect otherwise where they are covered by a part only.
  const double coverage = source.Has(kAlphaBlend) ? material.BaseColor(point).w : 1.0;
  const auto scattering =
      Model::template Make<double>(source, ToLanes(glm::dvec4(base_color, coverage)), ToLanes(point.view), lighting);

  glm::dvec3 radiance = FromLanes(scattering.Emission());
  for (const PunctualLight& punctual : light.punctual) {
    const auto sample = lanes::SamplePunctual(punctual, ToLanes(point.position));
    radiance += FromLanes(scattering.Direct(sample.direction, lighting) * sample.irradiance);
  }
  if (light.environment != nullptr && !light.environment->IsBlack()) {
    const auto scattered = [&](const lanes::Vec3<double>& direction) {
      return scattering.FromEnvironment(direction, lighting);
    };
    radiance += ScatteredEnvironment(TechniquesOfShapes(scattering), scattered, light, run);
  }
  return FromLanes(lanes::FinishOwn(scattering, ToLanes(radiance)).color);
}

}  // namespace

glm::dvec3 RadianceOfOwnModel(const ExactMaterial& material, const glm::dvec3& base_color, const SurfacePoint& point,
                              const ExactLight& light, const SampleRun& run) {
  switch (material.Frame().model) {
#define FACET_MODEL_CASE(Name) \
  case ShadingModel::Name: return RadianceOfModel<lanes::Name>(material, base_color, point, light, run);
    FACET_OWN_MODELS(FACET_MODEL_CASE)
#undef FACET_MODEL_CASE
    default: return glm::dvec3(0.0);
  }
}

}  // namespace facet
HWY_AFTER_NAMESPACE();
