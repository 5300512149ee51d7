#include "reference/transmission_exact.h"

#include <algorithm>
#include <cmath>

#include "light/lighting-inl.h"
#include "material/models/enterprise-inl.h"
#include "math/elementary.h"
#include "reference/exact_source-inl.h"
#include "reference/filament_exact.h"
#include "reference/lighting_exact-inl.h"
#include "reference/sampling_exact-inl.h"

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace {

double Bounded(double share) { return std::clamp(share, 0.0, 1.0); }

ExactInterface InterfaceAt(const ExactSource& source, const SurfacePoint& point, double perceptual_roughness,
                           const lanes::Vec3<double>& normal) {
  const float* const ior = source.Factors().ior;
  const double roughness = Bounded(perceptual_roughness);
  return {point.view, FromLanes(normal), point.flat_normal, roughness * roughness, glm::dvec3(ior[0], ior[1], ior[2])};
}
ExactInterface InterfaceAt(const ExactSource& source, const SurfacePoint& point, double perceptual_roughness) {
  return InterfaceAt(source, point, perceptual_roughness,
                     lanes::MappedNormal<double>(source, Slot::Normal, source.Factors().normal_scale));
}

bool IsEnterprise(const ExactMaterial& material) { return material.Frame().model == ShadingModel::Enterprise; }

ExactEntry EntryOfEnterprise(const ExactSource& source, const glm::dvec3& base_color, const SurfacePoint& point,
                             const ExactLight& light) {
  const ExactLighting lighting(light.albedos);
  auto in = lanes::ReadEnterpriseInputs<double>(source, ToLanes(glm::dvec4(base_color, 1.0)));
  const auto volume = in.volume;
  in.volume.thickness = 0.0;  // so that the colour is that of the surface alone
  const lanes::EnterpriseScattering<double> surface(source, in, ToLanes(point.view), lighting);

  ExactEntry entry;
  // Microfacets of the same area; the rays' facets are equally wide in all directions.
  const double alpha = surface.closure.Has(kAnisotropy)
                           ? std::sqrt(surface.closure.anisotropic.alpha_t * surface.closure.anisotropic.alpha_b)
                           : Bounded(in.perceptual_roughness) * Bounded(in.perceptual_roughness);
  entry.at = InterfaceAt(source, point, std::sqrt(alpha), surface.normal);
  entry.thin_wall_alpha = surface.closure.transmission.unclamped_alpha;
  entry.tint = FromLanes(surface.Tint());
  glm::dvec3 passing(1.0);
  if (source.Has(kVolume)) {
    entry.absorption = FromLanes(volume.absorption);
    entry.thickness = volume.thickness;
    passing = FromLanes(volume.Passing());
  }
  for (const PunctualLight& punctual : light.punctual) {
    const auto sample = lanes::SamplePunctual(punctual, ToLanes(point.position));
    entry.punctual += passing * FromLanes(surface.Transmitted(sample.direction, lighting) * sample.irradiance);
  }
  return entry;
}

}  // namespace

ExactInterface ExitAt(const ExactMaterial& material, const SurfacePoint& point) {
  if (material.Frame().model == ShadingModel::Filament) return FilamentExitAt(material, point);
  const ExactSource source{material, point};
  if (IsEnterprise(material)) {
    const auto in = lanes::ReadEnterpriseInputs<double>(source, lanes::Vec4<double>{1.0, 1.0, 1.0, 1.0});
    return InterfaceAt(source, point, in.perceptual_roughness, in.normal);
  }
  const MaterialFactors& factors = source.Factors();
  const double roughness =
      material.Frame().model == ShadingModel::SpecularGlossiness
          ? 1.0 - lanes::ReadFactor<kA, double>(source, factors.glossiness, Slot::SpecularGlossiness)
          : lanes::ReadFactor<kG, double>(source, factors.perceptual_roughness, Slot::MetallicRoughness);
  return InterfaceAt(source, point, roughness);
}

ExactEntry EntryAt(const ExactMaterial& material, const glm::dvec3& base_color, const SurfacePoint& point,
                   const ExactLight& light) {
  if (material.Frame().model == ShadingModel::Filament) {
    return FilamentEntryAt(material, glm::dvec4(base_color, 1.0), point, light);
  }
  const ExactSource source{material, point};
  if (IsEnterprise(material)) return EntryOfEnterprise(source, base_color, point, light);
  auto in = lanes::ReadInputs<double>(source, ToLanes(glm::dvec4(base_color, 1.0)), material.Frame().features);
  if (material.Frame().model == ShadingModel::SpecularGlossiness) lanes::SetSpecularGlossiness(source, in);
  const auto volume = in.volume;
  in.volume.thickness = 0.0;  // so that the closure's colour is that of the surface alone
  const ExactLighting lighting(light.albedos);
  const lanes::Closure<double> closure(in, ToLanes(point.view), lighting);

  ExactEntry entry;
  entry.at = InterfaceAt(source, point, in.perceptual_roughness);
  entry.thin_wall_alpha = closure.transmission.unclamped_alpha;
  entry.tint = FromLanes(closure.transmission.color);
  glm::dvec3 passing(1.0);
  if (source.Has(kVolume)) {
    entry.absorption = FromLanes(volume.absorption);
    entry.thickness = volume.thickness;
    passing = FromLanes(volume.Passing());
  }
  for (const PunctualLight& punctual : light.punctual) {
    const auto sample = lanes::SamplePunctual(punctual, ToLanes(point.position));
    entry.punctual += passing * FromLanes(lanes::EvaluateTransmission(closure, sample.direction, lighting)) *
                      FromLanes(sample.irradiance);
  }
  return entry;
}

// Chosen in proportion to its albedo, the single scattering is sampled by visible normals, which leaves G2 / G1 of
// height-correlated Smith, (1 + lambda(v)) / (1 + lambda(v) + lambda(l)), and multiple scattering by the cosine.
ThinWallSample PassThinWall(const ExactEntry& entry, const AlbedoSurface& albedos, const glm::dvec2& random,
                            double choice) {
  const ExactInterface& at = entry.at;
  const double alpha = entry.thin_wall_alpha;
  if (!(alpha > 0.0)) return {-at.view, 1.0};
  const ExactLighting lighting(albedos);
  const double roughness = std::clamp(std::sqrt(alpha), double(lanes::kMinPerceptualRoughness), 1.0);
  const double n_dot_v = glm::dot(at.normal, at.view), cosine = std::clamp(n_dot_v, double(lanes::kMinNDotV), 1.0);
  const double lost = lanes::LostEnergy(lighting.Dfg(cosine, roughness));
  const auto to_back = [&](const glm::dvec3& d) { return Beyond(at, d - at.normal * (2.0 * glm::dot(at.normal, d))); };
  if (choice < lost) {
    const glm::dvec3 light = Cosine(at.normal).Sample(random);
    const double light_cosine = std::clamp(glm::dot(at.normal, light), 0.0, 1.0);
    return {to_back(light), lanes::LostEnergy(lighting.Dfg(light_cosine, roughness)) /
                                std::max(lanes::LostEnergy(lighting.DfgAverage(roughness)), 1e-6)};
  }
  const glm::dvec3 light = VisibleNormals(Frame(at.normal), at.view, alpha, alpha).Sample(random);
  const double n_dot_l = glm::dot(at.normal, light);
  if (!(n_dot_l > 0.0)) return {-at.view, 0.0};
  const auto lambda = [&](double z) {  // plus a half
    return 0.5 * std::sqrt(1.0 + alpha * alpha * (1.0 - z * z) / (z * z));
  };
  const double of_view = lambda(cosine);
  return {to_back(light), (of_view + 0.5) / ((of_view + lambda(n_dot_l)) * (1.0 - lost))};
}

glm::dvec3 SampleFacet(const ExactInterface& at, const glm::dvec2& random) {
  if (!(at.alpha > 0.0)) return at.normal;
  return VisibleNormals(Frame(at.normal), at.view, at.alpha, at.alpha).SampleNormal(random);
}

std::optional<glm::dvec3> Refracted(const glm::dvec3& incident, const glm::dvec3& normal, double ratio) {
  const double cosine = -glm::dot(incident, normal);
  const double beyond2 = 1.0 - ratio * ratio * (1.0 - cosine * cosine);
  if (!(beyond2 > 0.0)) return std::nullopt;
  return glm::normalize(incident * ratio + normal * (ratio * cosine - std::sqrt(beyond2)));
}

glm::dvec3 Reflected(const glm::dvec3& incident, const glm::dvec3& normal) {
  return glm::normalize(incident - normal * (2.0 * glm::dot(incident, normal)));
}

glm::dvec3 Beyond(const ExactInterface& at, const glm::dvec3& direction) {
  return glm::dot(direction, at.flat_normal) > 0.0 ? Reflected(direction, at.flat_normal) : direction;
}

glm::dvec3 Before(const ExactInterface& at, const glm::dvec3& direction) {
  return glm::dot(direction, at.flat_normal) < 0.0 ? Reflected(direction, at.flat_normal) : direction;
}

}  // namespace facet
HWY_AFTER_NAMESPACE();
