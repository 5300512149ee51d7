// The model "filament": its terms apart from reflection: indices, occlusion, emission, blending and refraction.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "filament_source.h"

namespace facet {
namespace {

using filament_test::Scattering;
using filament_test::Source;
using filament_test::Tables;
using filament_test::Uniform;
using P = FilamentParameters;
namespace lanes = HWY_NAMESPACE;
namespace terms = lanes::filament;
using lanes::Vec3;
using lanes::Vec4;

constexpr double kPi = 3.14159265358979324;

TEST(FilamentTerms, ReflectanceAndIndexAreThoseOfTheTable) {
  // Filament Materials Guide, table of common reflectances: 0.35 is water's 1.33 and 2 %, 0.5 is 1.5 and 4 %, 1 is 2.33
  // and 16 %.
  EXPECT_NEAR(terms::F0OfReflectance(0.5), 0.04, 1e-7);
  EXPECT_NEAR(terms::IndexOfF0(terms::F0OfReflectance(0.35)), 1.33, 0.005);
  EXPECT_NEAR(terms::IndexOfF0(terms::F0OfReflectance(1.0)), 2.33, 0.005);
  for (double ior = 1.0; ior < 3.0; ior += 0.1) EXPECT_NEAR(terms::IndexOfF0(terms::F0OfIndex(ior)), ior, 1e-6);
}

// The fit against the change of index itself: from f0 to the index, and back with 1.5 in place of air.
TEST(FilamentTerms, CoatChangesTheIndexAsTheExactFormulaDoes) {
  double worst = 0.0;
  for (double f = 0.04; f < 0.99; f += 0.01) {
    const double ior = (1.0 + std::sqrt(f)) / (1.0 - std::sqrt(f));
    const double exact = std::pow((ior - 1.5) / (ior + 1.5), 2.0);
    const double fit = terms::F0UnderCoat<double>({f, f, f}).y;
    worst = std::max(worst, std::fabs(fit - exact));
  }
  EXPECT_LT(worst, 0.016);
  std::printf("worst: %.4f\n", worst);
}

TEST(FilamentTerms, WrappedCosineKeepsTheEnergyOfTheCosine) {
  for (const float w : {0.0f, 0.25f, 0.5f, 1.0f}) {
    double sum = 0.0;
    for (int i = 0; i < 20000; ++i) sum += terms::WrappedCosine(-1.0 + 2.0 * (i + 0.5) / 20000, w) * 2.0 * kPi / 10000;
    EXPECT_NEAR(sum, kPi, 1e-5) << w;
  }
}

// --- Occlusion ------------------------------------------------------------------------------------------------------

TEST(FilamentOcclusion, ChangesNothingWhereAllIsVisible) {
  for (double alpha = 0.002; alpha < 1.0; alpha += 0.05) {
    for (double z = 0.001; z < 1.0; z += 0.1) {
      EXPECT_NEAR(terms::SpecularOcclusion(z, 1.0, alpha), 1.0, 1e-12);
      EXPECT_NEAR(terms::SpecularOcclusion(z, 0.0, alpha), 0.0, 1e-12);
    }
    // A cone of half a right angle about the bent normal, and the cone of the lobe within it.
    EXPECT_NEAR(terms::SpecularOcclusionOfCones<double>({0, 0, 1}, {0, 0, 1}, 1.0, alpha), 1.0, 1e-9);
  }
  for (double albedo = 0.0; albedo <= 1.0; albedo += 0.1) {
    EXPECT_NEAR(terms::MultiBounceOcclusion(1.0, albedo), 1.0, 1e-3);
    EXPECT_EQ(terms::MultiBounceOcclusion(0.0, albedo), 0.0);
    for (double v = 0.0; v <= 1.0; v += 0.05) {
      EXPECT_GE(terms::MultiBounceOcclusion(v, albedo), v);
      EXPECT_GE(terms::MultiBounceOcclusion(v, albedo), terms::MultiBounceOcclusion(v, albedo * 0.5) - 0.02);
    }
  }
}

TEST(FilamentOcclusion, CapsShareWhatGeometrySays) {
  const double a = std::cos(0.4), b = std::cos(0.9);
  EXPECT_NEAR(terms::SharedByCaps(a, b, 1.0), 1.0 - a, 1e-12);             // one within the other
  EXPECT_NEAR(terms::SharedByCaps(a, b, std::cos(0.49)), 1.0 - a, 1e-12);  // just within
  EXPECT_EQ(terms::SharedByCaps(a, b, std::cos(1.31)), 0.0);               // just outside
  // Half-way between it is half of the smaller: the smooth step is odd about its middle.
  EXPECT_NEAR(terms::SharedByCaps(a, b, std::cos(0.9)), 0.5 * (1.0 - a), 1e-9);
}

// Reflections are dimmed, the more so the rougher; emission and punctual light are not.
TEST(FilamentOcclusion, DimsTheEnvironmentAlone) {
  const LightingData tables = Tables();
  const Uniform<double> lighting(tables);
  FilamentParameters p;
  p.roughness.value = 0.4f;
  p.emissive.value = {0.5f, 0.25f, 0.0f, 1.0f};
  const Vec3<double> view{0.6, 0.0, 0.8}, light{0.0, 0.6, 0.8};
  const auto open = Scattering<double>(p, view, tables);
  p.ambient_occlusion.value = 0.3f;
  const auto occluded = Scattering<double>(p, view, tables);
  EXPECT_EQ(open.Direct(light, lighting).x, occluded.Direct(light, lighting).x);
  EXPECT_EQ(open.Emission().x, 0.5);
  EXPECT_EQ(occluded.Emission().x, 0.5);
  const double with_bounces = occluded.Environment(lighting).y;
  p.multi_bounce_ambient_occlusion = false;
  const double without = Scattering<double>(p, view, tables).Environment(lighting).y;
  EXPECT_LT(without, with_bounces);
  EXPECT_LT(with_bounces, open.Environment(lighting).y);
  p.specular_ambient_occlusion = P::SpecularOcclusion::None;
  EXPECT_GT(Scattering<double>(p, view, tables).Environment(lighting).y, without);
}

// --- Emission and unlit ---------------------------------------------------------------------------------------------

TEST(FilamentEmission, OfWeightZeroUndoesTheExposure) {
  const LightingData tables = Tables();
  FilamentParameters p;
  p.exposure = 0.25f;
  for (const float weight : {0.0f, 0.5f, 1.0f}) {
    p.emissive.value = {2.0f, 1.0f, 0.5f, weight};
    const auto e = Scattering<double>(p, {0, 0, 1}, tables).Emission();
    // What the exposed picture shows: Filament's mix(1, exposure, weight).
    EXPECT_NEAR(e.x * 0.25, 2.0 * (1.0 * (1.0 - weight) + 0.25 * weight), 1e-12);
  }
}

TEST(FilamentUnlit, IsItsBaseColorAndEmissionWhateverTheLight) {
  const LightingData tables = Tables();
  const Uniform<double> lighting(tables);
  FilamentParameters p;
  p.shading_model = P::Shading::Unlit;
  p.base_color.value = {0.25f, 0.5f, 0.75f, 1.0f};
  p.emissive.value = {0.5f, 0.0f, 0.0f, 1.0f};
  const auto s = Scattering<double>(p, {0, 0, 1}, tables);
  EXPECT_EQ(s.Emission().x, 0.75);
  EXPECT_EQ(s.Emission().z, 0.75);
  EXPECT_EQ(s.Environment(lighting).y, 0.0);
  EXPECT_EQ(s.Direct({0, 0, 1}, lighting).y, 0.0);
}

// --- Blending -------------------------------------------------------------------------------------------------------

struct Blended {
  glm::dvec3 surface;  // straight alpha
  double alpha;
};
Blended Finished(const FilamentParameters& p, const Vec3<double>& radiance, bool blends) {
  const LightingData tables = Tables();
  const auto shaded =
      Scattering<double>(p, {0, 0, 1}, tables, blends ? MaterialFeatures{kAlphaBlend} : 0).Finish(radiance);
  return {{shaded.color.x, shaded.color.y, shaded.color.z}, shaded.alpha};
}

// The compositor's surface * alpha + behind * (1 - alpha) against Filament's premultiplied formulas.
TEST(FilamentBlending, ComesOutAsPremultipliedBlendingDoes) {
  std::mt19937 engine(4);
  const auto random = [&] { return double(static_cast<float>(double(engine()) / 4294967296.0)); };
  for (int i = 0; i < 1000; ++i) {
    FilamentParameters p;
    const double alpha = i % 10 == 0 ? 0.0 : random();
    p.base_color.value = {1.0f, 1.0f, 1.0f, static_cast<float>(alpha)};
    const Vec3<double> radiance{random() * 3.0, random(), random()};
    const double behind = random() * 2.0;
    p.blending = P::Blending::Transparent;  // the radiance is premultiplied
    const Blended transparent = Finished(p, radiance, true);
    EXPECT_NEAR(transparent.surface.x * transparent.alpha + behind * (1.0 - transparent.alpha),
                radiance.x + behind * (1.0 - alpha), 4e-5);
    p.blending = i % 2 == 0 ? P::Blending::Fade : P::Blending::AlphaMode;
    const Blended fade = Finished(p, radiance, true);
    EXPECT_NEAR(fade.surface.x * fade.alpha + behind * (1.0 - fade.alpha), radiance.x * alpha + behind * (1.0 - alpha),
                1e-12);
    // The post-lighting colour, in all ways and over a surface that fades.
    const glm::dvec4 color{random(), random(), random(), random()};
    const double share = random();
    p.post_lighting_color.value = glm::vec4(color);
    p.post_lighting_mix_factor.value = static_cast<float>(share);
    p.post_lighting_blending = static_cast<P::PostLightingBlending>(i % 5);
    const glm::dvec4 lit(glm::dvec3(radiance.x, radiance.y, radiance.z) * alpha, alpha);
    const glm::dvec4 ways[] = {color, color + lit * (1.0 - color.a), lit + color, lit * color,
                               lit + color * (1.0 - lit)};
    const glm::dvec4 expected = glm::mix(lit, ways[i % 5], share);
    const Blended after = Finished(p, radiance, true);
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(after.surface[c] * after.alpha, expected[c], 1e-9) << i % 5;
    }
    EXPECT_NEAR(after.alpha, std::clamp(expected.a, 0x1p-16, 1.0), 1e-9);
  }
}

// With transparent blending the diffuse base is dimmed by alpha, and the reflection is not.
TEST(FilamentBlending, TransparentKeepsReflections) {
  const LightingData tables = Tables();
  const Uniform<double> lighting(tables);
  FilamentParameters p;
  p.roughness.value = 0.3f;
  p.blending = P::Blending::Transparent;
  p.base_color.value = {1.0f, 1.0f, 1.0f, 0.25f};
  const Vec3<double> view{0.6, 0.0, 0.8};
  const double transparent = Scattering<double>(p, view, tables, kAlphaBlend).Environment(lighting).y;
  p.base_color.value = {0.25f, 0.25f, 0.25f, 1.0f};
  p.blending = P::Blending::Opaque;
  EXPECT_NEAR(transparent, Scattering<double>(p, view, tables).Environment(lighting).y, 1e-12);
}

TEST(FilamentBlending, AddMultiplyAndScreenTintWhatIsBehind) {
  const LightingData tables = Tables();
  FilamentParameters p;
  const auto blend = [&](P::Blending how, double surface, double behind) {
    p.blending = how;
    EXPECT_NE(FeaturesOf(p) & kTransmission, 0u);
    const auto s = Scattering<double>(p, {0, 0, 1}, tables);
    lanes::Shaded<double> own = s.Finish({surface, surface, surface});
    Vec3<double> tint{};
    terms::BlendWithBehind<double>(s, own, tint);
    EXPECT_EQ(own.alpha, 1.0);
    return own.color.y + tint.y * behind;
  };
  for (double surface = 0.0; surface <= 1.0; surface += 0.25) {
    EXPECT_NEAR(blend(P::Blending::Add, surface, 0.7), surface + 0.7, 1e-12);
    EXPECT_NEAR(blend(P::Blending::Multiply, surface, 0.7), surface * 0.7, 1e-12);
    EXPECT_NEAR(blend(P::Blending::Screen, surface, 0.7), surface + 0.7 * (1.0 - surface), 1e-12);
  }
  EXPECT_EQ(AlphaModeOf(p), AlphaMode::Blend);
}

// --- Refraction -----------------------------------------------------------------------------------------------------

P Glass(P::RefractionType type) {
  P p;
  p.refraction_mode = P::RefractionMode::ScreenSpace;
  p.refraction_type = type;
  p.roughness.value = 0.0f;
  p.absorption.value = {0.5f, 1.0f, 2.0f};
  p.thickness.value = 2.0f;
  p.micro_thickness.value = 0.1f;
  p.base_color.value = {0.8f, 0.9f, 1.0f, 1.0f};
  return p;
}

TEST(FilamentRefraction, OfASolidIsTheChordOfASphere) {
  const LightingData tables = Tables();
  const lanes::LightingView<double> lighting(tables);
  for (const double z : {0.05, 0.3, 0.7, 1.0}) {
    for (const float ior : {1.0f, 1.33f, 1.5f, 2.4f}) {
      P p = Glass(P::RefractionType::Solid);
      p.ior = ior;
      const Vec3<double> view{std::sqrt(1.0 - z * z), 0.0, z};
      const auto s = Scattering<double>(p, view, tables);
      ASSERT_TRUE(s.refracts);
      const auto r = terms::RefractionAt<double>(s, Source<double>(p), 1.0);
      // A sphere of radius 1 about (0, 0, -1): the way from its top along the refracted ray to its other side.
      const double sine = std::sqrt(1.0 - z * z) / double(ior), cosine = std::sqrt(1.0 - sine * sine);
      const double chord = 2.0 * cosine;
      const glm::dvec3 exit(r.path[0].x, r.path[0].y, r.path[0].z + 1.0);
      EXPECT_NEAR(glm::length(exit), 1.0, 1e-6) << z << " " << ior;
      EXPECT_NEAR(std::sqrt(Dot(r.path[0], r.path[0])), chord, 1e-6);
      const auto [a, b] = lighting.Dfg(z, double(0.045f));
      const double f0 = std::pow((double(ior) - 1.0) / (double(ior) + 1.0), 2.0);
      const double grazing = std::min(16.5 * 3.0 * f0, 1.0);
      EXPECT_NEAR(r.tint.x, double(0.8f) * std::exp(-0.5 * chord) * (1.0 - f0 * a - grazing * b), 1e-6);
      EXPECT_EQ(r.spread, 0.0);
      // Nothing is inside where the surface is seen from its back.
      const auto back = terms::RefractionAt<double>(s, Source<double>(p), 0.0);
      EXPECT_EQ(back.path[0].x, 0.0);
      EXPECT_GE(back.tint.x, r.tint.x);
    }
  }
}

TEST(FilamentRefraction, OfAThinWallBouncesBetweenItsSides) {
  const LightingData tables = Tables();
  const lanes::LightingView<double> lighting(tables);
  const double z = 0.5;
  const P p = Glass(P::RefractionType::Thin);
  const Vec3<double> view{std::sqrt(1.0 - z * z), 0.0, z};
  const auto r = terms::RefractionAt<double>(Scattering<double>(p, view, tables), Source<double>(p), 1.0);
  EXPECT_EQ(r.path[0].x, 0.0);
  EXPECT_EQ(r.path[0].z, 0.0);
  const auto [a, b] = lighting.Dfg(z, double(0.045f));
  const double e = 0.04 * a + b, cosine = std::sqrt(1.0 - (1.0 - z * z) / 2.25);
  // Of both sides: e + (1 - e)^2 e / (1 - e^2).
  const double both = e + (1.0 - e) * (1.0 - e) * e / (1.0 - e * e);
  EXPECT_NEAR(r.tint.y, double(0.9f) * std::exp(-0.1 / cosine) * (1.0 - both), 1e-6);
}

TEST(FilamentRefraction, DispersesByAbbesNumberAndScattersLessWhereIndicesAreEqual) {
  const LightingData tables = Tables();
  P p = Glass(P::RefractionType::Solid);
  p.ior = 1.5f;
  p.dispersion = 1.0f;
  p.roughness.value = 0.6f;
  const Vec3<double> view{0.8, 0.0, 0.6};
  const auto at = [&] {
    return terms::RefractionAt<double>(Scattering<double>(p, view, tables), Source<double>(p), 1.0);
  };
  const auto r = at();
  EXPECT_LT(r.path[0].z, 0.0);
  EXPECT_LT(r.path[2].z, r.path[0].z);  // blue is refracted more: deeper
  EXPECT_GT(r.spread, 0.0);
  p.ior = 1.0f;
  EXPECT_EQ(at().spread, 0.0);
}

}  // namespace
}  // namespace facet
