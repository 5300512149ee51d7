#include "reference/radiance_exact.h"

#include <algorithm>
#include <cmath>

#include "light/lighting-inl.h"
#include "math/elementary.h"
#include "reference/exact_source-inl.h"

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace {

using lanes::Vec3;

constexpr double kPiDouble = 3.14159265358979324;

// The Lighting for MakeClosure() and EvaluateClosure(), with exact albedos at the closure's roughness.
class ExactLighting {
 public:
  explicit ExactLighting(const AlbedoRow& row) : row_(row) {}
  lanes::SpecularAlbedo<double> Dfg(double n_dot_v, double) const { return Convert(row_.At(n_dot_v)); }
  lanes::SpecularAlbedo<double> DfgAverage(double) const { return Convert(row_.Average()); }

 private:
  static lanes::SpecularAlbedo<double> Convert(const ExactAlbedo& albedo) { return {albedo.a, albedo.b}; }
  const AlbedoRow& row_;
};

// Tangent frame of a shading normal: Duff et al., 2017, Building an Orthonormal Basis, Revisited.
class Frame {
 public:
  explicit Frame(const glm::dvec3& normal) : z_(normal) {
    const double sign = std::copysign(1.0, normal.z), a = -1.0 / (sign + normal.z), b = normal.x * normal.y * a;
    x_ = {1.0 + sign * normal.x * normal.x * a, sign * b, -sign * normal.x};
    y_ = {b, sign + normal.y * normal.y * a, -normal.y};
  }
  glm::dvec3 ToWorld(const glm::dvec3& v) const { return x_ * v.x + y_ * v.y + z_ * v.z; }
  glm::dvec3 ToLocal(const glm::dvec3& v) const { return {glm::dot(x_, v), glm::dot(y_, v), glm::dot(z_, v)}; }

 private:
  glm::dvec3 x_, y_, z_;
};

// The point at a fraction of the unit circle's circumference.
glm::dvec2 OnCircle(double share) {
  const double cosine = Cos(2.0 * kPiDouble * share);
  return {cosine, std::copysign(std::sqrt(std::max(1.0 - cosine * cosine, 0.0)), 0.5 - share)};
}

// Sampling of the specular lobe by reflection about visible normals, in the frame of the normal. With interpolated and
// mapped normals, the view may be below the horizon; it then sees the normals that are tilted towards it. The lobe that
// the closure evaluates is as narrow there, so that other densities would miss it.
class SpecularLobe {
 public:
  SpecularLobe(const glm::dvec3& view_local, double alpha)
      : view_(glm::normalize(glm::dvec3(view_local.x, view_local.y, std::max(view_local.z, -0.9999)))),
        stretched_(glm::normalize(glm::dvec3(alpha * view_.x, alpha * view_.y, view_.z))),
        alpha_(alpha) {
    // The area of the visible normals seen along the view (Heitz, 2014, Understanding the Masking-Shadowing Function,
    // equation 14), twice: z + masked, where that does not cancel.
    const double masked = std::sqrt(view_.z * view_.z * (1.0 - alpha * alpha) + alpha * alpha);
    twice_area_ = view_.z >= 0.0 ? view_.z + masked : alpha * alpha * (1.0 - view_.z * view_.z) / (masked - view_.z);
  }

  // May lie below the horizon.
  glm::dvec3 Sample(const glm::dvec2& random) const {
    const double z = (1.0 - random.y) * (1.0 + stretched_.z) - stretched_.z;
    const double around = std::sqrt(std::max(1.0 - z * z, 0.0));
    const glm::dvec3 h = glm::dvec3(OnCircle(random.x) * around, z) + stretched_;
    const glm::dvec3 half = glm::normalize(glm::dvec3(alpha_ * h.x, alpha_ * h.y, h.z));
    return half * (2.0 * glm::dot(view_, half)) - view_;
  }

  double Density(const glm::dvec3& direction) const {
    const Vec3<double> normal = {0.0, 0.0, 1.0};
    const Vec3<double> half = lanes::NormalizeOr(ToLanes(view_ + direction), normal);
    return lanes::DistributionGgx(normal, half, alpha_) / (2.0 * twice_area_);
  }

 private:
  glm::dvec3 view_, stretched_;
  double alpha_, twice_area_;
};

glm::dvec3 SampleCosine(const glm::dvec2& random) {
  return {OnCircle(random.x) * std::sqrt(random.y), std::sqrt(std::max(1.0 - random.y, 0.0))};
}

glm::dvec3 ReflectedEnvironment(const lanes::Closure<double>& closure, const ExactLighting& lighting,
                                const ExactLight& light, const SampleRun& run) {
  const ExactEnvironment& environment = *light.environment;
  const Frame frame(FromLanes(closure.at.normal));
  const SpecularLobe lobe(frame.ToLocal(FromLanes(closure.at.view)), closure.specular.alpha);
  glm::dvec3 sum(0.0);
  const auto add = [&](const ExactEnvironment::Light& from, const glm::dvec3& local) {
    if (!(local.z > 0.0)) return;
    const double density = from.density + lobe.Density(local) + local.z / kPiDouble;
    sum += FromLanes(lanes::EvaluateClosure(closure, ToLanes(from.direction), lighting)) * from.radiance / density;
  };
  for (std::uint32_t k = 0; k < light.environment_samples; ++k) {
    const auto random = [&](std::uint32_t technique) {
      return run.sequence.Point(run.pair + technique, run.index + k);
    };
    const ExactEnvironment::Light bright = environment.Sample(random(0));
    add(bright, frame.ToLocal(bright.direction));
    for (const glm::dvec3& local : {lobe.Sample(random(1)), SampleCosine(random(2))}) {
      if (local.z > 0.0) add(environment.Toward(frame.ToWorld(local)), local);
    }
  }
  return sum / double(light.environment_samples);
}

}  // namespace

glm::dvec3 RadianceTowardEye(const ExactMaterial& material, const glm::dvec3& base_color, const SurfacePoint& point,
                             const ExactLight& light, const SampleRun& run) {
  const ExactSource source{material, point};
  const auto in = lanes::ReadInputs<double>(source, ToLanes(glm::dvec4(base_color, 1.0)), material.Frame().features);
  const AlbedoRow row =
      light.albedos.Row(lanes::Clamp(in.perceptual_roughness, double(lanes::kMinPerceptualRoughness), 1.0));
  const ExactLighting lighting(row);
  const auto closure = lanes::MakeClosure(in, ToLanes(point.view), lighting);

  glm::dvec3 radiance = FromLanes(in.emissive);
  for (const PunctualLight& punctual : light.punctual) {
    const auto sample = lanes::SamplePunctual(punctual, ToLanes(point.position));
    radiance += FromLanes(lanes::EvaluateClosure(closure, sample.direction, lighting) * sample.irradiance);
  }
  if (light.environment != nullptr && !light.environment->IsBlack()) {
    radiance += ReflectedEnvironment(closure, lighting, light, run) * in.occlusion;
  }
  return radiance;
}

}  // namespace facet
HWY_AFTER_NAMESPACE();
