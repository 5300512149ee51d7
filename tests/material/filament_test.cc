// The model "filament": its shading models against a second implementation of their formulas, and their properties.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

#include "filament_oracle.h"
#include "filament_source.h"

namespace facet {
namespace {

using filament_test::Scattering;
using filament_test::Tables;
using filament_test::Uniform;
using Shading = FilamentParameters::Shading;
namespace oracle = filament_oracle;
namespace lanes = HWY_NAMESPACE;
using lanes::Vec3;
using lanes::Vec4;

constexpr double kPi = oracle::kPi;
constexpr int kTrials = 1000;

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double operator()() { return double(engine_()) / 4294967296.0; }
  bool Half() { return (*this)() < 0.5; }
  // Exactly a float, as parameters are.
  double Number() { return double(static_cast<float>((*this)())); }
  glm::dvec3 Color() {
    const double x = Number(), y = Number();
    return {x, y, Number()};
  }
  glm::dvec3 Direction(double least_z, double most_z) {
    const double z = least_z + (most_z - least_z) * (*this)(), phi = 2.0 * kPi * (*this)();
    const double s = std::sqrt(1.0 - z * z);
    return {s * std::cos(phi), s * std::sin(phi), z};
  }

 private:
  std::mt19937 engine_;
};

template <class T>
Vec3<T> ToVec(const glm::dvec3& v) {
  return {T(v.x), T(v.y), T(v.z)};
}
template <class T>
glm::dvec3 FromVec(const Vec3<T>& v) {
  return {double(v.x), double(v.y), double(v.z)};
}

FilamentParameters BlockOf(const oracle::Inputs& in, Shading shading) {
  FilamentParameters p;
  p.shading_model = shading;
  p.base_color.value = glm::vec4(glm::vec3(in.baseColor), 1.0f);
  p.metallic.value = static_cast<float>(in.metallic);
  p.roughness.value = static_cast<float>(in.roughness);
  p.reflectance.value = static_cast<float>(in.reflectance);
  if (in.hasSpecularFactor) {
    p.specular_factor.value = static_cast<float>(in.specularFactor);
    p.specular_color_factor.value = glm::vec3(in.specularColorFactor);
  }
  if (in.hasSheen) {
    p.sheen_color.value = glm::vec3(in.sheenColor);
    p.sheen_roughness.value = static_cast<float>(in.sheenRoughness);
  }
  if (in.hasClearCoat) {
    p.clear_coat.value = static_cast<float>(in.clearCoat);
    p.clear_coat_roughness.value = static_cast<float>(in.clearCoatRoughness);
    p.clear_coat_normal.value = glm::vec3(in.clearCoatNormal);
    p.clear_coat_ior_change = in.clearCoatIorChange;
  }
  if (in.hasAnisotropy) p.anisotropy.value = static_cast<float>(in.anisotropy);
  p.specular_color.value = glm::vec3(in.specularColor);
  p.glossiness.value = static_cast<float>(in.glossiness);
  if (in.transmission > 0.0) {
    p.refraction_mode = FilamentParameters::RefractionMode::ScreenSpace;
    p.transmission.value = static_cast<float>(in.transmission);
  }
  if (in.hasSubsurfaceColor) p.subsurface_color.value = glm::vec3(in.subsurfaceColor);
  p.subsurface_power.value = static_cast<float>(in.subsurfacePower);
  p.thickness.value = static_cast<float>(in.thickness);
  return p;
}

oracle::Inputs RandomInputs(Random& random, Shading shading) {
  oracle::Inputs in;
  in.baseColor = random.Color();
  in.metallic = random.Half() ? random.Number() : std::round(random());
  in.roughness = random.Number();
  in.reflectance = random.Number();
  in.isSpecularGlossiness = shading == Shading::SpecularGlossiness;
  in.specularColor = random.Color();
  in.glossiness = random.Number();
  in.hasSubsurfaceColor = random.Half();
  in.subsurfaceColor = random.Color();
  in.subsurfacePower = double(static_cast<float>(20.0 * random()));
  in.thickness = random.Number();
  in.hasSheen = random.Half();
  in.sheenColor = random.Color();
  in.sheenRoughness = random.Number();
  if (shading == Shading::Cloth || shading == Shading::Subsurface) return in;
  in.hasSpecularFactor = !in.isSpecularGlossiness && random.Half();
  in.specularFactor = 0.99 * random.Number();
  in.specularFactor = double(static_cast<float>(in.specularFactor));
  in.specularColorFactor = glm::dvec3(glm::vec3(2.0 * random.Color()));
  in.hasClearCoat = random.Half();
  in.clearCoat = random.Number();
  in.clearCoatRoughness = random.Number();
  in.clearCoatIorChange = random.Half();
  if (random.Half()) in.clearCoatNormal = glm::dvec3(glm::vec3(random.Direction(0.7, 1.0)));
  in.hasAnisotropy = random.Half();
  in.anisotropy = double(static_cast<float>(2.0 * random() - 1.0));
  if (random.Half()) in.transmission = random.Number();
  return in;
}

// The oracle's value for one model.
glm::dvec3 Expected(const oracle::Inputs& in, Shading shading, const glm::dvec3& v, const glm::dvec3& l,
                    const lanes::LightingView<double>& lighting) {
  const lanes::SpecularAlbedo<double> albedo = lighting.Dfg(v.z, oracle::PixelOf(in).roughness);
  const oracle::Dfg dfg{albedo.b, albedo.a + albedo.b};
  if (shading == Shading::Subsurface) return oracle::Subsurface(in, v, l, dfg);
  const bool is_cloth = shading == Shading::Cloth;
  const double cloth = lighting.ClothAlbedo(v.z, std::max(is_cloth ? in.roughness : in.sheenRoughness, double(0.07f)));
  if (is_cloth) return oracle::Cloth(in, v, l, cloth);
  return oracle::Lit(in, v, l, dfg, cloth);
}

class DirectLight : public testing::TestWithParam<Shading> {};

TEST_P(DirectLight, IsThatOfTheFormulas) {
  const LightingData tables = Tables();
  const lanes::LightingView<double> lighting(tables);
  Random random(11);
  double worst = 0.0, worst_float = 0.0;
  for (int i = 0; i < kTrials; ++i) {
    const oracle::Inputs in = RandomInputs(random, GetParam());
    const glm::dvec3 v = random.Direction(0.02, 0.999), l = random.Direction(-0.99, 0.999);
    const FilamentParameters block = BlockOf(in, GetParam());
    const glm::dvec3 expected = Expected(in, GetParam(), v, l, lighting);
    const auto got = FromVec(Scattering<double>(block, ToVec<double>(v), tables).Direct(ToVec<double>(l), lighting));
    const auto single = FromVec(
        Scattering<float>(block, ToVec<float>(v), tables).Direct(ToVec<float>(l), lanes::LightingView<float>(tables)));
    for (int c = 0; c < 3; ++c) {
      // Constants of the project are floats: relative errors of 6e-8 each.
      EXPECT_NEAR(got[c], expected[c], 2e-6 * std::fabs(expected[c]) + 1e-9) << i << " " << c;
      EXPECT_NEAR(single[c], got[c], 2e-4 * std::fabs(got[c]) + 1e-5) << i << " " << c;
      worst = std::max(worst, std::fabs(got[c] - expected[c]) / std::max(std::fabs(expected[c]), 1e-3));
      worst_float = std::max(worst_float, std::fabs(single[c] - got[c]) / std::max(std::fabs(got[c]), 1e-2));
    }
  }
  RecordProperty("worst", std::to_string(worst));
  std::printf("worst: %.2e of the formulas; float: %.2e of double\n", worst, worst_float);
}

INSTANTIATE_TEST_SUITE_P(Filament, DirectLight,
                         testing::Values(Shading::Lit, Shading::SpecularGlossiness, Shading::Cloth,
                                         Shading::Subsurface));

// --- The environment ------------------------------------------------------------------------------------------------

FilamentParameters White(float metallic, float roughness) {
  FilamentParameters p;
  p.metallic.value = metallic;
  p.roughness.value = roughness;
  return p;
}

Vec3<double> ViewAt(double n_dot_v) { return {std::sqrt(1.0 - n_dot_v * n_dot_v), 0.0, n_dot_v}; }

constexpr double kNDotV[] = {0.01, 0.03, 0.1, 0.3, 0.6, 1.0};
constexpr float kRoughness[] = {0.0f, 0.045f, 0.1f, 0.3f, 0.5f, 0.7f, 1.0f};

// What a white surface reflects of a white environment: all of it if it is a metal, and E f0 (1 / (A + B) - 1) more
// than all if it is a dielectric, because the compensation of the reflection is not taken from the diffuse base.
TEST(FilamentFurnace, GainsOnlyTheCompensationOfDielectrics) {
  const LightingData tables = Tables();
  const Uniform<double> lighting(tables);
  double most = 0.0;
  for (const float roughness : kRoughness) {
    for (const double n_dot_v : kNDotV) {
      const auto metal = Scattering<double>(White(1.0f, roughness), ViewAt(n_dot_v), tables);
      EXPECT_NEAR(metal.Environment(lighting).y, 1.0, 1e-6);
      const auto s = Scattering<double>(White(0.0f, roughness), ViewAt(n_dot_v), tables);
      const auto [a, b] = lighting.Dfg(n_dot_v, std::max(double(roughness), double(0.045f)));
      const double gain = (0.04 * a + b) * 0.04 * (1.0 / (a + b) - 1.0);
      EXPECT_NEAR(s.Environment(lighting).y, 1.0 + gain, 1e-6) << roughness << " " << n_dot_v;
      most = std::max(most, gain);
    }
  }
  EXPECT_LT(most, 0.0038);
  std::printf("most gained: %.5f\n", most);
}

// Under punctual lights from everywhere: the diffuse base is not dimmed by what is reflected above it, so that a white
// dielectric reflects its E, compensated, more than it receives; a metal reflects all.
TEST(FilamentFurnace, OfPunctualLightGainsTheReflectionOfDielectrics) {
  const LightingData tables = Tables();
  const lanes::LightingView<double> lighting(tables);
  for (const float roughness : {0.4f, 0.7f, 1.0f}) {
    for (const double n_dot_v : {0.1, 0.5, 1.0}) {
      for (const float metallic : {0.0f, 1.0f}) {
        const auto s = Scattering<double>(White(metallic, roughness), ViewAt(n_dot_v), tables);
        double sum = 0.0;
        constexpr int kPolar = 400, kAzimuth = 200;
        for (int j = 0; j < kPolar; ++j) {
          const double cosine = (j + 0.5) / kPolar, sine = std::sqrt(1.0 - cosine * cosine);
          for (int k = 0; k < kAzimuth; ++k) {
            const double phi = kPi * (k + 0.5) / kAzimuth;
            sum += s.Direct({sine * std::cos(phi), sine * std::sin(phi), cosine}, lighting).y;
          }
        }
        sum *= 2.0 * kPi / (kPolar * kAzimuth);
        const auto [a, b] = lighting.Dfg(n_dot_v, double(roughness));
        const double f0 = metallic > 0.5f ? 1.0 : 0.04;
        const double expected = (1.0 - double(metallic)) + (f0 * a + b) * (1.0 + f0 * (1.0 / (a + b) - 1.0));
        EXPECT_NEAR(sum, expected, 0.003) << roughness << " " << n_dot_v << " " << metallic;
      }
    }
  }
}

// Each layer's own share: coat Fc, then sheen, then the base.
TEST(FilamentFurnace, OfLayersOfClothAndOfSubsurfaceIsClosedForm) {
  const LightingData tables = Tables();
  const Uniform<double> lighting(tables);
  Random random(5);
  for (int i = 0; i < kTrials; ++i) {
    const double z = 0.01 + 0.99 * random();
    const Vec3<double> view = ViewAt(z);
    oracle::Inputs in = RandomInputs(random, Shading::Lit);
    in.clearCoatNormal = {0.0, 0.0, 1.0};
    in.hasAnisotropy = false;
    const oracle::Pixel p = oracle::PixelOf(in);
    const auto [a, b] = lighting.Dfg(z, p.roughness);
    const glm::dvec3 e = p.f0 * a + p.f90 * b;
    glm::dvec3 expected = e * oracle::Compensation(p, {b, a + b}) + p.diffuse * (1.0 - e) * (1.0 - in.transmission);
    if (in.hasSheen) {
      const double cloth = std::min(lighting.ClothAlbedo(z, std::max(in.sheenRoughness, double(0.07f))), 1.0);
      expected = expected * (1.0 - oracle::Max3(in.sheenColor) * cloth) + in.sheenColor * cloth;
    }
    if (in.hasClearCoat) {
      const double fresnel = (0.04 + 0.96 * std::pow(1.0 - z, 5.0)) * in.clearCoat;
      expected = expected * (1.0 - fresnel) + fresnel;
    }
    const auto lit = FromVec(Scattering<double>(BlockOf(in, Shading::Lit), view, tables).Environment(lighting));
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(lit[c], expected[c], 2e-6) << i;

    const oracle::Inputs cloth = RandomInputs(random, Shading::Cloth);
    const glm::dvec3 sheen = cloth.hasSheen ? cloth.sheenColor : glm::sqrt(cloth.baseColor);
    const double albedo = std::min(lighting.ClothAlbedo(z, std::max(cloth.roughness, double(0.07f))), 1.0);
    glm::dvec3 base = cloth.baseColor * (1.0 - sheen * albedo);
    if (cloth.hasSubsurfaceColor) {
      base = base * oracle::Saturate((z + 0.5) / 2.25) * oracle::Saturate(cloth.subsurfaceColor + z);
    }
    const auto fabric = FromVec(Scattering<double>(BlockOf(cloth, Shading::Cloth), view, tables).Environment(lighting));
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(fabric[c], base[c] + sheen[c] * albedo, 2e-6) << i;

    const oracle::Inputs skin = RandomInputs(random, Shading::Subsurface);
    const oracle::Pixel q = oracle::PixelOf(skin);
    const auto [qa, qb] = lighting.Dfg(z, q.roughness);
    const glm::dvec3 r = q.f0 * qa + q.f90 * qb;
    const glm::dvec3 tint = skin.hasSubsurfaceColor ? skin.subsurfaceColor : glm::dvec3(1.0);
    const glm::dvec3 passed = tint * ((1.0 - skin.thickness) / kPi);
    const auto soft =
        FromVec(Scattering<double>(BlockOf(skin, Shading::Subsurface), view, tables).Environment(lighting));
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(soft[c], r[c] * oracle::Compensation(q, {qb, qa + qb})[c] + q.diffuse[c] * (1.0 - r[c]) + passed[c],
                  2e-6)
          << i;
    }
  }
}

// The integral over all directions of what the reference integrates is what the split sum has under a uniform
// environment: by points that are spread over the sphere and crowd about the mirror direction.
TEST(FilamentEnvironment, IsTheIntegralOfItsIntegrand) {
  const LightingData tables = Tables();
  const Uniform<double> lighting(tables);
  Random random(3);
  double worst = 0.0;
  for (int i = 0; i < 60; ++i) {
    const auto shading = static_cast<Shading>(i % 4);
    oracle::Inputs in = RandomInputs(random, shading);
    in.hasAnisotropy = false;  // its energy is that of the isotropic lobe, in Filament
    in.clearCoatNormal = {0.0, 0.0, 1.0};
    in.roughness = std::max(in.roughness, 0.35), in.clearCoatRoughness = std::max(in.clearCoatRoughness, 0.35);
    in.roughness = double(static_cast<float>(in.roughness));
    in.glossiness = std::min(in.glossiness, 0.65);
    in.sheenRoughness = std::max(in.sheenRoughness, 0.2);
    const double z = 0.15 + 0.85 * random();
    FilamentParameters block = BlockOf(in, shading);
    block.ambient_occlusion.value = static_cast<float>(random());
    const auto s = Scattering<double>(block, ViewAt(z), tables);
    glm::dvec3 sum(0.0);
    constexpr int kPolar = 800, kAzimuth = 200;
    for (int j = 0; j < kPolar; ++j) {
      for (int k = 0; k < kAzimuth; ++k) {
        const double cosine = 1.0 - (j + 0.5) * 2.0 / kPolar, phi = kPi * (k + 0.5) / kAzimuth;
        const double sine = std::sqrt(1.0 - cosine * cosine);
        sum += FromVec(s.FromEnvironment({sine * std::cos(phi), sine * std::sin(phi), cosine}, lighting));
      }
    }
    sum *= 4.0 * kPi / (kPolar * kAzimuth);
    const auto expected = FromVec(s.Environment(lighting));
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(sum[c], expected[c], 0.004 + 0.004 * expected[c]) << i << " " << int(shading) << " " << z;
      worst = std::max(worst, std::fabs(sum[c] - expected[c]));
    }
  }
  std::printf("worst: %.5f\n", worst);
}

// Where the albedo exceeds 1, at grazing views of smooth fibres, the model divides by it.
TEST(FilamentFibres, AreNormalisedAndTheirAlbedoIsThatOfTheTable) {
  for (const double roughness : {0.07, 0.2, 0.5, 0.8, 1.0}) {
    double sum = 0.0;  // of D cos over the hemisphere
    for (int i = 0; i < 20000; ++i) {
      const double theta = 0.5 * kPi * (i + 0.5) / 20000;
      const Vec3<double> half{std::sin(theta), 0.0, std::cos(theta)};
      // Of the product, without Neubelt's visibility.
      const double d = lanes::filament::Fibres<double>({0.0, 0.0, 1.0}, half, 0.5, 0.5, 1.0 / (roughness * roughness)) /
                       oracle::V_Neubelt(0.5, 0.5);
      sum += d * std::cos(theta) * std::sin(theta) * 2.0 * kPi * (0.5 * kPi / 20000);
    }
    EXPECT_NEAR(sum, 1.0, 1e-5) << roughness;
    for (const double z : {0.005, 0.05, 0.2, 0.5, 1.0}) {
      double reflected = 0.0;
      constexpr int kPolar = 600, kAzimuth = 600;
      const glm::dvec3 v{std::sqrt(1.0 - z * z), 0.0, z};
      for (int j = 0; j < kPolar; ++j) {
        const double t = (j + 0.5) / kPolar, c = t * t, sine = std::sqrt(1.0 - c * c);
        for (int k = 0; k < kAzimuth; ++k) {
          const double w = (k + 0.5) / kAzimuth, phi = kPi * (1.0 - w * w);
          const glm::dvec3 l{sine * std::cos(phi), sine * std::sin(phi), c}, h = glm::normalize(v + l);
          reflected += oracle::D_Charlie(h.z, roughness * roughness) * oracle::V_Neubelt(z, c) * c *
                       (2.0 * t / kPolar) * (4.0 * kPi * w / kAzimuth);
        }
      }
      EXPECT_NEAR(IntegrateClothAlbedo(z, roughness), reflected, 2e-4) << roughness << " " << z;
      if (reflected > 1.0) std::printf("roughness %.2f, n.v %.3f: albedo %.3f\n", roughness, z, reflected);
      const LightingData tables = Tables();
      EXPECT_NEAR(lanes::LightingView<double>(tables).ClothAlbedo(z, roughness), reflected,
                  2e-3 * std::max(reflected, 1.0));
    }
  }
}

// --- Properties -----------------------------------------------------------------------------------------------------

// The microfacets, the coat and the fibres are reciprocal. What scales them by the view alone is not: the compensation,
// and the share that sheen leaves.
TEST(Filament, IsReciprocalButForWhatTheViewScales) {
  const LightingData tables = Tables();
  const lanes::LightingView<double> lighting(tables);
  Random random(2);
  for (int i = 0; i < kTrials; ++i) {
    oracle::Inputs in = RandomInputs(random, Shading::Lit);
    in.hasSheen = false;
    const Vec3<double> a = ToVec<double>(random.Direction(0.01, 1.0)), b = ToVec<double>(random.Direction(0.01, 1.0));
    const auto from_a = Scattering<double>(BlockOf(in, Shading::Lit), a, tables);
    const auto from_b = Scattering<double>(BlockOf(in, Shading::Lit), b, tables);
    const auto specular = [&](const auto& s, const Vec3<double>& light) {
      return lanes::filament::DirectSpecular<double>(s, light, lanes::IncidenceFrom(s.at, light)).y;
    };
    const double ab = specular(from_a, b);
    EXPECT_NEAR(ab, specular(from_b, a), 1e-9 * ab);
    oracle::Inputs cloth = RandomInputs(random, Shading::Cloth);
    cloth.hasSubsurfaceColor = false;
    cloth.roughness = double(static_cast<float>(0.4 + 0.6 * cloth.roughness));  // its albedo is below 1
    const FilamentParameters block = BlockOf(cloth, Shading::Cloth);
    const double forth = Scattering<double>(block, a, tables).Direct(b, lighting).y / b.z;
    EXPECT_NEAR(forth, Scattering<double>(block, b, tables).Direct(a, lighting).y / a.z, 1e-9 * forth);
  }
}

TEST(Filament, IsFiniteAtExtremes) {
  const LightingData tables = Tables();
  const Uniform<float> lighting(tables);
  const Vec3<float> directions[] = {{0, 0, 1},  {1, 0, 0},        {-1, 0, 0},     {0.8f, 0, 0.6f}, {-0.8f, 0, 0.6f},
                                    {0, 0, -1}, {0.8f, 0, -0.6f}, {-1, 0, 1e-7f}, {0, 0, 0}};
  int count = 0;
  for (int model = 0; model < 5; ++model) {
    for (const float roughness : {0.0f, 0.5f, 1.0f}) {
      for (const float metallic : {0.0f, 0.5f, 1.0f}) {
        for (const float coat : {0.0f, 1.0f}) {
          for (const float anisotropy : {-1.0f, 0.0f, 1.0f}) {
            for (const float color : {0.0f, 1.0f}) {
              FilamentParameters p = White(metallic, roughness);
              p.base_color.value = glm::vec4(color, color, color, 1.0f);
              p.shading_model = static_cast<Shading>(model);
              p.clear_coat.value = coat;
              p.anisotropy.value = anisotropy;
              p.glossiness.value = 1.0f - roughness;
              p.specular_color.value = glm::vec3(color);
              p.sheen_color.value = glm::vec3(1.0f);
              p.sheen_roughness.value = roughness;
              p.reflectance.value = metallic;
              p.ambient_occlusion.value = metallic;
              p.thickness.value = coat;
              p.specular_ambient_occlusion = color > 0.5f ? FilamentParameters::SpecularOcclusion::BentNormals
                                                          : FilamentParameters::SpecularOcclusion::Simple;
              for (const Vec3<float>& view : directions) {
                const auto s = Scattering<float>(p, view, tables);
                const auto check = [&](const Vec3<float>& v) {
                  ++count;
                  return std::isfinite(v.x + v.y + v.z) && v.x >= 0.0f && v.y >= 0.0f && v.z >= 0.0f;
                };
                EXPECT_TRUE(check(s.Environment(lighting))) << model << " " << roughness << " " << metallic;
                for (const Vec3<float>& light : directions) {
                  EXPECT_TRUE(check(s.Direct(light, lighting)))
                      << model << " " << roughness << " " << metallic << " " << view.x << " " << light.x;
                  EXPECT_TRUE(check(s.FromEnvironment(light, lighting)))
                      << model << " " << roughness << " " << metallic << " " << coat << " " << anisotropy << " "
                      << color << ": " << view.x << " " << view.z << ", " << light.x << " " << light.z << ": "
                      << s.FromEnvironment(light, lighting).x;
                }
              }
            }
          }
        }
      }
    }
  }
  EXPECT_GT(count, 50000);
}

}  // namespace
}  // namespace facet
