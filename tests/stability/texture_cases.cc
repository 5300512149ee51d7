// Textures at the ends of their coordinates and derivatives, and normal maps that name no direction.
#include <cmath>
#include <limits>

#include "render/hand_built.h"
#include "stability/stability_case.h"

namespace facet::stability {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr int kSize = 32;

// Linear grey in floats: texel (x, y) is value(x, y) in [0, 1].
Image Grey(int width, int height, const std::function<double(int, int)>& value) {
  Image image;
  image.width = width;
  image.height = height;
  image.channels = 3;
  image.type = ChannelType::F32;
  image.encoding = Encoding::Linear;
  image.bytes.resize(image.PixelCount() * 3 * sizeof(float));
  float* out = image.As<float>();
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (int c = 0; c < 3; ++c) *out++ = float(value(x, y));
    }
  }
  return image;
}

Sampler SamplerOf(Wrap wrap, MipFilter mip) {
  Sampler sampler;
  sampler.wrap_u = sampler.wrap_v = wrap;
  sampler.mip = mip;
  return sampler;
}

// A rectangle that fills the image, unlit, whose UVs go from `low` at its top left to `high` at its bottom right.
Scene TexturedRectangle(const Image& image, const Sampler& sampler, const glm::vec2& low, const glm::vec2& high) {
  Scene scene;
  Material material = Unlit({1, 1, 1, 1});
  material.base_color_texture = Ref(AddTexture(scene, image, sampler));
  Primitive p = Rectangle(-1, -1, 1, 1);
  p.tex_coords = {{{low.x, high.y}, high, {high.x, low.y}, low}};
  Add(scene, p, AddMaterial(scene, material));
  return scene;
}

RenderSettings FillingSettings() { return Settings(kSize, kSize, 1, Orthographic(1.0)); }

// A ramp that shows the coordinate itself: texel centres have their own place as value, and mirroring has no seam.
// Bound: coordinates in files are floats, so 2^20 + u has three binary digits left for u. A weight times a coordinate,
// three of them, rounded, from weights that are rounded: 6 half units; and half a unit for the texture's 16 bits at the
// smallest.
Measured MeasureLargeCoordinates() {
  Measured m;
  const Image ramp = Grey(256, 256, [](int x, int) { return (x + 0.5) / 256; });
  for (const float base : {0x1p10f, 0x1p14f, 0x1p17f, 0x1p20f}) {
    const Scene scene =
        TexturedRectangle(ramp, SamplerOf(Wrap::MirroredRepeat, MipFilter::None), {base, base}, {base + 1, base + 1});
    const Film film = Draw(scene, FillingSettings(), m);
    for (int x = 0; x < kSize; ++x) {
      const double u = (x + 0.5) / kSize;
      m.Error(std::fabs(double(film.pixels[std::size_t(x)].r) - u) / (double(base) * 0x1p-23));
    }
  }
  return m;
}

// Whatever coordinates are: each pixel is some texel, or a mixture of texels, so white stays white.
Measured MeasureBrokenCoordinates() {
  Measured m;
  const Image white = Grey(8, 8, [](int, int) { return 1.0; });
  for (const Wrap wrap : {Wrap::Repeat, Wrap::MirroredRepeat, Wrap::ClampToEdge}) {
    for (const float end : {0x1p24f, 1e10f, 1e30f, 3e38f, -3e38f, kInfinity, -kInfinity, kNan, 1e-40f}) {
      for (const bool both : {false, true}) {
        const Scene scene =
            TexturedRectangle(white, SamplerOf(wrap, MipFilter::Linear), glm::vec2(both ? end : 0.0f), glm::vec2(end));
        const Film film = Draw(scene, FillingSettings(), m);
        for (const glm::vec4& pixel : film.pixels) m.Error(std::fabs(double(pixel.r) - 1.0));
      }
    }
  }
  return m;
}

// Where coordinates are constant, derivatives are 0 and the footprint is a point: the texel, not the logarithm of 0.
// Bound: 16 bits a texel.
Measured MeasureZeroDerivatives() {
  Measured m;
  Uniform random(4);
  std::vector<double> texels(64);
  for (double& t : texels) t = random();
  const Image image = Grey(8, 8, [&](int x, int y) { return texels[std::size_t(y * 8 + x)]; });
  for (int i = 0; i < 64; i += 9) {
    const glm::vec2 centre((float(i % 8) + 0.5f) / 8, (float(i / 8) + 0.5f) / 8);
    for (const MipFilter mip : {MipFilter::None, MipFilter::Nearest, MipFilter::Linear}) {
      const Film film =
          Draw(TexturedRectangle(image, SamplerOf(Wrap::Repeat, mip), centre, centre), FillingSettings(), m);
      for (const glm::vec4& p : film.pixels) m.Error(std::fabs(double(p.r) - double(float(texels[std::size_t(i)]))));
    }
  }
  return m;
}

// Derivatives of many textures a pixel: the mean of the texture. Bound: each of five levels is rounded to 16 bits, and
// eight taps are added up: 6 / 65535.
Measured MeasureInfiniteDerivatives() {
  Measured m;
  Uniform random(8);
  std::vector<double> texels(256);
  double mean = 0.0;
  for (double& t : texels) t = double(float(random())), mean += t / 256;
  const Image image = Grey(16, 16, [&](int x, int y) { return texels[std::size_t(y * 16 + x)]; });
  for (const float end : {1e4f, 1e8f, 1e12f, 1e20f, 1e30f, 3e37f}) {
    for (const glm::vec2& high :
         {glm::vec2(end, end), glm::vec2(end, -end * 0.5f), glm::vec2(end, 1.0f), glm::vec2(end, 0.0f)}) {
      for (const bool along_one : {false, true}) {
        Scene scene = TexturedRectangle(image, SamplerOf(Wrap::Repeat, MipFilter::Linear), {0, 0}, high);
        // Both coordinates along x alone: an ellipse without width, of which the determinant does not tell the length.
        if (along_one) scene.meshes[0].primitives[0].tex_coords = {{{0, 0}, high, high, {0, 0}}};
        const Film film = Draw(scene, FillingSettings(), m);
        for (const glm::vec4& p : film.pixels) m.Error(std::fabs(double(p.r) - mean));
      }
    }
  }
  return m;
}

// 1 x N and N x 1 texels: the ramp along the long side, nothing across. Bound: 16 bits a texel, and interpolation
// between two of them in floats: 2 / 65535.
Measured MeasureThinTextures() {
  Measured m;
  constexpr int kLong = 64;
  for (const Wrap wrap : {Wrap::Repeat, Wrap::MirroredRepeat, Wrap::ClampToEdge}) {
    for (const MipFilter mip : {MipFilter::None, MipFilter::Linear}) {
      for (const bool upright : {false, true}) {
        const Image image = Grey(upright ? 1 : kLong, upright ? kLong : 1,
                                 [&](int x, int y) { return ((upright ? y : x) + 0.5) / kLong; });
        const Film film =
            Draw(TexturedRectangle(image, SamplerOf(wrap, mip), {0.25f, 0.25f}, {0.75f, 0.75f}), FillingSettings(), m);
        for (int i = 0; i < kSize * kSize; ++i) {
          const int along = upright ? i / kSize : i % kSize;
          m.Error(std::fabs(double(film.pixels[std::size_t(i)].r) - (0.25 + 0.5 * (along + 0.5) / kSize)));
        }
      }
    }
  }
  return m;
}

// --- Normals and tangents -------------------------------------------------------------------------------------------

// In a constant environment a white surface shows that environment whatever its normal, so a normal that is none shows
// as black, NaN or too bright a pixel. A board of such surfaces, kCell pixels a side each.
class FurnaceBoard {
 public:
  // `texel`: of the normal map, in [0, 1].
  void Add(const glm::vec3& texel, float scale, const std::function<void(Primitive&)>& spoil) {
    Image map = Grey(4, 4, [](int, int) { return 0.0; });
    for (std::size_t i = 0; i < 16; ++i) {
      // Opposite directions side by side: their mean has none.
      const glm::vec3 t = i % 2 == 0 ? texel : glm::vec3(1.0f) - texel;
      for (int c = 0; c < 3; ++c) map.As<float>()[3 * i + std::size_t(c)] = t[c];
    }
    Material material;
    material.normal_texture = Ref(AddTexture(scene_, map));
    material.normal_scale = scale;
    material.roughness_factor = 0.6f;
    material.metallic_factor = 0.5f;
    material.double_sided = true;
    const auto x = float(count_ % kColumns * kCell), y = float(count_ / kColumns * kCell);
    Primitive p = Rectangle(x, y, x + kCell, y + kCell);
    p.tangents.assign(4, glm::vec4(1, 0, 0, 1));
    spoil(p);
    facet::Add(scene_, p, AddMaterial(scene_, material));
    ++count_;
  }

  void Measure(Measured& m) const {
    constexpr int kSide = kColumns * kCell;
    RenderSettings settings = Settings(kSide, kSide, 1, Orthographic(kSide * 0.5, {kSide * 0.5, kSide * 0.5, 10}));
    settings.environment = ConstantEnvironment(1.0f);
    settings.environment_size = 64;
    settings.environment_samples = 6;
    RenderStats stats;
    const Film film = Draw(scene_, settings, m, &stats);
    m.Expect(stats.covered_pixels == std::uint64_t(count_) * kCell * kCell, "a surface has holes");
    for (const glm::vec4& pixel : film.pixels) {
      if (pixel.a == 0.0f) continue;
      for (int c = 0; c < 3; ++c) m.Error(std::fabs(double(pixel[c]) - 1.0));
    }
  }

 private:
  static constexpr int kCell = 6, kColumns = 7;
  Scene scene_;
  int count_ = 0;
};

// Bound of these: that of the furnace.
Measured MeasureNormalMaps() {
  FurnaceBoard board;
  const auto fine = [](Primitive&) {};
  for (const glm::vec3& texel : {glm::vec3(0.5f), glm::vec3(0.0f), glm::vec3(0.5f, 0.5f, 0.0f),
                                 glm::vec3(1, 0.5f, 0.5f), glm::vec3(kNan), glm::vec3(kInfinity, 0.5f, 1.0f)}) {
    for (const float scale : {1.0f, 0.0f, -1.0f, 1e30f, 3e38f, -3e38f}) board.Add(texel, scale, fine);
  }
  Measured m;
  board.Measure(m);
  return m;
}

Measured MeasureTangents() {
  FurnaceBoard board;
  const glm::vec3 texel(0.8f, 0.4f, 0.9f);
  for (const glm::vec4& tangent : {glm::vec4(0, 0, 1, 1), glm::vec4(0, 0, -1, -1), glm::vec4(0), glm::vec4(kNan),
                                   glm::vec4(1, 0, 0, 0), glm::vec4(1, 0, 0, kNan), glm::vec4(kInfinity, 0, 0, 1),
                                   glm::vec4(1e-30f, 0, 0, 1), glm::vec4(1e30f, 0, 0, 1)}) {
    board.Add(texel, 1.0f, [&](Primitive& p) { p.tangents.assign(4, tangent); });
  }
  for (const bool normals : {true, false}) {
    const auto without = [normals](Primitive& p) {
      p.tangents.clear();
      if (!normals) p.normals.clear();
    };
    board.Add(texel, 1.0f, without);
    for (const float uv : {0.3f, kNan, kInfinity}) {
      const auto degenerate = [&](Primitive& p) {
        without(p);
        p.tex_coords[0].assign(4, glm::vec2(uv));
      };
      board.Add(texel, 1.0f, degenerate);
    }
    const auto no_uvs = [&](Primitive& p) {
      without(p);
      p.tex_coords.clear();
    };
    board.Add(texel, 1.0f, no_uvs);
  }
  for (const glm::vec3& normal : {glm::vec3(0), glm::vec3(kNan), glm::vec3(0, kInfinity, 0), glm::vec3(0, 0, 1e-38f),
                                  glm::vec3(0, 0, 1e38f), glm::vec3(1, 0, 0), glm::vec3(0, 0, -1)}) {
    board.Add(texel, 1.0f, [&](Primitive& p) { p.normals.assign(4, normal); });
    const auto opposite = [&](Primitive& p) { p.normals = {normal, -normal, normal, -normal}; };
    board.Add(texel, 1.0f, opposite);
  }
  Measured m;
  board.Measure(m);
  return m;
}

}  // namespace

std::vector<Case> TextureCases() {
  return {
      {"textures", "coordinates of 2^10 to 2^20", "blocks: floats have no digits left for the texel",
       "the same, no worse: the file's floats, interpolated to their last digits", "ULP of the coordinate", 3.5,
       MeasureLargeCoordinates},
      {"textures", "coordinates of 2^24 to 3e38, infinite, NaN", "reads beyond the texture: a crash, or NaN",
       "wrapped before they become integers; not finite counts as 0", "of full scale", 0x1p-23,
       MeasureBrokenCoordinates},
      {"textures", "zero derivatives", "log2(0) chooses the level", "footprints have a least size", "of full scale",
       1.0 / 65535, MeasureZeroDerivatives},
      {"textures", "derivatives of 1e4 to 3e37 textures a pixel", "squares overflow: noise instead of the mean",
       "footprints have a largest size: the last level", "of full scale", 6.0 / 65535, MeasureInfiniteDerivatives},
      {"textures", "1 × N and N × 1 textures", "a level of size 0; neighbours read from the next row",
       "sizes stop at 1 in each direction apart", "of full scale", 2.0 / 65535, MeasureThinTextures},
      {"textures", "normal maps with zero, NaN and opposite vectors", "0 / 0, and black or glittering pixels",
       "the interpolated normal, where there is none", "of what comes in", 0.02, MeasureNormalMaps},
      {"textures", "tangents and normals zero, parallel, NaN, missing", "the same",
       "made where missing; without direction: any across the normal", "of what comes in", 0.02, MeasureTangents},
  };
}

}  // namespace facet::stability
