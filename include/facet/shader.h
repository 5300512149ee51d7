// Fragment shaders of one's own: see facet/shader/shader-inl.h for how to write one, and facet_add_shader() in CMake
// for how to compile it for every instruction set.
#pragma once

#include <cstdint>

namespace facet {

struct ShadeTask;

// Of which materials a shader reads the light: a frame prepares none that nobody reads.
enum class LightUse : std::uint8_t {
  None,            // it shows normals, say
  LitMaterials,    // not of those that are unlit, where the surface has neither position nor normal
  EveryMaterial,
};

// What the functor of a shader says of itself: `static constexpr facet::LightUse kLight = ...;` in it, or the default.
template <class Functor>
constexpr LightUse LightUseOf() {
  if constexpr (requires { Functor::kLight; }) {
    return Functor::kLight;
  } else {
    return LightUse::LitMaterials;
  }
}

// Shades batches of fragments. Implementations are immutable and called from many threads at once.
class FragmentShader {
 public:
  virtual ~FragmentShader() = default;
  virtual void Shade(const ShadeTask& task) const = 0;
  // A shader that reads light all the same finds neither lights nor an environment.
  virtual LightUse Light() const { return LightUse::LitMaterials; }
};

}  // namespace facet
