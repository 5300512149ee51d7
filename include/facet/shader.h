// Fragment shaders of one's own: see facet/shader/shader-inl.h for how to write one, and facet_add_shader() in CMake for
// how to compile it for every instruction set.
#pragma once

namespace facet {

struct ShadeTask;

// Shades batches of fragments. Implementations are immutable and called from many threads at once.
class FragmentShader {
 public:
  virtual ~FragmentShader() = default;
  virtual void Shade(const ShadeTask& task) const = 0;
};

}  // namespace facet
