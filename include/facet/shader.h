// The interface of users' fragment shaders. facet/shader/shader-inl.h says how to write one; the CMake function
// facet_add_shader() compiles it for every instruction set.
#pragma once

#include <cstdint>

namespace facet {

struct ShadeTask;

// For which materials a shader reads the lights and the environment. A frame does not prepare light that nothing reads.
enum class LightUse : std::uint8_t {
  None,            // for example, a shader that shows normals
  LitMaterials,    // not for unlit materials, whose surfaces have neither position nor normal
  EveryMaterial,
};

// The LightUse that a shader's functor declares as `static constexpr facet::LightUse kLight = ...;`, or else the
// default.
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
  // A shader that declares less than it reads finds neither lights nor an environment.
  virtual LightUse Light() const { return LightUse::LitMaterials; }
  // Whether materials with transmission stay transparent, because Shade() fills ShadeTask::seen_through. Those of other
  // shaders are as opaque as their alpha mode says.
  virtual bool Transmits() const { return false; }
};

}  // namespace facet
