#include "reference/radiance_exact.h"

#include <optional>

#include "light/lighting-inl.h"
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

glm::dvec3 ScatteredEnvironment(const ExactClosure& closure, const ExactLighting& lighting, const ExactLight& light,
                                const SampleRun& run) {
  const ExactEnvironment& environment = *light.environment;
  const Techniques techniques(closure);
  glm::dvec3 sum(0.0);
  const auto add = [&](const ExactEnvironment::Light& from) {
    double density = from.density;
    techniques.ForEach([&](const auto& technique) { density += technique.Density(from.direction); });
    const auto scattered = lanes::EvaluateClosure(closure, ToLanes(from.direction), lighting);
    if (density > 0.0) sum += FromLanes(scattered) * from.radiance / density;
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
    radiance += ScatteredEnvironment(closure, lighting, light, run) * in.occlusion;
  }
  return radiance;
}

}  // namespace facet
HWY_AFTER_NAMESPACE();
