#include "reference/transmission_exact.h"

#include <algorithm>
#include <cmath>

#include "light/lighting-inl.h"
#include "math/elementary.h"
#include "reference/exact_source-inl.h"
#include "reference/lighting_exact-inl.h"
#include "reference/sampling_exact-inl.h"

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace {

double Bounded(double share) { return std::clamp(share, 0.0, 1.0); }

ExactInterface InterfaceAt(const ExactSource& source, const SurfacePoint& point, double perceptual_roughness) {
  const float* const ior = source.Factors().ior;
  const double roughness = Bounded(perceptual_roughness);
  return {point.view, FromLanes(lanes::MappedNormal<double>(source, Slot::Normal, source.Factors().normal_scale)),
          point.flat_normal, roughness * roughness, glm::dvec3(ior[0], ior[1], ior[2])};
}

// How much narrower a thin wall scatters than it reflects: a wall between equal media does not scatter.
double ThinWallAlpha(double alpha, double ior) { return alpha * Bounded(2.0 * ior - 2.0); }

// The lobe of a thin wall for one direction of light, times the cosine.
double ThinWallLobe(const ExactInterface& at, double alpha, const lanes::Vec3<double>& light,
                    const ExactLighting& lighting) {
  const lanes::Vec3<double> normal = ToLanes(at.normal);
  const lanes::SurfaceView<double> seen{normal, ToLanes(at.view),
                                        std::clamp(glm::dot(at.normal, at.view), double(lanes::kMinNDotV), 1.0)};
  const double behind = -lanes::Dot(normal, light);
  if (!(behind > 0.0)) return 0.0;
  const lanes::Microfacets<double> microfacets(std::sqrt(alpha));
  const auto from = lanes::IncidenceFrom(seen, light + normal * (2.0 * behind));
  const double roughness = microfacets.perceptual_roughness;
  const double multiple = lanes::LostEnergy(lighting.Dfg(seen.n_dot_v, roughness)) *
                          lanes::LostEnergy(lighting.Dfg(from.n_dot_l, roughness)) /
                          (kPiExact * std::max(lanes::LostEnergy(lighting.DfgAverage(roughness)), 1e-6));
  return (microfacets.Single(seen, from) + multiple) * from.n_dot_l;
}

}  // namespace

ExactInterface ExitAt(const ExactMaterial& material, const SurfacePoint& point) {
  const ExactSource source{material, point};
  const MaterialFactors& factors = source.Factors();
  const double roughness =
      material.Frame().model == ShadingModel::SpecularGlossiness
          ? 1.0 - lanes::ReadFactor<kA, double>(source, factors.glossiness, Slot::SpecularGlossiness)
          : lanes::ReadFactor<kG, double>(source, factors.perceptual_roughness, Slot::MetallicRoughness);
  return InterfaceAt(source, point, roughness);
}

ExactEntry EntryAt(const ExactMaterial& material, const glm::dvec3& base_color, const SurfacePoint& point,
                   double metres_per_unit, const ExactLight& light) {
  const ExactSource source{material, point};
  const MaterialFactors& factors = source.Factors();
  auto in = lanes::ReadInputs<double>(source, ToLanes(glm::dvec4(base_color, 1.0)), material.Frame().features);
  if (material.Frame().model == ShadingModel::SpecularGlossiness) lanes::SetSpecularGlossiness(source, in);
  const ExactLighting lighting(light.albedos);
  const lanes::Closure<double> closure(in, ToLanes(point.view), lighting);

  ExactEntry entry;
  entry.at = InterfaceAt(source, point, in.perceptual_roughness);
  double left = (1.0 - Bounded(in.metallic)) * Bounded(in.transmission) * closure.diffuse.left_for_view;
  if (closure.Has(kSheen)) left *= closure.sheen.EnergyLeft();
  if (closure.Has(kClearcoat)) left *= closure.clearcoat.EnergyLeft();
  entry.tint = glm::clamp(base_color, 0.0, 1.0) * left;
  glm::dvec3 passing(1.0);
  if (source.Has(kVolume)) {
    entry.absorption = glm::dvec3(factors.absorption[0], factors.absorption[1], factors.absorption[2]);
    entry.thickness = lanes::ReadFactor<kG, double>(source, factors.thickness, Slot::Thickness) * metres_per_unit;
    for (int c = 0; c < 3; ++c) passing[c] = Exp(std::max(-entry.absorption[c] * entry.thickness, -700.0));
  }
  const double alpha = ThinWallAlpha(entry.at.alpha, entry.at.ior.y);
  for (const PunctualLight& punctual : light.punctual) {
    const auto sample = lanes::SamplePunctual(punctual, ToLanes(point.position));
    const double lobe = ThinWallLobe(entry.at, alpha, sample.direction, lighting);
    entry.punctual += entry.tint * passing * FromLanes(sample.irradiance) * lobe;
  }
  return entry;
}

// Chosen in proportion to its albedo, the single scattering is sampled by visible normals, which leaves G2 / G1 of
// height-correlated Smith, (1 + lambda(v)) / (1 + lambda(v) + lambda(l)), and multiple scattering by the cosine.
ThinWallSample PassThinWall(const ExactInterface& at, double ior, const AlbedoSurface& albedos,
                            const glm::dvec2& random, double choice) {
  const double alpha = ThinWallAlpha(at.alpha, ior);
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
