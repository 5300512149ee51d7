// The whole material: it reflects all the light of a white furnace, under punctual and under image-based light, and it
// is reciprocal.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "light/lighting-inl.h"
#include "material/closure-inl.h"

namespace facet {
namespace {

namespace lanes = HWY_NAMESPACE;
using lanes::LightingView;
using lanes::MaterialInputs;
using lanes::Vec3;

constexpr double kPi = 3.14159265358979324;
constexpr double kMetallic[] = {0.0, 0.25, 0.5, 0.75, 1.0};
constexpr double kNDotV[] = {0.002, 0.01, 0.03, 0.1, 0.3, 0.6, 1.0};

std::vector<double> Roughnesses() {
  std::vector<double> result = {0.0};
  for (int i = 1; i <= 20; ++i) result.push_back(0.05 * i);
  return result;
}

template <class T>
MaterialInputs<T> White(T metallic, T perceptual_roughness) {
  MaterialInputs<T> in{};
  in.base_color = {T(1), T(1), T(1)};
  in.metallic = metallic;
  in.perceptual_roughness = perceptual_roughness;
  in.normal = {T(0), T(0), T(1)};
  in.occlusion = T(1);
  return in;
}

LightingData NoLighting() { return MakeLightingData({}, nullptr); }

// Albedo in direction v: integral over half vectors (uniform in log tan, so that every lobe is resolved) of
// BRDF n_dot_l 4 v_dot_h dh.
double Albedo(const MaterialInputs<double>& in, double n_dot_v, const LightingData& data) {
  const LightingView<double> lighting(data);
  const Vec3<double> view = {std::sqrt(1.0 - n_dot_v * n_dot_v), 0.0, n_dot_v};
  const auto closure = lanes::MakeClosure(in, view, lighting);
  constexpr int kPolar = 220, kAzimuth = 48;
  const double low = std::log(closure.microfacets.alpha * 0.02), high = std::log(3e4);
  const double step = (high - low) / kPolar;
  double sum = 0.0;
  for (int i = 0; i < kPolar; ++i) {
    const double theta = std::atan(std::exp(low + (i + 0.5) * step));
    const double s = std::sin(theta), c = std::cos(theta);
    double ring = 0.0;
    for (int j = 0; j < kAzimuth; ++j) {
      const double phi = kPi * (j + 0.5) / kAzimuth;
      const Vec3<double> half = {s * std::cos(phi), s * std::sin(phi), c};
      const double v_dot_h = Dot(view, half);
      if (v_dot_h <= 0.0) continue;
      const Vec3<double> light = half * (2.0 * v_dot_h) - view;
      if (light.z <= 0.0) continue;
      ring += lanes::EvaluateClosure(closure, light, lighting).y * 4.0 * v_dot_h;
    }
    sum += ring * s * (s * c * step) * (2.0 * kPi / kAzimuth);
  }
  return sum;
}

TEST(WhiteFurnace, DirectionalLightsOfEveryDirection) {
  const LightingData data = NoLighting();
  double least = 2.0, most = 0.0;
  for (double roughness : Roughnesses()) {
    for (double metallic : kMetallic) {
      for (double n_dot_v : kNDotV) {
        const double albedo = Albedo(White(metallic, roughness), n_dot_v, data);
        EXPECT_GE(albedo, 0.98) << "roughness " << roughness << " metallic " << metallic << " n.v " << n_dot_v;
        EXPECT_LE(albedo, 1.005) << "roughness " << roughness << " metallic " << metallic << " n.v " << n_dot_v;
        least = std::min(least, albedo);
        most = std::max(most, albedo);
      }
    }
  }
  RecordProperty("least", std::to_string(least));
  RecordProperty("most", std::to_string(most));
}

// A coloured surface reflects less than a white one, and not much less than its colour says.
TEST(Furnace, ColoursNeverGain) {
  const LightingData data = NoLighting();
  for (double base : {0.0, 0.18, 0.9}) {
    for (double metallic : {0.0, 0.5, 1.0}) {
      MaterialInputs<double> in = White(metallic, 0.4);
      in.base_color = {base, base, base};
      const double albedo = Albedo(in, 0.5, data);
      EXPECT_LT(albedo, Albedo(White(metallic, 0.4), 0.5, data));
      EXPECT_GT(albedo, base * 0.7);
    }
  }
}

Image ConstantImage(float r, float g, float b) {
  Image image{64, 32, 3, ChannelType::F32, Encoding::Linear, {}};
  image.bytes.resize(image.PixelCount() * 3 * sizeof(float));
  for (std::size_t i = 0; i < image.PixelCount(); ++i) {
    image.As<float>()[3 * i] = r;
    image.As<float>()[3 * i + 1] = g;
    image.As<float>()[3 * i + 2] = b;
  }
  return image;
}

TEST(WhiteFurnace, ConstantEnvironment) {
  const auto environment = PrefilterEnvironment(ConstantImage(1.0f, 2.0f, 0.5f));
  const LightingData data = MakeLightingData({}, environment.get(), 0.7, 3.0);
  const LightingView<double> lighting(data);
  for (double roughness : Roughnesses()) {
    for (double metallic : kMetallic) {
      for (double n_dot_v : kNDotV) {
        const Vec3<double> view = {std::sqrt(1.0 - n_dot_v * n_dot_v), 0.0, n_dot_v};
        const Vec3<double> out = lanes::ShadeClosure(White(metallic, roughness), view, {0.0, 0.0, 0.0}, lighting);
        const double reflected[3] = {out.x / 3.0, out.y / 6.0, out.z / 1.5};
        for (double share : reflected) {
          EXPECT_GE(share, 0.98) << roughness << " " << metallic << " " << n_dot_v;
          EXPECT_LE(share, 1.005) << roughness << " " << metallic << " " << n_dot_v;
        }
      }
    }
  }
}

TEST(Closure, IsReciprocal) {
  const LightingData data = NoLighting();
  const LightingView<double> lighting(data);
  std::mt19937 random(7);
  const auto uniform = [&] { return double(random()) / 4294967296.0; };
  for (int trial = 0; trial < 2000; ++trial) {
    MaterialInputs<double> in = White(uniform(), uniform());
    in.base_color = {uniform(), uniform(), uniform()};
    const auto direction = [&] {
      const double z = 0.001 + 0.999 * uniform(), phi = 2.0 * kPi * uniform(), s = std::sqrt(1.0 - z * z);
      return Vec3<double>{s * std::cos(phi), s * std::sin(phi), z};
    };
    const Vec3<double> a = direction(), b = direction();
    const Vec3<double> ab = lanes::EvaluateClosure(lanes::MakeClosure(in, a, lighting), b, lighting) / b.z;
    const Vec3<double> ba = lanes::EvaluateClosure(lanes::MakeClosure(in, b, lighting), a, lighting) / a.z;
    EXPECT_NEAR(ab.x, ba.x, 1e-5 * ab.x);
    EXPECT_NEAR(ab.y, ba.y, 1e-5 * ab.y);
    EXPECT_NEAR(ab.z, ba.z, 1e-5 * ab.z);
  }
}

TEST(Closure, OcclusionDimsTheEnvironmentAlone) {
  const auto environment = PrefilterEnvironment(ConstantImage(1.0f, 1.0f, 1.0f));
  std::vector<PunctualLight> lights(1);
  lights[0].type = LightType::Directional;
  lights[0].intensity[1] = 2.0f;
  const Vec3<double> view = {0.6, 0.0, 0.8};
  MaterialInputs<double> in = White(0.0, 0.5);
  in.emissive = {0.25, 0.5, 0.75};
  const auto shade = [&](const EnvironmentMap* map, double occlusion) {
    const LightingData data = MakeLightingData(lights, map);
    in.occlusion = occlusion;
    return lanes::ShadeClosure(in, view, {0.0, 0.0, -1.0}, LightingView<double>(data));
  };
  const Vec3<double> punctual = shade(nullptr, 1.0), lit = shade(environment.get(), 1.0);
  EXPECT_EQ(shade(nullptr, 0.0).y, punctual.y);
  EXPECT_EQ(punctual.x, 0.25);  // the light is green
  EXPECT_GT(punctual.y, 0.5 + 0.3);
  EXPECT_NEAR(shade(environment.get(), 0.25).y, punctual.y + 0.25 * (lit.y - punctual.y), 1e-12);
  EXPECT_NEAR(shade(environment.get(), 0.0).y, punctual.y, 1e-12);
}

TEST(Closure, IsDarkBelowTheHorizonAndFiniteEverywhere) {
  const LightingData data = NoLighting();
  const LightingView<float> lighting(data);
  for (float roughness : {0.0f, 0.045f, 0.5f, 1.0f}) {
    for (float metallic : {0.0f, 1.0f}) {
      const MaterialInputs<float> in = White(metallic, roughness);
      for (Vec3<float> view : {Vec3<float>{0, 0, 1}, {1, 0, 0}, {0.6f, 0, -0.8f}, {0, 0, -1}}) {
        const auto closure = lanes::MakeClosure(in, view, lighting);
        for (Vec3<float> light : {Vec3<float>{0, 0, 1}, {-1, 0, 1e-6f}, {-0.6f, 0, 0.8f}, {1, 0, 0}, {0, 0, 0}}) {
          const Vec3<float> value = lanes::EvaluateClosure(closure, light, lighting);
          EXPECT_TRUE(std::isfinite(value.x) && value.x >= 0.0f) << roughness << " " << view.z << " " << light.z;
        }
        EXPECT_EQ(lanes::EvaluateClosure(closure, Vec3<float>{0, 0, -1}, lighting).x, 0.0f);
        EXPECT_EQ(lanes::EvaluateClosure(closure, Vec3<float>{0.8f, 0, -0.6f}, lighting).x, 0.0f);
      }
    }
  }
}

}  // namespace
}  // namespace facet
