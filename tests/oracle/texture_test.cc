// Texels and what is made of them: filters, wrapping, transforms, colour and data, alpha and vertex colours.
#include <gtest/gtest.h>

#include <algorithm>

#include "oracle/brdf.h"
#include "oracle/gltf_file.h"

namespace oracle {
namespace {

// IEC 61966-2-1.
double FromSrgb(int code) {
  const double c = code / 255.0;
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

Texels Colorful(int width, int height) {
  return MakeTexels(width, height, [](int x, int y) {
    return std::vector<int>{20 + (x * 71 + y * 37) % 230, 10 + (x * 53 + y * 97) % 240, 30 + (x * 29 + y * 83) % 220,
                            255};
  });
}

enum class Wrap { Repeat, Mirror, Clamp };
int GltfNumber(Wrap wrap) { return wrap == Wrap::Repeat ? 10497 : wrap == Wrap::Mirror ? 33648 : 33071; }

// The texel that number i of an axis without end is (glTF 2.0, 3.8.4.5; OpenGL 4.6, 8.14.2).
int Wrapped(Wrap wrap, int i, int size) {
  switch (wrap) {
    case Wrap::Repeat: return (i % size + size) % size;
    case Wrap::Mirror: {
      const int k = (i % (2 * size) + 2 * size) % (2 * size);
      return k < size ? k : 2 * size - 1 - k;
    }
    default: return std::clamp(i, 0, size - 1);
  }
}

// The colour at (u, v), v down from the top (3.8.3): of the texel there, or of the four around it by their distances
// (OpenGL 4.6, 8.14.3), in linear light.
Vec TexelAt(const Texels& t, Wrap wrap_u, Wrap wrap_v, bool linear, double u, double v) {
  const auto color = [&](int x, int y) {
    const int i = Wrapped(wrap_u, x, t.width), j = Wrapped(wrap_v, y, t.height);
    return Vec{FromSrgb(t.At(i, j, 0)), FromSrgb(t.At(i, j, 1)), FromSrgb(t.At(i, j, 2))};
  };
  const double shift = linear ? 0.5 : 0.0, x = u * t.width - shift, y = v * t.height - shift;
  const int i = int(std::floor(x)), j = int(std::floor(y));
  if (!linear) return color(i, j);
  const double fx = x - i, fy = y - j;
  return (color(i, j) * (1 - fx) + color(i + 1, j) * fx) * (1 - fy) +
         (color(i, j + 1) * (1 - fx) + color(i + 1, j + 1) * fx) * fy;
}

// A square of UVs from `low` to `high` (of the left top and the right bottom corner), unlit and textured.
GltfFile Textured(const Texels& texels, const std::string& sampler, const std::vector<double>& uv,
                  const std::string& texture_members = "", const std::string& more_attributes = "") {
  GltfFile file;
  file.Use("KHR_materials_unlit");
  const int texture = file.Texture(texels, sampler);
  AddSquare(file, 1.0,
            R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":)" + std::to_string(texture) + texture_members +
                R"(}},"extensions":{"KHR_materials_unlit":{}}})",
            more_attributes, "", uv);
  AddStraightCamera(file, 1.0);
  return file;
}
// Of corners in the order that AddSquare has: left bottom, right bottom, right top, left top.
std::vector<double> UvOf(double u0, double v0, double u1, double v1) { return {u0, v1, u1, v1, u1, v0, u0, v0}; }

void ExpectTexture(const Texels& texels, Wrap wrap_u, Wrap wrap_v, bool linear, double u0, double v0, double u1,
                   double v1) {
  constexpr int kSize = 36;
  SCOPED_TRACE(std::string(linear ? "linear" : "nearest") + ", wrap " + std::to_string(GltfNumber(wrap_u)) + " and " +
               std::to_string(GltfNumber(wrap_v)));
  const std::string filter = linear ? "9729" : "9728";
  const GltfFile file =
      Textured(texels,
               R"({"magFilter":)" + filter + R"(,"minFilter":)" + filter + R"(,"wrapS":)" +
                   std::to_string(GltfNumber(wrap_u)) + R"(,"wrapT":)" + std::to_string(GltfNumber(wrap_v)) + "}",
               UvOf(u0, v0, u1, v1));
  const Image image = Draw(file, kSize, kSize);
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      const double u = u0 + (u1 - u0) * (x + 0.5) / kSize, v = v0 + (v1 - v0) * (y + 0.5) / kSize;
      const double edge_u = std::fabs(u * texels.width - std::round(u * texels.width));
      const double edge_v = std::fabs(v * texels.height - std::round(v * texels.height));
      if (!linear && std::min(edge_u, edge_v) < 1e-3) continue;  // either neighbour
      // Light is kept in 16 bits and weights in 14.
      ExpectColor(image, x, y, TexelAt(texels, wrap_u, wrap_v, linear, u, v), 2e-4, 1.0);
    }
  }
}

TEST(Texture, TexelsOfAnImage) {
  ExpectTexture(Colorful(4, 3), Wrap::Repeat, Wrap::Repeat, false, 0.0, 0.0, 1.0, 1.0);
  ExpectTexture(Colorful(4, 3), Wrap::Clamp, Wrap::Clamp, true, 0.0, 0.0, 1.0, 1.0);
}

TEST(Texture, WrappedInEveryWay) {
  for (const Wrap u : {Wrap::Repeat, Wrap::Mirror, Wrap::Clamp}) {
    for (const Wrap v : {Wrap::Repeat, Wrap::Mirror, Wrap::Clamp}) {
      for (const bool linear : {false, true}) ExpectTexture(Colorful(5, 3), u, v, linear, -1.3, -2.2, 2.4, 1.7);
    }
  }
}

// KHR_texture_transform's own example shows what turns where: "only the lower left quadrant of the source image,
// rotated clockwise 90 degrees".
TEST(Texture, TransformedAsItsExampleSays) {
  constexpr int kSize = 4;
  const Texels texels = Colorful(8, 8);
  GltfFile file = Textured(
      texels, R"({"magFilter":9728,"minFilter":9728})", UvOf(0, 0, 1, 1),
      R"(,"extensions":{"KHR_texture_transform":{"offset":[0,1],"rotation":1.57079632679,"scale":[0.5,0.5]}})");
  file.Use("KHR_texture_transform");
  const Image image = Draw(file, kSize, kSize);
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      // The quadrant's columns 0 to 3 and rows 4 to 7; turned clockwise, its left column becomes the top row.
      const int column = y, row = 7 - x;
      ExpectColor(image, x, y, TexelAt(texels, Wrap::Repeat, Wrap::Repeat, false, (column + 0.5) / 8, (row + 0.5) / 8),
                  1e-4, 1.0);
    }
  }
}

// Offset, turn and scale in that order from the left: uv' = offset + turn (scale uv), and another set of coordinates.
TEST(Texture, TransformedWithEveryPart) {
  constexpr int kSize = 24;
  constexpr double kTurn = 0.6;
  const Texels texels = Colorful(6, 6);
  GltfFile file;
  file.Use("KHR_materials_unlit");
  file.Use("KHR_texture_transform");
  const int texture = file.Texture(texels, R"({"magFilter":9729,"minFilter":9729})");
  const int second = file.Floats("VEC2", UvOf(0.2, 0.1, 1.3, 0.9));
  AddSquare(file, 1.0,
            R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":)" + std::to_string(texture) +
                R"(,"extensions":{"KHR_texture_transform":{"offset":[0.3,-0.2],"rotation":0.6,"scale":[1.5,0.7],)"
                R"("texCoord":1}}}},"extensions":{"KHR_materials_unlit":{}}})",
            R"(,"TEXCOORD_1":)" + std::to_string(second));
  AddStraightCamera(file, 1.0);
  const Image image = Draw(file, kSize, kSize);
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      const double u = 1.5 * (0.2 + 1.1 * (x + 0.5) / kSize), v = 0.7 * (0.1 + 0.8 * (y + 0.5) / kSize);
      // Counter-clockwise where v points down: (1, 0) goes to (cos, -sin).
      const double turned_u = std::cos(kTurn) * u + std::sin(kTurn) * v,
                   turned_v = std::cos(kTurn) * v - std::sin(kTurn) * u;
      ExpectColor(image, x, y, TexelAt(texels, Wrap::Repeat, Wrap::Repeat, true, turned_u + 0.3, turned_v - 0.2), 3e-4,
                  1.0);
    }
  }
}

// An image as small as a pixel shows its mean, of light and not of codes.
TEST(Texture, MinifiedToItsMean) {
  const Texels texels = MakeTexels(16, 16, [](int x, int y) {
    return (x + y) % 2 == 0 ? std::vector<int>{255, 128, 0, 255} : std::vector<int>{0, 0, 64, 255};
  });
  const Image image = Draw(Textured(texels, "{}", UvOf(0, 0, 1, 1)), 1, 1);
  ExpectColor(image, 0, 0, {0.5, 0.5 * FromSrgb(128), 0.5 * FromSrgb(64)}, 1e-4, 1.0);
}

// Roughness is G, metalness B (3.9.2), plain numbers times the factors; a mistake of channels or of curve shows.
TEST(Texture, MetallicRoughness) {
  GltfFile file;
  const Texels texels = MakeTexels(1, 1, [](int, int) { return std::vector<int>{255, 170, 102, 255}; });
  const int texture = file.Texture(texels);
  file.Light(R"({"type":"directional","intensity":4})", R"(,"rotation":)" + Numbers(Turn({0, 1, 0}, 0.5)));
  AddSquare(file, 1.0,
            R"({"pbrMetallicRoughness":{"baseColorFactor":[0.9,0.5,0.3,1],"metallicFactor":0.9,"roughnessFactor":0.8,)"
            R"("metallicRoughnessTexture":{"index":)" +
                std::to_string(texture) + "}}}");
  AddStraightCamera(file, 1.0);
  const Surface surface{{0.9, 0.5, 0.3}, 0.9 * 102 / 255.0, 0.8 * 170 / 255.0};
  const Vec toward = -Rotated({0, 0, -1}, {0, 1, 0}, 0.5);
  ExpectColor(Draw(file, 2, 2), 0, 1, Reflect(surface, {0, 0, 1}, {0, 0, 1}, toward) * 4.0, kLitTolerance, kLitFloor);
}

// Base colour is factor times texture (sRGB) times vertex colour (linear); emission is its factor times its texture.
TEST(Texture, ColorsAreMultiplied) {
  constexpr int kSize = 8;
  const Texels texels = MakeTexels(1, 1, [](int, int) { return std::vector<int>{200, 100, 50, 255}; });
  GltfFile file;
  file.Use("KHR_materials_unlit");
  const int texture = file.Texture(texels);
  const int colors = file.Floats("VEC4", {0, 0.5, 1, 1, 1, 0.5, 1, 1, 1, 0.5, 0.25, 1, 0, 0.5, 0.25, 1});
  AddSquare(file, 1.0,
            R"({"pbrMetallicRoughness":{"baseColorFactor":[0.5,0.8,1,1],"baseColorTexture":{"index":)" +
                std::to_string(texture) + R"(}},"extensions":{"KHR_materials_unlit":{}}})",
            R"(,"COLOR_0":)" + std::to_string(colors));
  AddStraightCamera(file, 1.0);
  const Image image = Draw(file, kSize, kSize);
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      const double along = (x + 0.5) / kSize, up = 1.0 - (y + 0.5) / kSize;
      ExpectColor(image, x, y,
                  {0.5 * FromSrgb(200) * along, 0.8 * FromSrgb(100) * 0.5, FromSrgb(50) * (0.25 + 0.75 * (1.0 - up))},
                  1e-4, 1.0);
    }
  }

  GltfFile glow;
  const int light = glow.Texture(texels);
  AddSquare(glow, 1.0, R"({"emissiveFactor":[1,0.5,0.25],"emissiveTexture":{"index":)" + std::to_string(light) + "}}");
  AddStraightCamera(glow, 1.0);
  ExpectColor(Draw(glow, 2, 2), 1, 1, {FromSrgb(200), 0.5 * FromSrgb(100), 0.25 * FromSrgb(50)}, 1e-4, 1.0);
}

// --- Alpha (3.9.4) --------------------------------------------------------------------------------------------------

// A row of alphas, 0 to 255 from left to right, over a blue wall.
Image AlphaImage(const std::string& mode_members, int size) {
  GltfFile file;
  file.Use("KHR_materials_unlit");
  const int texture = file.Texture(MakeTexels(size, 1,
                                              [&](int x, int) {
                                                return std::vector<int>{255, 255, 255, x * 255 / (size - 1)};
                                              }),
                                   R"({"magFilter":9728,"minFilter":9728})");
  AddSquare(file, 1.0,
            R"({"pbrMetallicRoughness":{"baseColorFactor":[0.8,0.4,0.2,0.9],"baseColorTexture":{"index":)" +
                std::to_string(texture) + R"(}},"extensions":{"KHR_materials_unlit":{}})" + mode_members + "}",
            "", R"(,"translation":[0,0,1])");
  AddSquare(file, 1.0,
            R"({"pbrMetallicRoughness":{"baseColorFactor":[0.1,0.2,0.7,1]},"extensions":{"KHR_materials_unlit":{}}})");
  AddStraightCamera(file, 1.0);
  return Draw(file, size, size);
}

TEST(Alpha, Modes) {
  constexpr int kSize = 18;
  const Vec front{0.8, 0.4, 0.2}, back{0.1, 0.2, 0.7};
  const Image opaque = AlphaImage("", kSize), mask = AlphaImage(R"(,"alphaMode":"MASK","alphaCutoff":0.3)", kSize),
              default_mask = AlphaImage(R"(,"alphaMode":"MASK")", kSize),
              blend = AlphaImage(R"(,"alphaMode":"BLEND")", kSize);
  for (int x = 0; x < kSize; ++x) {
    SCOPED_TRACE(x);
    const double alpha = 0.9 * (x * 255 / (kSize - 1)) / 255.0;
    ExpectColor(opaque, x, 5, front, 1e-4);
    ExpectColor(mask, x, 5, alpha >= 0.3 ? front : back, 1e-4);
    ExpectColor(default_mask, x, 5, alpha >= 0.5 ? front : back, 1e-4);
    ExpectColor(blend, x, 5, front * alpha + back * (1.0 - alpha), 1e-4);
    EXPECT_NEAR(blend.Alpha(x, 5), 1.0, 1e-6);
  }
}

// Layers that blend are composited from the farthest to the nearest, whatever their order in the file; without a wall
// what is left is transparent.
TEST(Alpha, LayersInTheirDepth) {
  const auto layer = [](GltfFile& file, const std::string& color, double z) {
    AddSquare(file, 1.0,
              R"({"pbrMetallicRoughness":{"baseColorFactor":)" + color +
                  R"(},"alphaMode":"BLEND","extensions":{"KHR_materials_unlit":{}}})",
              "", R"(,"translation":[0,0,)" + Number(z) + "]");
  };
  GltfFile file;
  file.Use("KHR_materials_unlit");
  layer(file, "[0,1,0,0.5]", 2.0);
  layer(file, "[0,0,1,0.25]", 3.0);
  layer(file, "[1,0,0,0.75]", 1.0);
  AddStraightCamera(file, 1.0);
  const Image image = Draw(file, 2, 2);
  // The film is premultiplied: nearest first, each through what those before it let pass.
  ExpectColor(image, 0, 0, {0.75 * 0.5 * 0.75, 0.75 * 0.5, 0.25}, 1e-6);
  EXPECT_NEAR(image.Alpha(0, 0), 1.0 - 0.75 * 0.5 * 0.25, 1e-6);
}

}  // namespace
}  // namespace oracle
