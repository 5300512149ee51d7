// Textures for the reference, without mip levels: many samples per pixel filter them.
#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <vector>

#include "facet/image.h"
#include "facet/scene.h"
#include "texture/texture.h"

namespace facet {

// An image's texels in double: sRGB is decoded to linear light if the role is Color, without rounding to 16 bits.
// Immutable.
class ExactTexels {
 public:
  ExactTexels(std::shared_ptr<const Image> image, TextureRole role);

  // Bilinear or nearest between texels as `sampler.magnification` says: a sample's footprint is smaller than a texel,
  // or becomes so with enough samples. `uv` after KHR_texture_transform; not finite counts as 0. Alpha is 1 if the
  // image has none.
  glm::dvec4 Sample(const glm::dvec2& uv, const Sampler& sampler) const;

 private:
  glm::dvec4 Texel(int x, int y) const;
  double Channel(std::size_t index, bool is_color) const;

  std::shared_ptr<const Image> image_;
  std::vector<double> linear_;  // of each code, where colours are decoded
};

// KHR_texture_transform: translation * rotation * scale, counter-clockwise with v down.
struct UvTransform {
  explicit UvTransform(const TextureRef& ref);
  glm::dvec2 operator()(const glm::dvec2& uv) const;

 private:
  glm::dvec2 offset_, scale_;
  double cosine_, sine_;
};

}  // namespace facet
