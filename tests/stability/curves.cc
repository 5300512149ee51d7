// Parameters that go to their limit: that neither error nor work explodes on the way.
#include <cmath>

#include "light/lighting-inl.h"
#include "light/punctual.h"
#include "material/closure-inl.h"
#include "render/hand_built.h"
#include "stability/stability_case.h"

namespace facet::stability {
namespace {

namespace lanes = HWY_NAMESPACE;
using lanes::Vec3;

constexpr double kPi = 3.14159265358979324;
constexpr int kSize = 32;

template <class T>
T Evaluate(double roughness, const Vec3<float>& view, const Vec3<float>& light) {
  static const LightingData data = MakeLightingData({}, nullptr);
  const lanes::LightingView<T> lighting(data);
  lanes::MaterialInputs<T> in{};
  in.base_color = {T(1), T(1), T(1)};
  in.metallic = T(1);
  in.perceptual_roughness = T(float(roughness));
  in.normal = {T(0), T(0), T(1)};
  const Vec3<T> v{T(view.x), T(view.y), T(view.z)}, l{T(light.x), T(light.y), T(light.z)};
  return lanes::EvaluateClosure(lanes::MakeClosure<T, lanes::kCoreLobes>(in, v, lighting), l, lighting).y;
}

// The highlight of a metal, around the mirrored direction. Its peak is D n.l V = 1 / (pi alpha^2) / (4 n.v) at most: at
// alpha = 0.002 and n.v = 0.07, where the angles end, 2.8e5.
CurvePoint Roughness(double roughness, Measured& m) {
  CurvePoint point;
  for (double angle = 0.01; angle < 1.5; angle *= 1.3) {
    const Vec3<float> view{float(std::sin(angle)), 0.0f, float(std::cos(angle))};
    for (double off = -0.02; off < 0.02; off += 1.7e-4) {
      const double mirrored = angle + off;
      const Vec3<float> light{float(-std::sin(mirrored)), 0.0f, float(std::cos(mirrored))};
      if (light.z <= 0.0f) continue;
      const float got = Evaluate<float>(roughness, view, light);
      const long double exact = Evaluate<long double>(roughness, view, light);
      m.Expect(std::isfinite(got), "the highlight is not finite");
      point.error = std::fmax(point.error, double(std::fabs(got - exact) / (exact + light.z / kPi)));
      point.count = std::fmax(point.count, double(got));
    }
  }
  return point;
}

// A sphere that lies `offset` away, seen by a camera that went along.
CurvePoint Offset(double offset, Measured& m) {
  const auto draw = [&m](double at) {
    Scene scene;
    Material material;
    material.roughness_factor = 0.4f;
    Transform place;
    place.translation = glm::dvec3(at);
    Add(scene, Sphere(0.9f, 24, 36), AddMaterial(scene, material), place);
    Light sun;
    sun.type = LightType::Directional;
    scene.lights.push_back(sun);
    Node node;
    node.light = 0;
    scene.nodes.push_back(node);
    return Draw(scene, Settings(kSize, kSize, 4, Perspective(0.8, {at, at, at + 3.0})), m);
  };
  const Film film = draw(offset);
  CurvePoint point;
  point.error = double(DifferingPixels(film, draw(0.0), 1e-3f)) / double(film.pixels.size());
  return point;
}

// The image cut into triangles of that many a pixel: each sample is covered once, whatever their number.
CurvePoint TrianglesPerPixel(double per_pixel, Measured& m) {
  const int n = int(std::lround(kSize * std::sqrt(per_pixel / 2)));  // cells a side, two triangles each
  Scene scene;
  Primitive p;
  for (int y = 0; y <= n; ++y) {
    for (int x = 0; x <= n; ++x)
      p.positions.emplace_back(-1 + 2.0f * float(x) / float(n), -1 + 2.0f * float(y) / float(n), 0);
  }
  for (int y = 0; y < n; ++y) {
    for (int x = 0; x < n; ++x) {
      const auto a = std::uint32_t(y * (n + 1) + x), b = a + std::uint32_t(n + 1);
      p.indices.insert(p.indices.end(), {a, a + 1, b, b, a + 1, b + 1});
    }
  }
  Add(scene, p, AddMaterial(scene, Unlit({1, 1, 1, 0.5f}, AlphaMode::Blend)));
  RenderStats stats;
  const Film film = Draw(scene, Settings(kSize, kSize, 4, Orthographic(1.0)), m, &stats);
  CurvePoint point;
  for (const glm::vec4& pixel : film.pixels) point.error = std::fmax(point.error, std::fabs(double(pixel.a) - 0.5));
  point.count = double(stats.fragments_blended) / (kSize * kSize);
  return point;
}

// Sheets over the whole image, of alpha 1 / layers: their sum is 1 - (1 - alpha)^layers. Bound of the error: one
// rounding of 2^-24 a layer, at most 3000 of them.
CurvePoint Layers(double layers, Measured& m) {
  Scene scene;
  const float alpha = float(1.0 / layers);
  const int material = AddMaterial(scene, Unlit({1, 1, 1, alpha}, AlphaMode::Blend));
  for (int i = 0; i < int(layers); ++i) Add(scene, Rectangle(-1, -1, 1, 1, float(i) / 1024.0f), material);
  RenderStats stats;
  RenderSettings settings = Settings(kSize, kSize, 1, Orthographic(1.0));
  settings.threads = 1;
  const Film film = Draw(scene, settings, m, &stats);
  const double exact = 1.0 - std::pow(1.0 - double(alpha), layers);
  CurvePoint point;
  for (const glm::vec4& pixel : film.pixels) point.error = std::fmax(point.error, std::fabs(double(pixel.a) - exact));
  point.count = double(stats.fragments_blended) / (kSize * kSize) / layers;
  return point;
}

// A texture of noise, stretched along one axis until a pixel spans `stretch` texels there and one across. The mean over
// the image stays the texture's; 16 taps at most are read, and levels beyond.
CurvePoint Stretch(double stretch, Measured& m) {
  Uniform random(8);
  constexpr int kTexels = 64;
  constexpr std::size_t kCount = kTexels * kTexels;
  Image image = *ConstantEnvironment(0.0f).image;  // linear floats
  image.width = image.height = kTexels;
  image.bytes.resize(kCount * 3 * sizeof(float));
  double mean = 0.0;
  for (std::size_t i = 0; i < kCount; ++i) {
    const float texel = random() < 0.5 ? 1.0f : 0.0f;
    for (std::size_t c = 0; c < 3; ++c) image.As<float>()[3 * i + c] = texel;
    mean += double(texel) / kCount;
  }
  Scene scene;
  Material material = Unlit({1, 1, 1, 1});
  material.base_color_texture = Ref(AddTexture(scene, image));
  Primitive p = Rectangle(-1, -1, 1, 1);
  const auto u = float(stretch * kSize / kTexels), v = float(kSize) / kTexels * 2;
  p.tex_coords = {{{0, v}, {u, v}, {u, 0}, {0, 0}}};
  Add(scene, p, AddMaterial(scene, material));
  const Film film = Draw(scene, Settings(kSize, kSize, 1, Orthographic(1.0)), m);
  CurvePoint point;
  double sum = 0.0;
  for (const glm::vec4& pixel : film.pixels) sum += double(pixel.r) / double(film.pixels.size());
  point.error = std::fabs(sum - mean);
  return point;
}

}  // namespace

std::vector<Curve> AllCurves() {
  return {
      {"roughness to 0",
       "The error in float grows as the highlight narrows, and stops where roughness is clamped.",
       "perceptual roughness",
       "relative",
       "peak of the BRDF",
       1e-3,
       2.8e5,
       {1.0, 0.3, 0.1, 0.045, 1e-2, 1e-4, 1e-6, 0.0},
       Roughness},
      {"distance from the origin",
       "Pixels that differ by 1e-3 from the picture at the origin: none, until double ends.",
       "units",
       "of the pixels",
       "",
       0.01,
       0.0,
       {1e-6, 1.0, 1e3, 1e6, 1e9},
       Offset},
      {"triangles per pixel",
       "With four samples a pixel no more than four fragments can be seen, however many triangles.",
       "triangles",
       "of alpha",
       "fragments a pixel",
       0.0,
       4.0,
       {0.125, 2.0, 8.0, 32.0, 128.0},
       TrianglesPerPixel},
      {"blended layers",
       "Fragments and error grow with the layers, by one a layer; so does the memory of a tile.",
       "layers",
       "of alpha",
       "fragments a pixel and layer",
       3000 * 0x1p-24,
       1.0,
       {1.0, 10.0, 100.0, 300.0, 1000.0, 3000.0},
       Layers},
      {"stretched textures",
       "Error of the mean over the picture; at most 16 taps are read, so time stays bounded.",
       "texels along a pixel",
       "of full scale",
       "",
       0.05,
       0.0,
       {1.0, 4.0, 16.0, 64.0, 1e3, 1e6, 1e12},
       Stretch},
  };
}

}  // namespace facet::stability
