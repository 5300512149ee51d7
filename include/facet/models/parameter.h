// What the parameter blocks of shading models are made of.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "facet/scene.h"

namespace facet {

// A value that a texture may scale. Where there is a texture, it is multiplied by the value: colours by the texel's
// colour, numbers by one of its channels.
template <class Value>
struct Textured {
  Value value{};
  TextureRef texture = {};
  std::int8_t channel = 0;  // of numbers: 0 to 3, for red to alpha

  bool operator==(const Textured&) const = default;
};

// A direction in tangent space, +Y up. Where there is a texture, it is the texture's direction, whose x and y are
// multiplied by `scale`.
struct TangentSpaceNormal {
  glm::vec3 value{0.0f, 0.0f, 1.0f};
  TextureRef texture = {};
  float scale = 1.0f;

  bool operator==(const TangentSpaceNormal&) const = default;
};

}  // namespace facet
