# facet_add_shader(TARGET NAME FILE)
# Compiles the fragment shader functor NAME of FILE (see facet/shader/shader-inl.h) for every instruction set into TARGET,
# which links facet::core, and declares facet::MakeNAME() in a header named after FILE: toon.h gives "toon.shader.h".
function(facet_add_shader target name file)
  get_filename_component(path ${file} ABSOLUTE)
  get_filename_component(stem ${file} NAME_WE)
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/facet_shaders/${target})
  set(header ${folder}/${stem}.shader.h)
  set(source ${folder}/${stem}.shader.cc)
  file(CONFIGURE OUTPUT ${header} @ONLY CONTENT [[// Written by facet_add_shader().
#pragma once
#include <memory>
#include "facet/shader.h"
namespace facet {
std::unique_ptr<const FragmentShader> Make@name@();
}
]])
  file(CONFIGURE OUTPUT ${source} @ONLY CONTENT [[// Written by facet_add_shader().
#include "@header@"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "@source@"
#include "hwy/foreach_target.h"
#include "facet/shader/dispatch.h"
#include "facet/shader/shader-inl.h"
#include "@path@"
FACET_SHADER_BEGIN
void Shade@name@(const ShadeTask& task) { ShadePackets(task, @name@()); }
FACET_SHADER_END
#if HWY_ONCE
namespace facet {
namespace {
FACET_EXPORT(Shade@name@);
class @name@Shader final : public FragmentShader {
 public:
  void Shade(const ShadeTask& task) const override { FACET_DISPATCH(Shade@name@)(task); }
  LightUse Light() const override { return LightUseOf<HWY_NAMESPACE::@name@>(); }
};
}  // namespace
std::unique_ptr<const FragmentShader> Make@name@() { return std::make_unique<@name@Shader>(); }
}  // namespace facet
#endif
]])
  target_sources(${target} PRIVATE ${source})
  target_include_directories(${target} PRIVATE ${folder})
  target_link_libraries(${target} PRIVATE facet::core facet::shader)
endfunction()
