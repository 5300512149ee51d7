// Layers and lobes of material extensions at the ends of their parameters: float against double.
#include <cmath>

#include "light/lighting-inl.h"
#include "material/closure-inl.h"
#include "material/parameters.h"
#include "stability/stability_case.h"

namespace facet::stability {
namespace {

namespace lanes = HWY_NAMESPACE;
using lanes::LightingView;
using lanes::MaterialInputs;
using lanes::Vec3;

constexpr double kPi = 3.14159265358979324;
constexpr float kBelowOne = 0x1.fffffep-1f;
const float kShares[] = {0.0f, 1e-30f, 1e-6f, 0.5f, kBelowOne, 1.0f};
const float kRoughnesses[] = {0.0f, 1e-6f, 0.045f, 0.3f, 1.0f};
const float kCosines[] = {1.0f, kBelowOne, 0.5f, 0.1f, 1e-2f, 1e-4f, 1e-8f};

const LightingData& NoLighting() {
  static const LightingData data = MakeLightingData({}, nullptr, 0.0, 1.0, {.sheen = true, .anisotropic_dfg = true});
  return data;
}

Vec3<float> Direction(float z, double azimuth) {
  const double s = std::sqrt(std::fmax(1.0 - double(z) * double(z), 0.0));
  return {float(s * std::cos(azimuth)), float(s * std::sin(azimuth)), z};
}

template <class T>
Vec3<T> As(const Vec3<float>& v) {
  return {T(v.x), T(v.y), T(v.z)};
}

template <class T>
MaterialInputs<T> Base(float metallic, float roughness) {
  MaterialInputs<T> in{};
  in.base_color = {T(0.25f), T(0.5f), T(1.0f)};
  in.metallic = T(metallic);
  in.perceptual_roughness = T(roughness);
  in.normal = {T(0), T(0), T(1)};
  in.occlusion = T(1);
  return in;
}

template <class T>
Vec3<T> Evaluate(const MaterialInputs<T>& in, const Vec3<float>& view, const Vec3<float>& light) {
  const LightingView<T> lighting(NoLighting());
  return lanes::EvaluateClosure(lanes::MakeClosure(in, As<T>(view), lighting), As<T>(light), lighting);
}

// `set(in, share, roughness)` gives the inputs a layer, in float and in double alike. Errors are measured as in
// closure_cases.cc, whose bound holds for each of the lobes that are summed.
template <class Set>
Measured MeasureLayer(const Set& set) {
  Measured m;
  for (const float share : kShares) {
    for (const float layer_roughness : kRoughnesses) {
      for (const float roughness : {0.0f, 0.3f, 1.0f}) {
        for (const float metallic : {0.0f, 0.5f, 1.0f}) {
          for (const float n_dot_v : kCosines) {
            const Vec3<float> view = Direction(n_dot_v, 0.0);
            for (const float n_dot_l : kCosines) {
              for (const double azimuth : {0.0, 1.0, kPi - 1e-3, kPi}) {
                for (const float side : {1.0f, -1.0f}) {
                  const Vec3<float> light = Direction(side * n_dot_l, azimuth);
                  auto in = Base<float>(metallic, roughness);
                  auto in_double = Base<double>(metallic, roughness);
                  set(in, share, layer_roughness);
                  set(in_double, share, layer_roughness);
                  const Vec3<float> got = Evaluate(in, view, light);
                  const Vec3<double> exact = Evaluate(in_double, view, light);
                  for (const auto& [a, b] :
                       {std::pair(got.x, exact.x), std::pair(got.y, exact.y), std::pair(got.z, exact.z)}) {
                    m.Expect(a >= 0.0f && std::isfinite(a), "a BSDF is negative or not finite");
                    m.Error(std::fabs(double(a) - b) / (b + double(std::fabs(light.z)) / kPi));
                  }
                }
              }
            }
          }
        }
      }
    }
  }
  return m;
}

Measured MeasureClearcoat() {
  return MeasureLayer([]<class T>(MaterialInputs<T>& in, float share, float roughness) {
    in.clearcoat = {T(share), T(roughness), in.normal};
    in.lobes |= kClearcoat;
  });
}

Measured MeasureSheen() {
  return MeasureLayer([]<class T>(MaterialInputs<T>& in, float share, float roughness) {
    in.sheen = {{T(share), T(1.0f), T(0.0f)}, T(roughness)};
    in.lobes |= kSheen;
  });
}

// The roughness stands for the film's thickness, from 0 to a millimetre and beyond.
Measured MeasureFilm() {
  return MeasureLayer([]<class T>(MaterialInputs<T>& in, float share, float roughness) {
    const float thickness = roughness == 0.0f     ? 0.0f
                            : roughness == 1e-6f  ? 1e-3f
                            : roughness == 0.045f ? 350.0f
                            : roughness == 0.3f   ? 1e6f
                                                  : 3e38f;
    in.film = {T(1.0f), T(share == 0.0f ? 1.0f : share == 1.0f ? 3e38f : 1.0f + 0.8f * share), T(thickness)};
    in.lobes |= kIridescence;
  });
}

Measured MeasureAnisotropy() {
  return MeasureLayer([]<class T>(MaterialInputs<T>& in, float share, float roughness) {
    const float angle = 3.0f * roughness;
    const Vec3<float> t{std::cos(angle), std::sin(angle), 0.0f};
    in.anisotropy = {As<T>(t), {T(-t.y), T(t.x), T(0.0f)}, T(share)};
    in.lobes |= kAnisotropy;
  });
}

// The roughness stands for the index of refraction.
Measured MeasureInterface() {
  return MeasureLayer([]<class T>(MaterialInputs<T>& in, float share, float roughness) {
    Material material;
    material.ior = roughness == 0.0f     ? 0.0f
                   : roughness == 1e-6f  ? 1.0f
                   : roughness == 0.045f ? 100.0f
                   : roughness == 0.3f   ? 1e30f
                                         : 3.4e38f;
    const T f0(FactorsOf(material).dielectric_f0);
    in.dielectric = {{f0 * T(share), f0 * T(0.5f) * T(share), T(0.0f)}, T(share)};
    in.lobes |= kSpecular | kIor;
  });
}

Measured MeasureDiffuseTransmission() {
  return MeasureLayer([]<class T>(MaterialInputs<T>& in, float share, float roughness) {
    in.diffuse_transmission = {T(share), {T(1.0f), T(roughness), T(0.0f)}};
    in.lobes |= kDiffuseTransmission;
  });
}

}  // namespace

std::vector<Case> LayerCases() {
  return {
      {"layers", "clear coat of factor and roughness 0 to 1, over mirrors too", "infinite highlights at roughness 0",
       "the core's lobe, with its bounds, once more", "relative", 5e-3, MeasureClearcoat},
      {"layers", "sheen of roughness 0 to 1 at grazing angles", "0 / 0 at roughness 0; more than all light at the rim",
       "roughness from 0.07 on, and the lobe over its own albedo where that exceeds 1", "relative", 5e-3, MeasureSheen},
      {"layers", "films of 0 to 1e38 nm, indices from 1 to 1e38", "NaN from infinite phases; negative colours",
       "nothing interferes beyond a millimetre; reflectances clamped", "relative", 5e-3, MeasureFilm},
      {"layers", "anisotropy of strength 0 to 1", "division by a width of 0 along one axis",
       "both widths from 0.045² on", "relative", 5e-3, MeasureAnisotropy},
      {"layers", "indices of refraction of 0, 1, 100 and 1e38, specular factors 0 to 1", "(n - 1) / (n + 1) overflows",
       "F0 in double, clamped", "relative", 5e-3, MeasureInterface},
      {"layers", "diffuse transmission of 0 to 1, lit from both sides", "light from behind on the front",
       "the core's diffuse lobe, mirrored", "relative", 5e-3, MeasureDiffuseTransmission},
  };
}

}  // namespace facet::stability
