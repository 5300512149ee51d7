// The model "enterprise": closed forms of its layers, energy in a white furnace, agreement of precisions, extremes.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include "material/enterprise_factors.h"
#include "material/enterprise_point.h"

namespace facet {
namespace {

namespace lanes = HWY_NAMESPACE;
using lanes::LightingView;
using lanes::Vec3;
using testing::EnterpriseLighting;
using testing::EnterprisePoint;
using testing::ViewAt;

constexpr double kPi = 3.14159265358979324;
constexpr double kNDotV[] = {0.01, 0.1, 0.3, 0.6, 1.0};

EnterpriseParameters White() {
  EnterpriseParameters p;
  p.roughness.value = 0.4f;
  return p;
}

Image ConstantImage() {
  Image image{64, 32, 3, ChannelType::F32, Encoding::Linear, {}};
  image.bytes.resize(image.PixelCount() * 3 * sizeof(float));
  for (std::size_t i = 0; i < image.PixelCount() * 3; ++i) image.As<float>()[i] = 1.0f;
  return image;
}

// --- Closed forms ----------------------------------------------------------------------------------------------------

// The specification's core for thin walls, for s = 1 and a metal or a dielectric, written down as it stands there, with
// facet's albedos.
TEST(EnterpriseCore, IsTheSpecifications) {
  const LightingData data = EnterpriseLighting();
  const LightingView<double> lighting(data);
  for (const float metallic : {0.0f, 1.0f}) {
    for (const float r : {0.2f, 0.5f, 1.0f}) {
      EnterpriseParameters p;
      p.albedo.value = {0.7f, 0.4f, 0.2f};
      p.metallic.value = metallic;
      p.roughness.value = r;
      p.ior = 1.8f;
      p.specular_tint.value = {0.9f, 0.5f, 1.0f};
      const Vec3<double> v = ViewAt(0.6);
      const auto scattering = EnterprisePoint<double>(p).From(v, lighting);
      for (const double phi : {0.3, 2.0, 3.1}) {
        const double z = 0.45, s = std::sqrt(1.0 - z * z);
        const Vec3<double> l{s * std::cos(phi), s * std::sin(phi), z};
        const Vec3<double> sum = v + l, h = sum / std::sqrt(Dot(sum, sum));
        const double alpha = double(r) * double(r), cosine = Dot(v, h);
        const double d = alpha * alpha / (kPi * std::pow(h.z * h.z * (alpha * alpha - 1.0) + 1.0, 2.0));
        const auto lambda = [&](double c) {
          return (std::sqrt(1.0 + alpha * alpha * (1.0 / (c * c) - 1.0)) - 1.0) / 2.0;
        };
        const double m = d / (1.0 + lambda(v.z) + lambda(l.z)) / (4.0 * v.z * l.z);
        const auto e = [&](double c) {
          const auto albedo = lighting.Dfg(c, double(r));
          return albedo.a + albedo.b;
        };
        const auto average = lighting.DfgAverage(double(r));
        const double e_avg = average.a + average.b, base0 = std::pow((1.8 - 1.0) / (1.8 + 1.0), 2.0);
        const double ms = (1.0 - e(v.z)) * (1.0 - e(l.z)) / (kPi * std::max(1.0 - e_avg, 1e-6));
        const auto f_ms = [&](double f0) {
          const double f = f0 * 20.0 / 21.0 + 1.0 / 21.0;
          return f * f * e_avg / (1.0 - f * (1.0 - e_avg));
        };
        const double greatest = base0;  // of F0 times the tint
        const auto reflected = [&](const lanes::SpecularAlbedo<double>& a) {
          return greatest * a.a + a.b + f_ms(greatest) * (1.0 - a.a - a.b);
        };
        const double diffuse = (1.0 - reflected(lighting.Dfg(v.z, double(r)))) *
                               (1.0 - reflected(lighting.Dfg(l.z, double(r)))) / (kPi * (1.0 - reflected(average)));
        const Vec3<double> value = scattering.Direct(l, lighting);
        const double got[3] = {value.x, value.y, value.z};
        for (int c = 0; c < 3; ++c) {
          const double albedo = double(p.albedo.value[c]);
          const double f0 = metallic == 1.0f ? albedo : base0 * double(p.specular_tint.value[c]);
          const double fresnel = f0 + (1.0 - f0) * std::pow(1.0 - cosine, 5.0);
          const double expected = m * fresnel + ms * f_ms(f0) + (1.0 - double(metallic)) * albedo * diffuse;
          EXPECT_NEAR(got[c], expected * l.z, 1e-4 * expected) << metallic << " " << r << " " << phi;
        }
      }
    }
  }
}

TEST(EnterpriseCore, AnisotropyNarrowsTheHighlightAcrossTheTangent) {
  const LightingData data = EnterpriseLighting();
  const LightingView<double> lighting(data);
  for (const float r : {0.1f, 0.3f, 0.7f, 1.0f}) {
    for (const float o : {0.01f, 0.25f, 0.5f, 0.9f, 1.0f}) {
      EnterpriseParameters p;
      p.roughness.value = r;
      p.anisotropy.value = o;
      p.anisotropy_rotation.value = 0.25f;
      const auto s = EnterprisePoint<double>(p).From(ViewAt(0.5), lighting);
      const double least = 0.045 * 0.045, across = std::pow(double(r) * (1.0 - double(o)), 2.0);
      EXPECT_NEAR(s.closure.anisotropic.alpha_t, std::max(double(r) * double(r), least), 1e-6) << r << " " << o;
      EXPECT_NEAR(s.closure.anisotropic.alpha_b, std::max(across, least), 1e-6) << r << " " << o;
      EXPECT_NEAR(s.closure.anisotropic.tangent.y, 1.0, 1e-6) << "a quarter of a turn, counter-clockwise";
    }
  }
}

// The reflection's strength scales its reflectance at all angles, its tint that at normal incidence.
TEST(EnterpriseCore, SpecularScalesTheReflectance) {
  const LightingData data = EnterpriseLighting();
  const LightingView<double> lighting(data);
  EnterpriseParameters p = White();
  p.ior = 2.0f;
  p.specular.value = 0.25f;
  p.specular_tint.value = {1.0f, 0.5f, 0.0f};
  p.metallic.value = 0.3f;
  p.albedo.value = {0.8f, 0.6f, 0.4f};
  const auto s = EnterprisePoint<double>(p).From(ViewAt(0.5), lighting);
  EXPECT_NEAR(s.closure.specular.f0.x, 0.7 * 0.25 / 9.0 + 0.3 * 0.8, 1e-6);
  EXPECT_NEAR(s.closure.specular.f0.y, 0.7 * 0.25 / 9.0 * 0.5 + 0.3 * 0.6, 1e-6);
  EXPECT_NEAR(s.closure.specular.f0.z, 0.3 * 0.4, 1e-6);
  EXPECT_NEAR(s.closure.specular.f90, 0.7 * 0.25 + 0.3, 1e-6);
}

TEST(EnterpriseEmission, IsLambertsAndMayBeNormalised) {
  const LightingData data = EnterpriseLighting();
  const LightingView<double> lighting(data);
  EnterpriseParameters p = White();
  p.emission_color.value = {0.5f, 0.25f, 0.1f};
  p.emission_value = 30.0f;
  const Vec3<double> plain = EnterprisePoint<double>(p).From(ViewAt(0.5), lighting).Emission();
  EXPECT_NEAR(plain.x, 15.0 / kPi, 1e-6);
  EXPECT_NEAR(plain.z, 3.0 / kPi, 1e-6);
  p.emission_energy_normalization = true;
  const Vec3<double> normal = EnterprisePoint<double>(p).From(ViewAt(0.5), lighting).Emission();
  EXPECT_NEAR(normal.x * 0.2126729 + normal.y * 0.7151522 + normal.z * 0.0721750, 30.0 / kPi, 1e-5);
  EXPECT_NEAR(normal.x / normal.y, 2.0, 1e-6);
  p.clearcoat.value = 1.0f;
  const Vec3<double> coated = EnterprisePoint<double>(p).From(ViewAt(1.0), lighting).Emission();
  EXPECT_NEAR(coated.x / normal.x, 0.96, 1e-3);
  p.emission_color.value = glm::vec3(0.0f);
  EXPECT_EQ(EnterprisePoint<double>(p).From(ViewAt(0.5), lighting).Emission().x, 0.0);
}

TEST(EnterpriseMedium, DispersionHasItsAbbeNumber) {
  for (const float abbe : {20.0f, 35.0f, 60.0f}) {
    EnterpriseParameters p;
    p.thin_walled = false;
    p.abbe_number = abbe;
    MaterialFactors f;
    SetEnterpriseFactors(p, f);
    EXPECT_NEAR((double(f.ior[1]) - 1.0) / (double(f.ior[2]) - double(f.ior[0])), double(abbe), 1e-3 * double(abbe));
    EXPECT_EQ(f.ior[1], 1.5f);
  }
}

TEST(EnterpriseMedium, LeavesTheColourAfterTheDistance) {
  EnterpriseParameters p;
  p.thin_walled = false;
  p.transparency.value = 1.0f;
  p.attenuation_color = {0.5f, 0.9f, 1.0f};
  p.attenuation_distance = 0.02f;
  p.thickness = 0.02f;
  const LightingData data = EnterpriseLighting();
  const LightingView<double> lighting(data);
  const auto s = EnterprisePoint<double>(p).From(ViewAt(1.0), lighting);
  EXPECT_NEAR(s.Tint().x / s.Tint().z, 0.5, 1e-5);
  EXPECT_NEAR(s.Tint().y / s.Tint().z, 0.9, 1e-5);
  p.attenuation_distance = 0.0f;
  EXPECT_NEAR(MaxComponent(EnterprisePoint<double>(p).From(ViewAt(1.0), lighting).Tint()), 0.0, 1e-30);
}

TEST(EnterpriseMedium, AlbedoOfOneScatteringEvent) {
  EXPECT_NEAR(SingleScatteringAlbedo(0.0), 0.0, 1e-4);
  EXPECT_NEAR(SingleScatteringAlbedo(1.0), 1.0, 1e-4);
  double last = -1.0;
  for (double m = 0.0; m <= 1.0; m += 0.05) {
    const double one = SingleScatteringAlbedo(m);
    EXPECT_GT(one, last);
    EXPECT_GE(one, m - 1e-4) << "scattering many times absorbs more";
    last = one;
  }
}

TEST(EnterpriseProfile, Of2022xHasNoFilmAndTransmitsTheAlbedo) {
  EnterpriseParameters p = White();
  p.thin_film.value = 1.0f;
  p.translucency.value = 1.0f;
  p.albedo.value = {0.25f, 0.5f, 0.75f};
  p.translucency_color.value = {0.9f, 0.1f, 0.1f};
  EXPECT_TRUE(EnterprisePoint<double>(p).Has(kIridescence));
  const LightingData data = EnterpriseLighting();
  const LightingView<double> lighting(data);
  EXPECT_NEAR(EnterprisePoint<double>(p).From(ViewAt(0.5), lighting).in.diffuse_transmission.color.x, 0.9, 1e-6);
  p.profile = EnterpriseProfile::V2022x;
  EXPECT_FALSE(EnterprisePoint<double>(p).Has(kIridescence));
  EXPECT_NEAR(EnterprisePoint<double>(p).From(ViewAt(0.5), lighting).in.diffuse_transmission.color.x, 0.25, 1e-6);
}

// --- Energy ----------------------------------------------------------------------------------------------------------

struct Layer {
  std::string name;
  std::function<void(EnterpriseParameters&, float)> set;  // stronger with the factor, in [0, 1]
  double least;                                           // of what the white furnace must keep
};

std::vector<Layer> Layers() {
  using P = EnterpriseParameters;
  std::vector<Layer> layers = {
      {"core", [](P& p, float f) { p.metallic.value = f; }, 0.98},
      {"roughness", [](P& p, float f) { p.roughness.value = f; }, 0.98},
      {"specular", [](P& p, float f) { p.specular.value = f; }, 0.98},
      {"ior", [](P& p, float f) { p.ior = 1.0f + 2.0f * f; }, 0.98},
      {"anisotropy", [](P& p, float f) { p.anisotropy.value = f; }, 0.98},
      {"anisotropic metal", [](P& p, float f) { p.anisotropy.value = f, p.metallic.value = 1.0f; }, 0.97},
      {"clear coat", [](P& p, float f) { p.clearcoat.value = f; }, 0.98},
      {"rough clear coat", [](P& p, float f) { p.clearcoat.value = f, p.clearcoat_roughness.value = 0.8f; }, 0.98},
      {"sheen", [](P& p, float f) { p.sheen_color.value = glm::vec3(f); }, 0.98},
      {"smooth sheen", [](P& p, float f) { p.sheen_color.value = glm::vec3(f), p.sheen_roughness.value = 0.2f; }, 0.97},
      {"film", [](P& p, float f) { p.thin_film.value = f; }, 0.98},
      {"film on metal", [](P& p, float f) { p.thin_film.value = f, p.metallic.value = 1.0f; }, 0.9},
      {"translucency", [](P& p, float f) { p.translucency.value = f; }, 0.98},
      {"transparency", [](P& p, float f) { p.transparency.value = f; }, 0.98},
      {"medium",
       [](P& p, float f) {
         p.transparency.value = f, p.thin_walled = false, p.thickness = 0.01f;
         p.attenuation_color = glm::vec3(0.3f), p.attenuation_distance = 0.01f, p.subsurface_color = glm::vec3(1.0f);
       },
       0.98},
      // Tilted flakes reflect light into the surface, which the specification does not give back.
      {"flat flakes", [](P& p, float f) { p.flake_coverage.value = f; }, 0.96},
      {"tilted flakes", [](P& p, float f) { p.flake_coverage.value = f, p.flake_roughness.value = 0.25f; }, 0.5},
      {"rough flakes", [](P& p, float f) { p.flake_coverage.value = f, p.flake_roughness.value = 1.0f; }, 0.49},
  };
  layers.push_back({"all of them",
                    [](P& p, float f) {
                      p.metallic.value = 0.3f, p.clearcoat.value = f, p.sheen_color.value = glm::vec3(0.5f * f);
                      p.thin_film.value = f, p.anisotropy.value = 0.5f * f, p.translucency.value = 0.5f * f;
                      p.transparency.value = 0.4f * f, p.flake_coverage.value = 0.5f * f,
                      p.flake_roughness.value = 0.3f;
                    },
                    0.7});
  return layers;
}

// The light that reaches the view from a white environment, behind the surface too.
double FromFurnace(const EnterpriseParameters& p, double n_dot_v, const LightingView<double>& lighting) {
  const auto s = EnterprisePoint<double>(p).From(ViewAt(n_dot_v), lighting);
  Vec3<double> radiance = s.Environment(lighting);
  if (s.closure.Has(kTransmission)) radiance += s.Tint();
  return MaxComponent(radiance);
}

TEST(EnterpriseFurnace, ConstantEnvironment) {
  const auto environment = PrefilterEnvironment(ConstantImage());
  const LightingData data = EnterpriseLighting(environment.get());
  const LightingView<double> lighting(data);
  for (const Layer& layer : Layers()) {
    double least = 2.0, most = 0.0;
    for (const float factor : {0.0f, 0.5f, 1.0f}) {
      for (const double n_dot_v : kNDotV) {
        EnterpriseParameters p = White();
        layer.set(p, factor);
        const double share = FromFurnace(p, n_dot_v, lighting);
        least = std::min(least, share), most = std::max(most, share);
      }
    }
    EXPECT_LE(most, 1.005) << layer.name;
    EXPECT_GE(least, layer.least) << layer.name;
    RecordProperty(layer.name, std::to_string(least) + " to " + std::to_string(most));
    std::printf("  environment: %-18s %.4f to %.4f\n", layer.name.c_str(), least, most);
  }
}

// The same by punctual lights: half vectors, uniform in the logarithm of their tangent, and directions behind.
double FromLights(const EnterpriseParameters& p, double n_dot_v, const LightingView<double>& lighting) {
  const Vec3<double> view = ViewAt(n_dot_v);
  const auto s = EnterprisePoint<double>(p).From(view, lighting);
  constexpr int kPolar = 200, kBehind = 64;
  const int azimuths = s.closure.Has(kAnisotropy) ? 1600 : 48;  // so that the narrowest highlight is resolved
  const double low = std::log(4e-5), high = std::log(3e4), step = (high - low) / kPolar;
  Vec3<double> sum{0.0, 0.0, 0.0};
  for (int i = 0; i < kPolar; ++i) {
    const double tangent = std::exp(low + (i + 0.5) * step), c = 1.0 / std::sqrt(1.0 + tangent * tangent);
    const double sine = tangent * c;
    for (int j = 0; j < azimuths; ++j) {
      const double phi = 2.0 * kPi * (j + 0.5) / azimuths;
      const Vec3<double> half{sine * std::cos(phi), sine * std::sin(phi), c};
      const double v_dot_h = Dot(view, half);
      const Vec3<double> light = half * (2.0 * v_dot_h) - view;
      if (v_dot_h <= 0.0 || light.z <= 0.0) continue;
      sum += s.Direct(light, lighting) * (4.0 * v_dot_h * sine * sine * c * step * 2.0 * kPi / azimuths);
    }
  }
  for (int i = 0; s.TransmitsDiffusely() && i < kBehind; ++i) {
    const double cosine = (i + 0.5) / kBehind;
    sum += s.Direct({std::sqrt(1.0 - cosine * cosine), 0.0, -cosine}, lighting) * (2.0 * kPi / kBehind);
  }
  if (s.closure.Has(kTransmission)) sum += s.Tint();
  return MaxComponent(sum);
}

TEST(EnterpriseFurnace, LightsOfEveryDirection) {
  const LightingData data = EnterpriseLighting();
  const LightingView<double> lighting(data);
  for (const Layer& layer : Layers()) {
    double least = 2.0, most = 0.0;
    for (const float factor : {0.0f, 0.5f, 1.0f}) {
      for (const double n_dot_v : {0.1, 0.6, 1.0}) {
        EnterpriseParameters p = White();
        layer.set(p, factor);
        const double share = FromLights(p, n_dot_v, lighting);
        least = std::min(least, share), most = std::max(most, share);
      }
    }
    EXPECT_LE(most, 1.005) << layer.name;
    EXPECT_GE(least, layer.least - 0.01) << layer.name;
    RecordProperty(layer.name, std::to_string(least) + " to " + std::to_string(most));
    std::printf("  lights: %-18s %.4f to %.4f\n", layer.name.c_str(), least, most);
  }
}

// --- Precisions and extremes -----------------------------------------------------------------------------------------

template <class T>
Vec3<T> Convert(const Vec3<double>& v) {
  return {T(static_cast<float>(v.x)), T(static_cast<float>(v.y)), T(static_cast<float>(v.z))};
}
double First(float x) { return double(x); }
double First(lanes::Float x) {
  float values[lanes::kMaxLanes];
  lanes::Store(x, values);
  return double(values[0]);
}

template <class T>
void ExpectLikeDouble(const EnterpriseParameters& p, const LightingData& data, const std::string& name) {
  const LightingView<double> exact(data);
  const LightingView<T> lighting(data);
  for (const double n_dot_v : {0.2, 0.7, 0.99}) {
    const Vec3<double> v = ViewAt(n_dot_v);
    const auto expected = EnterprisePoint<double>(p).From(v, exact);
    const auto got = EnterprisePoint<T>(p).From(Convert<T>(v), lighting);
    for (const Vec3<double>& l : {Vec3<double>{-0.6, 0.0, 0.8}, {0.0, 0.8, 0.6}, {0.48, 0.6, 0.64}, {0.6, 0.0, -0.8}}) {
      const Vec3<double> e = expected.Direct(l, exact);
      const Vec3<T> g = got.Direct(Convert<T>(l), lighting);
      EXPECT_NEAR(First(g.x), e.x, 2e-4 * (e.x + 0.01)) << name << " " << n_dot_v;
      EXPECT_NEAR(First(g.z), e.z, 2e-4 * (e.z + 0.01)) << name << " " << n_dot_v;
    }
    const Vec3<double> e = expected.Environment(exact);
    EXPECT_NEAR(First(got.Environment(lighting).y), e.y, 2e-4 * e.y) << name << " " << n_dot_v;
    EXPECT_NEAR(First(got.Tint().y), expected.Tint().y, 1e-5) << name;
  }
}

TEST(EnterprisePrecision, LanesAndFloatsAreDoublesToRounding) {
  const auto environment = PrefilterEnvironment(ConstantImage());
  const LightingData data = EnterpriseLighting(environment.get());
  for (const Layer& layer : Layers()) {
    EnterpriseParameters p = White();
    layer.set(p, 0.6f);
    ExpectLikeDouble<float>(p, data, layer.name);
    ExpectLikeDouble<lanes::Float>(p, data, layer.name);
  }
}

TEST(EnterpriseExtremes, EverythingIsFinite) {
  const auto environment = PrefilterEnvironment(ConstantImage());
  const LightingData data = EnterpriseLighting(environment.get());
  const LightingView<float> lighting(data);
  constexpr float kMost = 3.4e38f;
  std::uint32_t random = 1;
  const auto pick = [&](std::initializer_list<float> values) {
    random = random * 1664525u + 1013904223u;
    return values.begin()[(random >> 16) % values.size()];
  };
  const auto unit = [&] { return pick({0.0f, 1e-30f, 0.5f, 1.0f}); };
  const auto color = [&] { return glm::vec3(unit(), unit(), unit()); };
  for (int trial = 0; trial < 4000; ++trial) {
    EnterpriseParameters p;
    for (Textured<float>* value :
         {&p.metallic, &p.roughness, &p.anisotropy, &p.anisotropy_rotation, &p.translucency, &p.transparency,
          &p.specular, &p.thin_film, &p.thin_film_thickness, &p.sheen_roughness, &p.flake_coverage, &p.flake_roughness,
          &p.flip_flop, &p.clearcoat, &p.clearcoat_roughness}) {
      value->value = unit();
    }
    for (Textured<glm::vec3>* value : {&p.albedo, &p.translucency_color, &p.specular_tint, &p.sheen_color,
                                       &p.flake_color, &p.flip_flop_color, &p.emission_color}) {
      value->value = color();
    }
    p.flake_size.value = pick({0.0f, 1e-38f, 1.0f, kMost});
    p.texture_scale = pick({0.0f, 1e-38f, 1.0f, kMost});
    p.thin_film_ior = pick({1.0f, 2.5f});
    p.emission_value = pick({0.0f, 1e30f});
    p.emission_energy_normalization = pick({0.0f, 1.0f}) == 1.0f;
    p.thin_walled = pick({0.0f, 1.0f}) == 1.0f;
    p.ior = pick({1.0f, 1.5f, 1e3f, kMost});
    p.abbe_number = pick({0.0f, 1e-38f, 20.0f, kMost});
    p.attenuation_color = color();
    p.attenuation_distance = pick({0.0f, 1e-38f, 1.0f, std::numeric_limits<float>::infinity()});
    p.subsurface_color = color();
    p.subsurface_anisotropy = pick({-1.0f, 0.0f, 1.0f});
    p.thickness = pick({0.0f, 1e-38f, 1.0f, 1e30f});
    EnterprisePoint<float> point(p);
    point.uv.uv = {pick({0.0f, -7.3f, kMost}), pick({0.0f, 0.7f, -kMost})};
    point.uv.dx = {pick({0.0f, 1e-3f, 1e30f}), 0.0f};
    for (const Vec3<float> view : {Vec3<float>{0, 0, 1}, {0.6f, 0, 0.8f}, {1, 0, 0}, {0.6f, 0, -0.8f}}) {
      const auto s = point.From(view, lighting);
      const auto good = [](const Vec3<float>& v) {
        return std::isfinite(v.x + v.y + v.z) && v.x >= 0.0f && v.y >= 0.0f && v.z >= 0.0f;
      };
      EXPECT_TRUE(good(s.Environment(lighting))) << trial << " " << view.z;
      EXPECT_TRUE(good(s.Emission())) << trial;
      EXPECT_TRUE(good(s.Tint())) << trial;
      for (const Vec3<float> light : {Vec3<float>{0, 0, 1}, {-0.6f, 0, 0.8f}, {-1, 0, 1e-6f}, {0, 0, -1}, {0, 0, 0}}) {
        EXPECT_TRUE(good(s.Direct(light, lighting))) << trial << " " << view.z << " " << light.z;
        EXPECT_TRUE(!s.closure.Has(kTransmission) || good(s.Transmitted(light, lighting))) << trial;
      }
    }
  }
}

}  // namespace
}  // namespace facet
