// Layers and lobes of the extensions: energy in a white furnace, under punctual and image-based light, alone and all
// together; closed forms at the ends of their parameters; materials without them keep their bits.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <string>
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
constexpr double kNDotV[] = {0.002, 0.01, 0.03, 0.1, 0.3, 0.6, 1.0};
constexpr double kFactors[] = {0.0, 0.5, 1.0};
constexpr double kMetallic[] = {0.0, 0.5, 1.0};

std::vector<double> Roughnesses() {
  std::vector<double> result;
  for (int i = 0; i <= 20; ++i) result.push_back(0.05 * i);
  return result;
}

MaterialInputs<double> White(double metallic, double perceptual_roughness) {
  MaterialInputs<double> in{};
  in.base_color = {1.0, 1.0, 1.0};
  in.metallic = metallic;
  in.perceptual_roughness = perceptual_roughness;
  in.normal = {0.0, 0.0, 1.0};
  in.occlusion = 1.0;
  return in;
}

// A feature that is stronger with its factor, in [0, 1].
struct Layer {
  std::string name;
  std::function<void(MaterialInputs<double>&, double factor)> set;
};

void SetDielectric(MaterialInputs<double>& in, MaterialFeatures bit, double f0, double f90) {
  in.dielectric = {{f0, f0, f0}, f90};
  in.lobes |= bit;
}

std::vector<Layer> Layers() {
  std::vector<Layer> layers;
  for (const double roughness : {0.0, 0.3, 1.0}) {
    layers.push_back({"clear coat of roughness " + std::to_string(roughness), [=](auto& in, double factor) {
                        in.clearcoat = {factor, roughness, in.normal};
                        in.lobes |= kClearcoat;
                      }});
    layers.push_back({"sheen of roughness " + std::to_string(roughness), [=](auto& in, double factor) {
                        in.sheen = {{factor, factor, factor}, roughness};
                        in.lobes |= kSheen;
                      }});
  }
  layers.push_back({"specular", [](auto& in, double factor) { SetDielectric(in, kSpecular, 0.04 * factor, factor); }});
  layers.push_back({"specular colour", [](auto& in, double factor) { SetDielectric(in, kSpecular, factor, 1.0); }});
  layers.push_back({"index of refraction", [](auto& in, double factor) {
                      const double root = 3.0 * factor / (3.0 * factor + 2.0);  // 1 to 4
                      SetDielectric(in, kIor, root * root, 1.0);
                    }});
  for (const double thickness : {0.0, 120.0, 400.0, 1e6}) {
    layers.push_back({"film of " + std::to_string(thickness) + " nm", [=](auto& in, double factor) {
                        in.film = {factor, 1.3, thickness};
                        in.lobes |= kIridescence;
                      }});
  }
  layers.push_back({"diffuse transmission", [](auto& in, double factor) {
                      in.diffuse_transmission = {factor, {1.0, 1.0, 1.0}};
                      in.lobes |= kDiffuseTransmission;
                    }});
  layers.push_back({"all of them", [](auto& in, double factor) {
                      in.clearcoat = {factor, 0.2, in.normal};
                      in.sheen = {{factor, factor, factor}, 0.4};
                      in.dielectric = {{0.06, 0.06, 0.06}, factor};
                      in.film = {factor, 1.6, 350.0};
                      in.diffuse_transmission = {factor, {1.0, 1.0, 1.0}};
                      in.lobes |= kClearcoat | kSheen | kSpecular | kIor | kIridescence | kDiffuseTransmission;
                    }});
  return layers;
}

const LightingData& NoLighting() {
  static const LightingData data = MakeLightingData({}, nullptr, 0.0, 1.0, {.sheen = true, .anisotropic_dfg = true});
  return data;
}

// The share of a white hemisphere's light (of both hemispheres', if the surface transmits diffusely) that reaches the
// view, in the channel that gets most: the integral over half vectors, uniform in the logarithm of their tangent so
// that every lobe is resolved, and over the directions behind the surface.
double Albedo(const MaterialInputs<double>& in, double n_dot_v) {
  const LightingView<double> lighting(NoLighting());
  const Vec3<double> view = {std::sqrt(1.0 - n_dot_v * n_dot_v), 0.0, n_dot_v};
  const auto closure = lanes::MakeClosure(in, view, lighting);
  constexpr int kPolar = 160, kAzimuth = 40, kBehind = 24;
  const double low = std::log(0.002 * 0.02), high = std::log(3e4), step = (high - low) / kPolar;
  Vec3<double> sum{0.0, 0.0, 0.0};
  for (int i = 0; i < kPolar; ++i) {
    const double tangent = std::exp(low + (i + 0.5) * step), c = 1.0 / std::sqrt(1.0 + tangent * tangent);
    const double s = tangent * c;
    Vec3<double> ring{0.0, 0.0, 0.0};
    for (int j = 0; j < kAzimuth; ++j) {
      const double phi = kPi * (j + 0.5) / kAzimuth;
      const Vec3<double> half = {s * std::cos(phi), s * std::sin(phi), c};
      const double v_dot_h = Dot(view, half);
      const Vec3<double> light = half * (2.0 * v_dot_h) - view;
      if (v_dot_h <= 0.0 || light.z <= 0.0) continue;
      ring += lanes::EvaluateClosure(closure, light, lighting) * (4.0 * v_dot_h);
    }
    sum += ring * (s * s * c * step * 2.0 * kPi / kAzimuth);
  }
  for (int i = 0; closure.Has(kDiffuseTransmission) && i < kBehind; ++i) {
    const double cosine = (i + 0.5) / kBehind;
    const Vec3<double> light = {std::sqrt(1.0 - cosine * cosine), 0.0, -cosine};
    sum += lanes::EvaluateClosure(closure, light, lighting) * (2.0 * kPi / kBehind);
  }
  return MaxComponent(sum);
}

Image ConstantImage(float value) {
  Image image{64, 32, 3, ChannelType::F32, Encoding::Linear, {}};
  image.bytes.resize(image.PixelCount() * 3 * sizeof(float));
  for (std::size_t i = 0; i < image.PixelCount() * 3; ++i) image.As<float>()[i] = value;
  return image;
}

// What a layer may lose besides rounding and the tables' errors: a film over a white metal reflects less than all. (A
// film or a coloured specular reflection over a dielectric lets pass what its brightest channel leaves, so that this
// channel alone loses nothing.)
double LeastShare(const std::string& layer, double metallic) {
  const bool film = layer.find("film") == 0 || layer == "all of them";
  return film && metallic > 0.0 ? 0.9 : 0.98;
}

TEST(LayersInWhiteFurnace, DirectionalLightsOfEveryDirection) {
  for (const Layer& layer : Layers()) {
    double least = 2.0, most = 0.0;
    for (const double roughness : {0.0, 0.1, 0.4, 0.7, 1.0}) {
      for (const double metallic : kMetallic) {
        for (const double factor : kFactors) {
          for (const double n_dot_v : kNDotV) {
            MaterialInputs<double> in = White(metallic, roughness);
            layer.set(in, factor);
            const double albedo = Albedo(in, n_dot_v);
            EXPECT_LE(albedo, 1.005) << layer.name << " " << factor << ", roughness " << roughness << ", metallic "
                                     << metallic << ", n.v " << n_dot_v;
            EXPECT_GE(albedo, LeastShare(layer.name, metallic))
                << layer.name << " " << factor << ", roughness " << roughness << ", metallic " << metallic << ", n.v "
                << n_dot_v;
            least = std::min(least, albedo), most = std::max(most, albedo);
          }
        }
      }
    }
    RecordProperty(layer.name, std::to_string(least) + " to " + std::to_string(most));
  }
}

TEST(LayersInWhiteFurnace, ConstantEnvironment) {
  const auto environment = PrefilterEnvironment(ConstantImage(1.0f));
  const LightingData data = MakeLightingData({}, environment.get(), 0.7, 3.0, {.sheen = true});
  const LightingView<double> lighting(data);
  for (const Layer& layer : Layers()) {
    for (const double roughness : Roughnesses()) {
      for (const double metallic : kMetallic) {
        for (const double factor : kFactors) {
          for (const double n_dot_v : kNDotV) {
            MaterialInputs<double> in = White(metallic, roughness);
            layer.set(in, factor);
            const Vec3<double> view = {std::sqrt(1.0 - n_dot_v * n_dot_v), 0.0, n_dot_v};
            const double share = MaxComponent(lanes::ShadeClosure(in, view, {0.0, 0.0, 0.0}, lighting)) / 3.0;
            EXPECT_LE(share, 1.005) << layer.name << " " << factor << " " << roughness << " " << metallic << " "
                                    << n_dot_v;
            EXPECT_GE(share, LeastShare(layer.name, metallic))
                << layer.name << " " << factor << " " << roughness << " " << metallic << " " << n_dot_v;
          }
        }
      }
    }
  }
}

Vec3<double> Evaluate(const MaterialInputs<double>& in, const Vec3<double>& view, const Vec3<double>& light) {
  const LightingView<double> lighting(NoLighting());
  return lanes::EvaluateClosure(lanes::MakeClosure(in, view, lighting), light, lighting);
}
const Vec3<double> kView = {0.6, 0.0, 0.8}, kLight = {-0.36, 0.48, 0.8};

// A layer whose factor is 0 leaves the material as it is, to the last bit.
TEST(Layers, OfFactorZeroAreNone) {
  for (const double metallic : kMetallic) {
    MaterialInputs<double> plain = White(metallic, 0.4);
    plain.base_color = {0.3, 0.6, 0.9};
    plain.emissive = {0.1, 0.2, 0.3};
    MaterialInputs<double> in = plain;
    in.clearcoat = {0.0, 0.2, in.normal};
    in.sheen = {{0.0, 0.0, 0.0}, 0.4};
    in.dielectric = {{double{lanes::kDielectricF0}, double{lanes::kDielectricF0}, double{lanes::kDielectricF0}}, 1.0};
    in.film = {0.0, 1.6, 350.0};
    in.diffuse_transmission = {0.0, {1.0, 1.0, 1.0}};
    in.lobes |= kClearcoat | kSheen | kIor | kIridescence | kDiffuseTransmission;
    const Vec3<double> expected = Evaluate(plain, kView, kLight), got = Evaluate(in, kView, kLight);
    EXPECT_EQ(got.x, expected.x);
    EXPECT_EQ(got.y, expected.y);
    EXPECT_EQ(got.z, expected.z);
  }
}

// The coat has its own normal, and dims what is under it, emission included, by what it reflects towards the view.
TEST(Clearcoat, DimsTheBaseByItsAlbedo) {
  const LightingView<double> lighting(NoLighting());
  MaterialInputs<double> in = White(0.0, 0.5);
  in.emissive = {2.0, 2.0, 2.0};
  in.clearcoat = {1.0, 0.0, in.normal};
  in.lobes |= kClearcoat;
  const auto closure = lanes::MakeClosure(in, kView, lighting);
  const double fresnel = 0.04 + 0.96 * std::pow(1.0 - 0.8, 5.0);  // of a smooth coat
  EXPECT_NEAR(closure.clearcoat.EnergyLeft(), 1.0 - fresnel, 2e-3);
  EXPECT_NEAR(lanes::EmissionThroughLayers(closure, in).x, 2.0 * (1.0 - fresnel), 4e-3);

  in.clearcoat.normal = {0.0, 0.6, 0.8};
  const auto tilted = lanes::MakeClosure(in, kView, lighting);
  const double cosine = Dot(in.clearcoat.normal, kView);
  EXPECT_NEAR(tilted.clearcoat.EnergyLeft(), 1.0 - 0.04 - 0.96 * std::pow(1.0 - cosine, 5.0), 2e-3);
  EXPECT_EQ(tilted.at.n_dot_v, closure.at.n_dot_v);
}

TEST(Specular, ScalesF0AndF90Apart) {
  MaterialInputs<double> in = White(0.0, 0.0);
  in.base_color = {0.0, 0.0, 0.0};
  const Vec3<double> light = {-kView.x, 0.0, kView.z};
  const double plain = Evaluate(in, kView, light).x;
  in.lobes |= kSpecular;
  in.dielectric = {{0.02, 0.04, 0.08}, 0.5};
  const Vec3<double> got = Evaluate(in, kView, light);
  const double w = std::pow(1.0 - 0.8, 5.0);
  const auto relative = [&](double f0, double f90) { return (f0 * (1.0 - w) + f90 * w) / (0.04 * (1.0 - w) + w); };
  EXPECT_NEAR(got.x / plain, relative(0.02, 0.5), 2e-3);
  EXPECT_NEAR(got.y / plain, relative(0.04, 0.5), 2e-3);
  EXPECT_NEAR(got.z / plain, relative(0.08, 0.5), 4e-3);
}

// KHR_materials_ior: an index of 0 is a Fresnel term of 1, so nothing reaches the base.
TEST(Ior, OfZeroReflectsEverything) {
  MaterialInputs<double> in = White(0.0, 0.3);
  in.base_color = {0.0, 0.0, 0.0};
  SetDielectric(in, kIor, 1.0, 1.0);
  for (const double n_dot_v : kNDotV) EXPECT_NEAR(Albedo(in, n_dot_v), 1.0, 0.01) << n_dot_v;
}

TEST(DiffuseTransmission, TakesFromBehindWhatTheReflectionLoses) {
  MaterialInputs<double> in = White(0.0, 0.5);
  const Vec3<double> behind = {kLight.x, kLight.y, -kLight.z};
  const Vec3<double> diffuse_only = [&] {
    MaterialInputs<double> black = in;
    black.base_color = {0.0, 0.0, 0.0};
    return Evaluate(in, kView, kLight) - Evaluate(black, kView, kLight);
  }();
  EXPECT_EQ(Evaluate(in, kView, behind).x, 0.0);
  in.diffuse_transmission = {0.25, {1.0, 0.5, 0.0}};
  in.lobes |= kDiffuseTransmission;
  const Vec3<double> passed = Evaluate(in, kView, behind);
  EXPECT_NEAR(passed.x, 0.25 * diffuse_only.x, 1e-12);
  EXPECT_NEAR(passed.y, 0.125 * diffuse_only.x, 1e-12);
  EXPECT_EQ(passed.z, 0.0);
}

// Under the film's first-order interference, a thin film over a dielectric is brightest where its path difference is
// whole wavelengths (its base is denser), and the colours of thick films fade.
TEST(Iridescence, FollowsThePathDifference) {
  const auto f0 = [](double thickness, double n_dot_v) {
    return lanes::ThinFilm<double>({1.0, 1.33, thickness}, n_dot_v).F0Over({0.3, 0.3, 0.3});
  };
  const auto saturation = [](const Vec3<double>& c) { return std::max({c.x, c.y, c.z}) - std::min({c.x, c.y, c.z}); };
  EXPECT_GT(saturation(f0(350.0, 1.0)), 0.05);
  EXPECT_LT(saturation(f0(1e5, 1.0)), 1e-3);
  for (const double thickness : {0.0, 1e-3, 1e6, 1e30}) {
    for (const double cosine : {1e-4, 0.5, 1.0}) {
      const Vec3<double> c = f0(thickness, cosine);
      for (const double channel : {c.x, c.y, c.z}) EXPECT_TRUE(channel >= 0.0 && channel <= 1.0);
    }
  }
  // No film: the base alone. Seen from the front, the mean over thicknesses is that of incoherent reflection.
  EXPECT_NEAR(f0(0.0, 1.0).x, 0.3, 1e-2);
  double mean = 0.0;
  for (int i = 0; i < 400; ++i) mean += f0(2000.0 + 20.0 * i, 1.0).y / 400.0;
  const double r12 = std::pow(0.33 / 2.33, 2.0), base = (1.0 + std::sqrt(0.3)) / (1.0 - std::sqrt(0.3));
  const double r23 = std::pow((base / 1.33 - 1.0) / (base / 1.33 + 1.0), 2.0);
  EXPECT_NEAR(mean, r12 + (1.0 - r12) * (1.0 - r12) * r23 / (1.0 - r12 * r23), 2e-3);
}

// Equal roughness in both directions is the isotropic model; a turn of the axes by a quarter swaps them.
TEST(Anisotropy, GeneralisesTheIsotropicModel) {
  MaterialInputs<double> in = White(1.0, 0.4);
  const Vec3<double> isotropic = Evaluate(in, kView, kLight);
  in.lobes |= kAnisotropy;
  in.anisotropy = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, 0.0};
  EXPECT_NEAR(Evaluate(in, kView, kLight).x, isotropic.x, 2e-3 * isotropic.x);
  in.anisotropy.strength = 0.7;
  const Vec3<double> along = Evaluate(in, kView, {-0.6, 0.0, 0.8}),
                     across = Evaluate(in, {0.0, 0.6, 0.8}, {0.0, -0.6, 0.8});
  in.anisotropy = {{0.0, 1.0, 0.0}, {-1.0, 0.0, 0.0}, 0.7};
  EXPECT_NEAR(Evaluate(in, {0.0, 0.6, 0.8}, {0.0, -0.6, 0.8}).x, along.x, 1e-12);
  EXPECT_NEAR(Evaluate(in, kView, {-0.6, 0.0, 0.8}).x, across.x, 1e-12);
}

}  // namespace
}  // namespace facet
