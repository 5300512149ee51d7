// Energy of anisotropic surfaces in white furnaces: under lights of every direction and under a constant environment.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "light/lighting-inl.h"
#include "material/closure-inl.h"

namespace facet {
namespace {

namespace lanes = HWY_NAMESPACE;
using lanes::LightingView;
using lanes::MaterialInputs;
using lanes::Vec3;

constexpr double kPi = 3.14159265358979324;
constexpr double kNDotV[] = {0.002, 0.01, 0.03, 0.1, 0.3, 0.6, 1.0};
constexpr double kAzimuths[] = {0.0, 20.0, 45.0, 70.0, 80.0, 87.0, 90.0};  // degrees from the tangent

MaterialInputs<double> White(double metallic, double perceptual_roughness, double strength) {
  MaterialInputs<double> in{};
  in.base_color = {1.0, 1.0, 1.0};
  in.metallic = metallic;
  in.perceptual_roughness = perceptual_roughness;
  in.normal = {0.0, 0.0, 1.0};
  in.occlusion = 1.0;
  in.lobes |= kAnisotropy;
  in.anisotropy = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, strength};
  return in;
}

Vec3<double> View(double n_dot_v, double degrees) {
  const double s = std::sqrt(1.0 - n_dot_v * n_dot_v), azimuth = degrees * kPi / 180.0;
  return {s * std::cos(azimuth), s * std::sin(azimuth), n_dot_v};
}

// The share of a white hemisphere's light that reaches the view (of both hemispheres' if the surface transmits
// diffusely). Directions are those of mirrors that the view sees, and as many cosine-weighted ones, each divided by the
// sum of both densities (Veach and Guibas, 1995, Optimally Combining Sampling Techniques, balance heuristic), on
// Fibonacci lattices.
double Albedo(const MaterialInputs<double>& in, const Vec3<double>& view) {
  static const LightingData data = MakeLightingData({}, nullptr, 0.0, 1.0, {.sheen = true, .anisotropic_dfg = true});
  const LightingView<double> lighting(data);
  const auto closure = lanes::MakeClosure(in, view, lighting);
  const double alpha_t = closure.anisotropic.alpha_t, alpha_b = closure.anisotropic.alpha_b;
  const Vec3<double> stretched = {alpha_t * view.x, alpha_b * view.y, view.z};
  const double length = std::sqrt(Dot(stretched, stretched));
  const Vec3<double> top = stretched * (1.0 / length);
  Vec3<double> sum{0.0, 0.0, 0.0};
  constexpr int kCount = 1597, kGenerator = 987;
  const auto add = [&](const Vec3<double>& light, double jacobian) {
    if (light.z <= 0.0) return;
    const Vec3<double> between = view + light, half = between * (1.0 / std::sqrt(Dot(between, between)));
    const double of_mirrors =
        lanes::DistributionGgxAnisotropic(half.x, half.y, half.z, alpha_t, alpha_b) / (2.0 * (view.z + length));
    sum += lanes::EvaluateClosure(closure, light, lighting) * (jacobian / (of_mirrors + light.z / kPi));
  };
  for (int i = 0; i < kCount; ++i) {
    const double s = (i + 0.5) / kCount, share = s * s * (3.0 - 2.0 * s), jacobian = 6.0 * s * (1.0 - s) / kCount;
    const double azimuth = 2.0 * kPi * (i * kGenerator % kCount + 0.5) / kCount;
    const double z = (1.0 - share) * (1.0 + top.z) - top.z, around = std::sqrt(std::max(1.0 - z * z, 0.0));
    const Vec3<double> h = {alpha_t * (around * std::cos(azimuth) + top.x),
                            alpha_b * (around * std::sin(azimuth) + top.y), z + top.z};
    add(h * (2.0 * Dot(view, h) / Dot(h, h)) - view, jacobian);
    const double r = std::sqrt(share);
    add({r * std::cos(azimuth), r * std::sin(azimuth), std::sqrt(1.0 - share)}, jacobian);
    if (closure.Has(kDiffuseTransmission)) {
      const Vec3<double> behind = {r * std::cos(azimuth), r * std::sin(azimuth), -std::sqrt(1.0 - share)};
      sum += lanes::EvaluateClosure(closure, behind, lighting) * (jacobian * kPi / -behind.z);
    }
  }
  return MaxComponent(sum);
}

TEST(AnisotropyInWhiteFurnace, DirectionalLightsOfEveryDirection) {
  double least = 2.0, most = 0.0;
  for (const double roughness : {0.1, 0.25, 0.5, 0.75, 1.0}) {
    for (const double strength : {0.0, 0.5, 1.0}) {
      for (const double metallic : {0.0, 0.5, 1.0}) {
        const MaterialInputs<double> in = White(metallic, roughness, strength);
        for (const double n_dot_v : kNDotV) {
          for (const double degrees : kAzimuths) {
            const double albedo = Albedo(in, View(n_dot_v, degrees));
            EXPECT_LE(albedo, 1.005) << "roughness " << roughness << ", strength " << strength << ", metallic "
                                     << metallic << ", n.v " << n_dot_v << ", azimuth " << degrees;
            EXPECT_GE(albedo, 0.98) << "roughness " << roughness << ", strength " << strength << ", metallic "
                                    << metallic << ", n.v " << n_dot_v << ", azimuth " << degrees;
            least = std::min(least, albedo), most = std::max(most, albedo);
          }
        }
      }
    }
  }
  RecordProperty("share", std::to_string(least) + " to " + std::to_string(most));
}

// Light that passes through from behind crosses the same interface.
TEST(AnisotropyInWhiteFurnace, WithDiffuseTransmission) {
  for (const double strength : {0.0, 0.5, 1.0}) {
    MaterialInputs<double> in = White(0.0, 0.3, strength);
    in.lobes |= kDiffuseTransmission;
    for (const double factor : {0.5, 1.0}) {
      in.diffuse_transmission = {factor, {1.0, 1.0, 1.0}};
      for (const double n_dot_v : kNDotV) {
        for (const double degrees : {0.0, 45.0, 90.0}) {
          const double albedo = Albedo(in, View(n_dot_v, degrees));
          EXPECT_LE(albedo, 1.005) << strength << " " << factor << " " << n_dot_v << " " << degrees;
          EXPECT_GE(albedo, 0.98) << strength << " " << factor << " " << n_dot_v << " " << degrees;
        }
      }
    }
  }
}

TEST(AnisotropyInWhiteFurnace, ConstantEnvironment) {
  Image image{64, 32, 3, ChannelType::F32, Encoding::Linear, {}};
  image.bytes.resize(image.PixelCount() * 3 * sizeof(float));
  std::fill_n(image.As<float>(), image.PixelCount() * 3, 1.0f);
  const auto environment = PrefilterEnvironment(image);
  const LightingData data = MakeLightingData({}, environment.get(), 0.7, 3.0, {.anisotropic_dfg = true});
  const LightingView<double> lighting(data);
  for (const double roughness : {0.0, 0.1, 0.25, 0.5, 0.75, 1.0}) {
    for (const double strength : {0.0, 0.5, 1.0}) {
      for (const double metallic : {0.0, 0.5, 1.0}) {
        const MaterialInputs<double> in = White(metallic, roughness, strength);
        for (const double n_dot_v : kNDotV) {
          for (const double degrees : kAzimuths) {
            const Vec3<double> radiance = lanes::ShadeClosure(in, View(n_dot_v, degrees), {0.0, 0.0, 0.0}, lighting);
            EXPECT_NEAR(radiance.x / 3.0, 1.0, 0.003)
                << roughness << " " << strength << " " << metallic << " " << n_dot_v << " " << degrees;
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace facet
