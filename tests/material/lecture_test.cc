// The model "lecture": closed forms of its terms, norms, energy, reciprocity, the ends of its parameters, its presets.
#include <gtest/gtest.h>

#include <fstream>
#include <random>
#include <sstream>
#include <vector>

#include "color/srgb.h"
#include "material/lecture_energy.h"
#include "material/lecture_model.h"
#include "material/models/lecture_presets.h"

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace {

using lanes::Vec3;

constexpr double kPi = 3.14159265358979324;
constexpr double kLeastAlpha = double{lanes::kMinPerceptualRoughness} * double{lanes::kMinPerceptualRoughness};

std::vector<double> Alphas() { return {kLeastAlpha, 0.005, 0.02, 0.1, 0.3, 0.5, 0.7, 0.9, 1.0}; }

// The integral of D(h) n.h over the hemisphere: the trapezoidal rule in the logarithm of the tangent, which converges
// exponentially because D is smooth in it and falls off at both ends.
template <class Distribution>
double Norm(const Distribution& distribution, double width) {
  constexpr int kPoints = 4000;
  const double low = std::log(width * 1e-5), high = std::log(1e9), step = (high - low) / kPoints;
  double sum = 0.0;
  for (int i = 0; i <= kPoints; ++i) {
    const double tangent = std::exp(low + i * step), cosine = 1.0 / std::sqrt(1.0 + tangent * tangent);
    const double sine = tangent * cosine;
    sum += distribution(cosine, sine * sine) * cosine * sine * (sine * cosine);
  }
  return 2.0 * kPi * step * sum;
}

TEST(LectureDistribution, IntegratesToOne) {
  for (double alpha : Alphas()) {
    const auto ggx = [&](double c, double s2) { return lanes::DistributionGgx(c, s2, alpha); };
    const auto beckmann = [&](double c, double s2) { return lanes::DistributionBeckmann(c, s2, alpha); };
    EXPECT_NEAR(Norm(ggx, alpha), 1.0, 1e-6) << alpha;
    EXPECT_NEAR(Norm(beckmann, alpha), 1.0, 1e-6) << alpha;
  }
  for (double exponent : {0.0, 0.5, 2.0, 10.0, 100.0, 1e4, 4.8e5, 1e8}) {
    const auto lobe = [&](double c, double s2) { return lanes::DistributionBlinnPhong(c, s2, exponent); };
    EXPECT_NEAR(Norm(lobe, std::sqrt(2.0 / (exponent + 2.0))), 1.0, 1e-6) << exponent;
  }
  for (float stated : {0.0f, 1e-6f, 1e-3f, 0.1f, 1.0f, 10.0f, 100.0f, 1e4f, 1e6f}) {
    const double alpha1 = double{BoundedAlpha1(stated)};
    for (double alpha2 : {0.0, 0.5, 1.0, 1.0 + 1e-9, 1.5, 2.0, 2.0 - 1e-7, 2.5, 10.0, 100.0}) {
      const double peak = 1.0 / (2.0 * kPi * AbcIntegral(alpha1, alpha2));
      const auto abc = [&](double c, double s2) { return lanes::DistributionAbc(c, s2, alpha1, alpha2, peak); };
      EXPECT_NEAR(Norm(abc, std::min(1.0, 1.0 / std::sqrt(alpha1 * alpha2 + 1.0))), 1.0, 1e-6)
          << alpha1 << " " << alpha2;
    }
  }
}

TEST(LectureDistribution, ClosedForms) {
  for (double alpha : Alphas()) {
    const double exponent = 2.0 / (alpha * alpha) - 2.0;
    const double peak = 1.0 / (kPi * alpha * alpha);
    // All three have the same peak by alphaP = 2 / alpha^2 - 2.
    EXPECT_NEAR(lanes::DistributionGgx(1.0, 0.0, alpha), peak, 1e-6 * peak);
    EXPECT_NEAR(lanes::DistributionBeckmann(1.0, 0.0, alpha), peak, 1e-6 * peak);
    EXPECT_NEAR(lanes::DistributionBlinnPhong(1.0, 0.0, exponent), peak, 1e-6 * peak);
    for (double theta : {0.5 * alpha, alpha, 1.5 * alpha}) {
      const double c = std::cos(theta), s2 = std::sin(theta) * std::sin(theta), t2 = s2 / (c * c), a2 = alpha * alpha;
      if (c < 0.01) continue;
      const double beckmann = std::exp(-t2 / a2) / (kPi * a2 * std::pow(c, 4));
      EXPECT_NEAR(lanes::DistributionBeckmann(c, s2, alpha), beckmann, 1e-6 * beckmann);
      const double phong = (exponent + 2.0) / (2.0 * kPi) * std::exp(0.5 * exponent * std::log1p(-s2));
      EXPECT_NEAR(lanes::DistributionBlinnPhong(c, s2, exponent), phong, 1e-6 * phong);
      const double ggx = a2 / (kPi * std::pow(c * c * (a2 - 1.0) + 1.0, 2));
      EXPECT_NEAR(lanes::DistributionGgx(c, s2, alpha), ggx, 1e-6 * ggx);
    }
  }
}

// Where alpha2 is 0, 1 or 2, the ABC integral has forms of its own.
TEST(LectureDistribution, AbcNorm) {
  for (double b : {1e-3, 0.3, 2.0, 50.0, 1e5}) {
    EXPECT_NEAR(AbcIntegral(b, 0.0), 0.5, 1e-9);
    const double l = std::log1p(b);
    const double one = ((b + 1.0) * l - b) / (b * b), two = ((b + 1.0) * (b / (b + 1.0)) - l) / (b * b);
    EXPECT_NEAR(AbcIntegral(b, 1.0), one, 1e-8 * one);
    EXPECT_NEAR(AbcIntegral(b, 2.0), two, 1e-8 * two);
  }
  EXPECT_NEAR(AbcIntegral(double{BoundedAlpha1(0.0f)}, 3.0), 0.5, 1e-5);
}

TEST(LectureGeometry, ClosedForms) {
  for (double r : {0.0, 0.2, 0.5, 1.0}) {
    for (double nl : {0.01, 0.3, 1.0}) {
      for (double nv : {0.02, 0.5, 1.0}) {
        LectureParameters p;
        p.roughness.value = static_cast<float>(r);
        const double stated = double{p.roughness.value};
        const lanes::LectureMicrofacets<double> m(p, stated);
        const auto schlick = [&](double k) {
          const auto g1 = [&](double x) { return x / (x * (1.0 - k) + k); };
          return g1(nl) * g1(nv) / (4.0 * nl * nv);
        };
        const double direct = schlick((1.0 + stated) * (1.0 + stated) / 8.0);
        const double image = schlick(std::max(stated * stated / 2.0, 1e-6));
        EXPECT_NEAR(m.Visibility(p, nl, nv, false), direct, 1e-9 * direct);
        EXPECT_NEAR(m.Visibility(p, nl, nv, true), image, 1e-9 * image);
      }
    }
  }
}

// Lambda of Beckmann's slopes is (erf(a) - 1) / 2 + exp(-a^2) / (2 a sqrt(pi)); the fit is known to be good to 0.35 %
// of G1.
TEST(LectureGeometry, SmithOfBeckmann) {
  double worst = 0.0;
  for (double alpha : {0.01, 0.1, 0.3, 0.6, 1.0}) {
    for (double x = 0.002; x < 1.0; x += 0.003) {
      const double a = x / (alpha * std::sqrt(1.0 - x * x));
      const double lambda = (std::erf(a) - 1.0) / 2.0 + std::exp(-a * a) / (2.0 * a * std::sqrt(kPi));
      const double fit = lanes::CosineTimesLambdaBeckmann(x, alpha) / x;
      worst = std::max(worst, std::fabs(1.0 / (1.0 + fit) - 1.0 / (1.0 + lambda)));
    }
  }
  EXPECT_LT(worst, 0.0035);
  RecordProperty("worst", std::to_string(worst));
  EXPECT_EQ(lanes::CosineTimesLambdaBeckmann(1.0, 0.5), 0.0);
  EXPECT_TRUE(std::isfinite(lanes::VisibilitySmithBeckmann(0.0, 1e-4, 1.0)));
}

// By Snell's law and the amplitudes, and at Brewster's angle.
TEST(LectureFresnel, DielectricClosedForm) {
  for (double n : {1.0, 1.0001, 1.33, 1.5, 2.4, 100.0}) {
    for (double c : {0.0, 1e-6, 0.01, 0.3, 0.5, 0.9, 1.0}) {
      const double inside = std::sqrt(1.0 - (1.0 - c * c) / (n * n));
      const double s = (c - n * inside) / (c + n * inside + 1e-300), p = (n * c - inside) / (n * c + inside + 1e-300);
      const double expected = n == 1.0 ? 0.0 : (s * s + p * p) / 2.0;
      EXPECT_NEAR(lanes::FresnelDielectric(n, c), expected, 1e-9) << n << " " << c;
    }
    const double normal = (n - 1.0) / (n + 1.0);
    EXPECT_NEAR(lanes::FresnelDielectric(n, 1.0), normal * normal, 1e-12);
    const double brewster = std::cos(std::atan(n));
    const double inside = std::sqrt(1.0 - (1.0 - brewster * brewster) / (n * n));
    const double s = (brewster - n * inside) / (brewster + n * inside);
    EXPECT_NEAR(lanes::FresnelDielectric(n, brewster), s * s / 2.0, 1e-12) << n;
  }
}

TEST(LectureFresnel, Conductor) {
  for (double eta : {0.05, 0.143, 1.442, 3.0}) {
    for (double k : {0.0, 0.5, 2.4, 7.0}) {
      const double normal = ((eta - 1) * (eta - 1) + k * k) / ((eta + 1) * (eta + 1) + k * k);
      EXPECT_NEAR(lanes::FresnelConductor(eta, k, 1.0), normal, 1e-12);
      EXPECT_NEAR(lanes::FresnelConductor(eta, k, 0.0), 1.0, 1e-12);
      for (double c = 0.0; c <= 1.0; c += 0.05) {
        const double f = lanes::FresnelConductor(eta, k, c);
        EXPECT_GE(f, 0.0);
        EXPECT_LE(f, 1.0 + 1e-12);
        // Without absorption it is a dielectric.
        if (k == 0.0 && eta > 1.0) {
          EXPECT_NEAR(f, lanes::FresnelDielectric(eta, c), 1e-9);
        }
      }
    }
  }
}

// A medium that is like air reflects nothing, at grazing incidence, too.
TEST(LectureFresnel, AConductorLikeAirReflectsNothing) {
  for (double c = 0.0; c <= 1.0; c += 0.125) {
    EXPECT_EQ(lanes::FresnelConductor(1.0, 0.0, c), 0.0) << c;
    EXPECT_EQ(lanes::FresnelConductor(1.0f, 0.0f, float(c)), 0.0f) << c;
  }
}

TEST(LectureFresnel, KsAndKd) {
  LectureParameters p;
  p.albedo.value = {0.8f, 0.5f, 0.2f, 1.0f};
  for (float metalness : {0.0f, 0.25f, 1.0f}) {
    p.metalness.value = metalness;
    const auto s = LectureSeenFrom<double>(p, DirectionOf(0.7));
    const double m = double{metalness}, f0 = double{p.f0} * (1.0 - m) + double{p.albedo.value.x} * m;
    const double f = f0 + (1.0 - f0) * std::pow(1.0 - 0.4, 5);
    const Vec3<double> k_s = s.Fresnel(0.4);
    EXPECT_NEAR(k_s.x, f, 1e-9);
    EXPECT_NEAR(s.Diffuse(k_s).x, double{p.albedo.value.x} * (1.0 - f) * (1.0 - m), 1e-9);
  }
}

// --- The specular term of Blinn and Phong ----------------------------------------------------------------------------

// At normal incidence (p + 8) / (8 pi) (n.h)^p reflects (p + 8) / 8 times 8 (p + 2^(-p/2)) / ((p + 2)(p + 4)), by
// substitution of the half angle.
TEST(LectureBlinnPhong, AlbedoAtNormalIncidence) {
  LectureParameters p;
  p.specular = LectureSpecular::BlinnPhong;
  p.diffuse = LectureDiffuse::None;
  p.exponent = LectureExponent::AlphaP;
  p.f0 = 1.0f;
  for (float exponent : {0.0f, 1.0f, 8.0f, 100.0f, 1e4f}) {
    p.alpha_p = exponent;
    const double e = double{exponent};
    const double closed = (e + 8.0) * (std::exp2(-e / 2.0) + e) / ((e + 2.0) * (e + 4.0));
    EXPECT_NEAR(LectureAlbedo(p, 1.0), closed, 0.002 * closed) << exponent;
  }
}

// --- The whole -------------------------------------------------------------------------------------------------------

template <class Visit>
void ForEachChoice(const Visit& visit) {
  LectureParameters p;
  for (int specular = 0; specular < 3; ++specular) {
    for (int distribution = 0; distribution < 4; ++distribution) {
      for (int geometry = 0; geometry < 2; ++geometry) {
        for (int fresnel = 0; fresnel < 2; ++fresnel) {
          for (int alpha = 0; alpha < 2; ++alpha) {
            for (int workflow = 0; workflow < 2; ++workflow) {
              p.specular = static_cast<LectureSpecular>(specular);
              p.distribution = static_cast<LectureDistribution>(distribution);
              p.geometry = static_cast<LectureGeometry>(geometry);
              p.fresnel = static_cast<LectureFresnel>(fresnel);
              p.alpha = static_cast<LectureAlpha>(alpha);
              p.workflow = static_cast<LectureWorkflow>(workflow);
              visit(p);
            }
          }
        }
      }
    }
  }
}

void SetRoughness(LectureParameters& p, float roughness) {
  p.roughness.value = roughness;
  p.glossiness.value = 1.0f - roughness;
}

// F depends on v.h, D on n.h, G on n.l and n.v alike: the direct reflectance is reciprocal, whatever is chosen.
TEST(Lecture, IsReciprocal) {
  std::mt19937 random(5);
  const auto uniform = [&] { return double(random()) / 4294967296.0; };
  ForEachChoice([&](LectureParameters p) {
    for (int trial = 0; trial < 60; ++trial) {
      SetRoughness(p, static_cast<float>(uniform()));
      p.metalness.value = static_cast<float>(uniform());
      p.albedo.value = {0.9f, 0.4f, 0.1f, 1.0f};
      const auto direction = [&] { return DirectionOf(0.001 + 0.999 * uniform(), 2.0 * kPi * uniform()); };
      const Vec3<double> a = direction(), b = direction();
      for (const bool of_image : {false, true}) {
        const Vec3<double> ab = LectureSeenFrom<double>(p, a).Reflected(b, of_image) / b.z;
        const Vec3<double> ba = LectureSeenFrom<double>(p, b).Reflected(a, of_image) / a.z;
        ASSERT_NEAR(ab.x, ba.x, 1e-9 * std::fabs(ab.x));
        ASSERT_NEAR(ab.y, ba.y, 1e-9 * std::fabs(ab.y));
        ASSERT_NEAR(ab.z, ba.z, 1e-9 * std::fabs(ab.z));
      }
    }
  });
}

// At the ends of all parameters, in float and in double, nothing is negative or not finite, and both agree. Highlights
// are compared where they are resolved: within a sharp one the half vector's own rounding decides.
TEST(Lecture, ExtremesAreFiniteAndFloatAgreesWithDouble) {
  std::mt19937 random(11);
  const auto uniform = [&] { return float(random() >> 8) / 16777216.0f; };
  double worst = 0.0;
  ForEachChoice([&](LectureParameters p) {
    for (const float roughness : {0.0f, 1e-6f, 0.05f, 0.5f, 1.0f}) {
      for (const float metalness : {0.0f, 0.5f, 1.0f}) {
        for (const float power : {0.0f, 32.0f, 1e6f, 3e38f}) {
          SetRoughness(p, roughness);
          p.metalness.value = metalness;
          p.exponent = power == 0.0f ? LectureExponent::FromRoughness : LectureExponent::AlphaP;
          p.alpha_p = power;
          p.alpha1 = std::min(power, 1e6f);
          p.alpha2 = power > 100.0f ? 100.0f : 0.5f;
          p.ior = power > 100.0f ? 100.0f : 1.0f;
          p.eta = glm::vec3(0.01f, 1.0f, 100.0f);
          p.k = glm::vec3(power > 1e7f ? 0.0f : 100.0f);
          p.specular_color.value = {0.0f, 0.5f, 1.0f};
          for (const float nv : {-0.5f, 0.0f, 1e-6f, 0.3f, 1.0f}) {
            for (const float nl : {-1.0f, 0.0f, 1e-7f, 0.4f, 1.0f}) {
              const float azimuth = 6.28f * uniform();
              const auto unit = [](float cosine, float turn) {
                const float s = std::sqrt(1.0f - cosine * cosine);
                return Vec3<float>{s * std::cos(turn), s * std::sin(turn), cosine};
              };
              const Vec3<float> v = unit(nv, 0.0f), l = unit(nl, azimuth);
              const auto wide = [](const Vec3<float>& d) {
                return Vec3<double>{double{d.x}, double{d.y}, double{d.z}};
              };
              const auto of_float = LectureSeenFrom<float>(p, v);
              const auto of_double = LectureSeenFrom<double>(p, wide(v));
              for (const bool of_image : {false, true}) {
                const Vec3<float> f = of_float.Reflected(l, of_image);
                const Vec3<double> d = of_double.Reflected(wide(l), of_image);
                for (const auto& [in_float, in_double] : {std::pair{f.x, d.x}, {f.y, d.y}, {f.z, d.z}}) {
                  ASSERT_TRUE(std::isfinite(in_float) && std::isfinite(in_double));
                  ASSERT_GE(in_float, 0.0f);
                  ASSERT_GE(in_double, 0.0);
                  ASSERT_TRUE(nl > 0.0f || in_float == 0.0f);
                  const double off = std::fabs(double{in_float} - in_double) / (in_double + 1e-3);
                  if (of_double.microfacets.alpha > 0.04) worst = std::max(worst, off);
                }
              }
            }
          }
        }
      }
    }
  });
  RecordProperty("worst", std::to_string(worst));
  EXPECT_LT(worst, 1e-3);
}

// A dielectric of specular-glossiness is one of metallic-roughness with that F0.
TEST(Lecture, WorkflowsAgree) {
  LectureParameters a, b;
  a.albedo.value = b.albedo.value = {0.5f, 0.6f, 0.7f, 1.0f};
  a.f0 = 0.08f;
  a.roughness.value = 0.25f;
  b.workflow = LectureWorkflow::SpecularGlossiness;
  b.specular_color.value = glm::vec3(0.08f);
  b.glossiness.value = 0.75f;
  const Vec3<double> view = DirectionOf(0.6), light = DirectionOf(0.5, 2.0);
  const double from_a = LectureSeenFrom<double>(a, view).Reflected(light, false).y;
  EXPECT_NEAR(LectureSeenFrom<double>(b, view).Reflected(light, false).y, from_a, 1e-9);
  // By the exact equations, F0 becomes the index of refraction that has it.
  b.fresnel = LectureFresnel::Exact;
  EXPECT_NEAR(LectureSeenFrom<double>(b, view).f0.y, 0.08, 1e-8);
}

TEST(Lecture, Presets) {
  LectureParameters p;
  p.f0_preset = LecturePreset::Water;
  EXPECT_NEAR(LectureSeenFrom<double>(p, DirectionOf(1.0)).f0.x, 0.02, 1e-8);
  p.f0_preset = LecturePreset::Gold;  // says nothing of the dielectric
  EXPECT_NEAR(LectureSeenFrom<double>(p, DirectionOf(1.0)).f0.x, 0.04, 1e-8);
  p.metalness.value = 1.0f;
  EXPECT_NEAR(LectureSeenFrom<double>(p, DirectionOf(1.0)).f0.z, 0.344, 1e-7);
  p.workflow = LectureWorkflow::SpecularGlossiness;
  EXPECT_NEAR(LectureSeenFrom<double>(p, DirectionOf(1.0)).f0.z, 0.344, 1e-7);
}

// The pipeline's ambient light: 0.03 albedo ao, which needs no environment and replaces it.
TEST(Lecture, ConstantAmbient) {
  LectureParameters p;
  p.ambient = LectureAmbient::Constant;
  p.albedo.value = {0.5f, 0.25f, 1.0f, 1.0f};
  p.ambient_occlusion.value = 0.5f;
  p.emission.value = {1.0f, 0.0f, 0.0f};
  const WhiteLighting lighting;
  const auto s = LectureSeenFrom<double>(p, DirectionOf(0.3), lighting);
  EXPECT_NEAR(s.Emission().x, 1.0 + 0.03 * 0.5 * 0.5, 1e-8);
  EXPECT_NEAR(s.Emission().y, 0.03 * 0.25 * 0.5, 1e-8);
  EXPECT_EQ(s.Environment(lighting).x, 0.0);
  EXPECT_EQ(s.FromEnvironment(DirectionOf(1.0), lighting).x, 0.0);
}

// Image-based light, by hand.
TEST(Lecture, ImageAmbient) {
  LectureParameters p;
  p.albedo.value = {0.8f, 0.8f, 0.8f, 1.0f};
  p.metalness.value = 0.5f;
  p.roughness.value = 0.25f;
  p.ambient_occlusion.value = 0.5f;
  const double nv = 0.4, f0 = 0.5 * double{p.f0} + 0.5 * double{p.albedo.value.x};
  const double f = f0 + (std::max(1.0 - 0.25, f0) - f0) * std::pow(1.0 - nv, 5);
  const WhiteLighting lighting;
  const lanes::SpecularAlbedo<double> dfg = lighting.SchlickDfg(p.alpha, nv, 0.25);
  const double expected = 0.5 * (f * dfg.a + dfg.b + (1.0 - f) * 0.5 * double{p.albedo.value.x});
  EXPECT_NEAR(LectureImageAlbedo(p, nv), expected, 1e-9);
}

// The table of the albedo with lectures' geometry term, against the same integral with another quadrature.
TEST(Lecture, SchlickDfgTable) {
  double worst[2] = {};
  for (const LectureAlpha alpha : {LectureAlpha::RoughnessSquared, LectureAlpha::Roughness}) {
    LectureParameters p;
    p.diffuse = LectureDiffuse::None;
    p.alpha = alpha;
    for (const float roughness : {0.1f, 0.2f, 0.33f, 0.5f, 0.77f, 1.0f}) {
      p.roughness.value = roughness;
      for (const double n_dot_v : {0.05, 0.1, 0.2, 0.4, 0.7, 1.0}) {
        const double r = LectureSeenFrom<double>(p, DirectionOf(n_dot_v)).microfacets.perceptual_roughness;
        const lanes::SpecularAlbedo<double> read = WhiteLighting().SchlickDfg(alpha, n_dot_v, r);
        p.f0 = 1.0f;
        const double sum = LectureAlbedo(p, n_dot_v, /*of_image=*/true);
        p.f0 = 0.0f;
        const double b = LectureAlbedo(p, n_dot_v, /*of_image=*/true);
        double& off = worst[static_cast<std::size_t>(alpha)];
        off = std::max({off, std::fabs(read.a + read.b - sum), std::fabs(read.b - b)});
      }
    }
  }
  EXPECT_LT(worst[0], 0.004);
  EXPECT_LT(worst[1], 0.006);
  RecordProperty("worst", std::to_string(worst[0]) + " " + std::to_string(worst[1]));
}

// docs/models/lecture.md states what the model gains and loses. lecture_energy writes the table.
TEST(Lecture, EnergyIsThatOfThePage) {
  std::ostringstream page;
  page << std::ifstream(FACET_SOURCE_DIR "/docs/models/lecture.md").rdbuf();
  std::istringstream lines(page.str());
  std::string line;
  int found = 0;
  while (std::getline(lines, line)) {
    for (const LectureChoice& choice : LectureChoices()) {
      if (!line.starts_with(std::string("| ") + choice.name + " | ")) continue;
      std::string numbers = line.substr(std::string("| ").size() + std::string(choice.name).size());
      std::ranges::replace(numbers, '|', ' ');
      std::istringstream row(numbers);
      float roughness = 0.0f;
      row >> roughness;
      for (const double share : LectureEnergy(choice, roughness)) {
        double printed = -1.0;
        row >> printed;
        EXPECT_NEAR(printed, share, 0.0051) << line;
      }
      ++found;
    }
  }
  EXPECT_EQ(found, int(LectureChoices().size() * kLectureRoughnesses.size()));
}

// A mirror reads the sharpest radiance, although the terms of punctual lights have a least alpha.
TEST(Lecture, AMirrorIsSharp) {
  struct : WhiteLighting {
    mutable double roughness = -1.0;
    Vec3<double> Prefiltered(const Vec3<double>&, double r) const {
      roughness = r;
      return {1.0, 1.0, 1.0};
    }
  } lighting;
  for (const LectureAlpha alpha : {LectureAlpha::RoughnessSquared, LectureAlpha::Roughness}) {
    LectureParameters p;
    p.alpha = alpha;
    p.roughness.value = 0.0f;
    LectureSeenFrom<double>(p, DirectionOf(0.5), lighting).Environment(lighting);
    EXPECT_EQ(lighting.roughness, 0.0);
    p.roughness.value = 0.25f;
    LectureSeenFrom<double>(p, DirectionOf(0.5), lighting).Environment(lighting);
    EXPECT_NEAR(lighting.roughness, alpha == LectureAlpha::Roughness ? 0.5 : 0.25, 1e-12);
  }
}

// --- Presets ---------------------------------------------------------------------------------------------------------

// A printed linear value stands for all that round to it: half a unit of its last digit to either side (0.02 for 0.015
// to 0.025). The printed 8-bit code must be that of one of them. It is that of the printed value itself in all but two:
// silicon's blue, 0.426, has the code 175, the book 174; mercury's green, 0.780, has 229, the book 228.
TEST(LecturePresets, LinearValuesAndCodesAgree) {
  std::vector<std::string> others;
  for (const LecturePresetRow& row : kLecturePresets) {
    if (row.preset == LecturePreset::None) continue;
    for (std::size_t c = 0; c < 3; ++c) {
      const float linear = row.linear[c];
      const bool has_three_digits = std::fabs(std::round(linear * 100.0f) - linear * 100.0f) > 1e-3f ||
                                    row.kind != LecturePresetRow::Kind::Dielectric;
      const float half = has_three_digits ? 0.0005f : 0.005f;
      const int low = LinearToSrgb8(std::max(linear - half, 0.0f)), high = LinearToSrgb8(linear + half);
      EXPECT_GE(int{row.srgb8[c]}, low) << row.word;
      EXPECT_LE(int{row.srgb8[c]}, high) << row.word;
      if (LinearToSrgb8(linear) != row.srgb8[c]) others.push_back(row.word + std::string(1, "rgb"[c]));
    }
  }
  EXPECT_EQ(others, (std::vector<std::string>{"siliconb", "mercuryg"}));
}

}  // namespace
}  // namespace facet
HWY_AFTER_NAMESPACE();
