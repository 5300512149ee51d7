#include "reference/radiance_exact.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "light/lighting-inl.h"
#include "math/elementary.h"
#include "reference/exact_source-inl.h"

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace {

using lanes::Vec3;

constexpr double kPiDouble = 3.14159265358979324;

using ExactClosure = lanes::Closure<double>;

// The Lighting for the closure, with exact albedos. Rows of the roughnesses that are asked for most are kept.
class ExactLighting {
 public:
  explicit ExactLighting(const AlbedoSurface& albedos) : albedos_(albedos) {}

  lanes::SpecularAlbedo<double> Dfg(double n_dot_v, double roughness) const {
    for (const Known& known : known_) {
      if (known.roughness == roughness) return Convert(known.row.At(n_dot_v));
    }
    return Convert(albedos_.At(n_dot_v, roughness));
  }
  // A closure asks once for each of its lobes, before it is evaluated under light.
  lanes::SpecularAlbedo<double> DfgAverage(double roughness) const {
    for (const Known& known : known_) {
      if (known.roughness == roughness) return Convert(known.row.Average());
    }
    known_.push_back({roughness, albedos_.Row(roughness)});
    return Convert(known_.back().row.Average());
  }

  // Of the rasterizer's table, read in double: a quadrature for each light would take longer than all else.
  lanes::SpecularAlbedo<double> AnisotropicDfg(double n_dot_v, double t_dot_v, double roughness,
                                               double strength) const {
    return lanes::LookupAnisotropicDfg(SharedAnisotropicDfgTable(), n_dot_v, t_dot_v, roughness, strength);
  }
  lanes::SpecularAlbedo<double> AnisotropicDfgAverage(double roughness, double strength) const {
    return lanes::LookupAnisotropicDfgAverage(SharedAnisotropicDfgTable(), roughness, strength);
  }

  // Of the rasterizer's table, whose error is below 0.0021: the quadrature would take longer than all else.
  double SheenAlbedo(double n_dot_v, double roughness) const {
    return lanes::LookupSheen(SharedSheenTable(), n_dot_v, roughness);
  }

 private:
  struct Known {
    double roughness;
    AlbedoRow row;
  };
  static lanes::SpecularAlbedo<double> Convert(const ExactAlbedo& albedo) { return {albedo.a, albedo.b}; }
  const AlbedoSurface& albedos_;
  mutable std::vector<Known> known_;
};

// Tangent frame of a shading normal: Duff et al., 2017, Building an Orthonormal Basis, Revisited.
class Frame {
 public:
  explicit Frame(const glm::dvec3& normal) : z_(normal) {
    const double sign = std::copysign(1.0, normal.z), a = -1.0 / (sign + normal.z), b = normal.x * normal.y * a;
    x_ = {1.0 + sign * normal.x * normal.x * a, sign * b, -sign * normal.x};
    y_ = {b, sign + normal.y * normal.y * a, -normal.y};
  }
  Frame(const glm::dvec3& tangent, const glm::dvec3& bitangent, const glm::dvec3& normal)
      : x_(tangent), y_(bitangent), z_(normal) {}
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

// Sampling of a specular lobe by reflection about visible normals. With interpolated and mapped normals, the view may
// be below the horizon; it then sees the normals that are tilted towards it. The lobe that the closure evaluates is as
// narrow there, so that other densities would miss it. Axes of the frame: tangent, bitangent, normal.
class VisibleNormals {
 public:
  VisibleNormals(const Frame& frame, const glm::dvec3& view, double alpha_t, double alpha_b)
      : frame_(frame), alpha_t_(alpha_t), alpha_b_(alpha_b) {
    const glm::dvec3 local = frame.ToLocal(view);
    view_ = glm::normalize(glm::dvec3(local.x, local.y, std::max(local.z, -0.9999)));
    stretched_ = glm::normalize(glm::dvec3(alpha_t * view_.x, alpha_b * view_.y, view_.z));
    // The area of the visible normals seen along the view (Heitz, 2014, Understanding the Masking-Shadowing Function,
    // equation 14), twice: z + masked, where that does not cancel.
    const double x = alpha_t * view_.x, y = alpha_b * view_.y, across = x * x + y * y;
    const double masked = std::sqrt(view_.z * view_.z + across);
    twice_area_ = view_.z >= 0.0 ? view_.z + masked : across / (masked - view_.z);
  }

  // May lie below the horizon.
  glm::dvec3 Sample(const glm::dvec2& random) const {
    const double z = (1.0 - random.y) * (1.0 + stretched_.z) - stretched_.z;
    const double around = std::sqrt(std::max(1.0 - z * z, 0.0));
    const glm::dvec3 h = glm::dvec3(OnCircle(random.x) * around, z) + stretched_;
    const glm::dvec3 half = glm::normalize(glm::dvec3(alpha_t_ * h.x, alpha_b_ * h.y, h.z));
    return frame_.ToWorld(half * (2.0 * glm::dot(view_, half)) - view_);
  }

  double Density(const glm::dvec3& direction) const {
    const glm::dvec3 local = frame_.ToLocal(direction);
    if (!(local.z > 0.0)) return 0.0;
    const Vec3<double> normal = {0.0, 0.0, 1.0};
    const Vec3<double> half = lanes::NormalizeOr(ToLanes(view_ + local), normal);
    if (alpha_t_ == alpha_b_) return lanes::DistributionGgx(normal, half, alpha_t_) / (2.0 * twice_area_);
    return lanes::DistributionGgxAnisotropic(half.x, half.y, half.z, alpha_t_, alpha_b_) / (2.0 * twice_area_);
  }

 private:
  Frame frame_;
  glm::dvec3 view_, stretched_;
  double alpha_t_, alpha_b_, twice_area_;
};

// Sampling by the cosine with a normal.
class Cosine {
 public:
  explicit Cosine(const glm::dvec3& normal) : frame_(normal), normal_(normal) {}
  glm::dvec3 Sample(const glm::dvec2& random) const {
    return frame_.ToWorld({OnCircle(random.x) * std::sqrt(random.y), std::sqrt(std::max(1.0 - random.y, 0.0))});
  }
  double Density(const glm::dvec3& direction) const { return std::max(glm::dot(normal_, direction), 0.0) / kPiDouble; }

 private:
  Frame frame_;
  glm::dvec3 normal_;
};

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
