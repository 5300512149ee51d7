// Minimal glTF files as text, and their images: what an oracle states in numbers is what the file says.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "facet/film.h"
#include "facet/render.h"
#include "oracle/vec.h"

namespace oracle {

// JSON of numbers, to their last digit.
std::string List(const std::vector<double>& numbers);  // [1,2,3]
std::string Number(double number);
inline std::string Numbers(Vec v) { return List({v.x, v.y, v.z}); }
inline std::string Numbers(Quaternion q) { return List({q.x, q.y, q.z, q.w}); }

// Pixels of 8 bits, RGBA, top row first.
struct Texels {
  int width = 0, height = 0;
  std::vector<int> numbers;  // four a pixel
  int At(int x, int y, int channel) const { return numbers[std::size_t((y * width + x) * 4 + channel)]; }
};
Texels MakeTexels(int width, int height, const std::function<std::vector<int>(int x, int y)>& rgba);

// A document that grows by what is added; everything is in it, buffers and images as data URIs.
class GltfFile {
 public:
  // Appends an object to one of the top-level arrays; returns its index.
  int Add(const std::string& list, const std::string& object);

  // Accessors: floats of "SCALAR", "VEC2", "VEC3", "VEC4" or "MAT4"; unsigned 16-bit numbers. Return their index.
  int Floats(const std::string& type, const std::vector<double>& numbers);
  int Shorts(const std::string& type, const std::vector<int>& numbers);
  int Floats(const std::vector<Vec>& vectors);

  // A texture with its image and sampler ({...} of glTF's numbers); returns its index.
  int Texture(const Texels& texels, const std::string& sampler = "{}");

  // A node with a light of KHR_lights_punctual.
  void Light(const std::string& light, const std::string& node_members);

  // Nodes of the scene: by default all that were added.
  void Roots(std::vector<int> roots) { roots_ = std::move(roots); }
  void Use(const std::string& extension);

  std::string Text() const;

 private:
  int Accessor(const std::string& type, int component_type, std::size_t count, const std::string& bytes);

  std::map<std::string, std::vector<std::string>> lists_;
  std::vector<std::string> lights_, extensions_;
  std::vector<int> roots_;
  std::string bytes_;
};

// An image's light at the centre of each pixel.
struct Image {
  facet::Film film;
  Vec Color(int x, int y) const {
    const auto& p = film.pixels[std::size_t(y * film.width + x)];
    return {p.x, p.y, p.z};
  }
  double Alpha(int x, int y) const { return film.pixels[std::size_t(y * film.width + x)].w; }
};

// Loads the file, which must not give a warning, and renders it by its camera 0, one sample a pixel, without an
// environment, as far as `change` does not say otherwise.
Image Draw(const GltfFile& file, int width, int height,
           const std::function<void(facet::RenderSettings&)>& change = nullptr);

// Expects a pixel's light within `tolerance` of `expected`, relative to the larger of it and `floor`.
void ExpectColor(const Image& image, int x, int y, Vec expected, double tolerance, double floor = 1e-3);

// A camera at `eye` looking along -Z that sees [-half, half] in x and y: pixel (i, j) of an n x n image shows
// x = half (2 (i + 1/2) / n - 1), y = half (1 - 2 (j + 1/2) / n), straight on (glTF 2.0, 3.10.3.2).
void AddStraightCamera(GltfFile& file, double half, Vec eye = {0, 0, 10});
inline Vec StraightPlace(int x, int y, int size, double half) {
  return {half * (2.0 * (x + 0.5) / size - 1.0), half * (1.0 - 2.0 * (y + 0.5) / size), 0.0};
}

// A square of [-half, half] at z = 0 that faces +Z, its UV (0, 0) at the top left (glTF 2.0, 3.8.3); returns the mesh's
// accessors as JSON members: "POSITION", "NORMAL", "TEXCOORD_0".
std::string SquareAttributes(GltfFile& file, double half, const std::vector<double>& uv = {0, 1, 1, 1, 1, 0, 0, 0});
int SquareIndices(GltfFile& file);
// A node with that square and a material; more attributes and node members may be given, each after a comma.
void AddSquare(GltfFile& file, double half, const std::string& material, const std::string& more_attributes = "",
               const std::string& node_members = "", const std::vector<double>& uv = {0, 1, 1, 1, 1, 0, 0, 0});

}  // namespace oracle
