# facet_add_shader(TARGET NAME FILE [PARAMETERS HEADER] [MAY_INLINE])
# Compiles the fragment shader functor NAME of FILE (see facet/shader/shader-inl.h) for every instruction set into TARGET,
# which links facet::core, and declares facet::MakeNAME() in a header named after FILE: toon.h gives "toon.shader.h".
# HEADER is for functors that have `NAMEParameters parameters;` as a member: it defines facet::NAMEParameters, and the
# function becomes MakeNAME(const NAMEParameters&). MAY_INLINE leaves to the compiler what it inlines
# (facet/shader/inline.h): large shaders compile faster and run slower, with the same values.
function(facet_add_shader target name file)
  cmake_parse_arguments(SHADER "MAY_INLINE" "PARAMETERS" "" ${ARGN})
  if(SHADER_PARAMETERS)
    get_filename_component(parameters ${SHADER_PARAMETERS} ABSOLUTE)
    set(include_parameters "#include \"${parameters}\"")
    set(taken "const ${name}Parameters& parameters")
    set(functor "${name}{*static_cast<const ${name}Parameters*>(task.parameters)}")
    set(kept "${name}Parameters parameters;")
    set(keep "shader->parameters = parameters;")
    set(pointer "&parameters")
  else()
    set(include_parameters)
    set(taken)
    set(functor "${name}()")
    set(kept)
    set(keep)
    set(pointer "nullptr")
  endif()
  get_filename_component(path ${file} ABSOLUTE)
  if(NOT EXISTS ${path})
    message(FATAL_ERROR "facet_add_shader: there is no file ${path}")
  endif()
  get_filename_component(stem ${file} NAME_WE)
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/facet_shaders/${target})
  set(header ${folder}/${stem}.shader.h)
  set(source ${folder}/${stem}.shader.cc)
  get_target_property(sources ${target} SOURCES)
  if(source IN_LIST sources)
    message(FATAL_ERROR "facet_add_shader: ${target} has a shader in a file called ${stem} already; rename one of them")
  endif()
  file(CONFIGURE OUTPUT ${header} @ONLY CONTENT [[// Written by facet_add_shader().
#pragma once
#include <memory>
#include "facet/shader.h"
@include_parameters@
namespace facet {
std::unique_ptr<const FragmentShader> Make@name@(@taken@);
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
void Shade@name@(const ShadeTask& task) { ShadePackets(task, @functor@); }
FACET_SHADER_END
#if HWY_ONCE
namespace facet {
namespace {
FACET_EXPORT(Shade@name@);
struct @name@Shader final : FragmentShader {
  @kept@
  void Shade(const ShadeTask& task) const override {
    ShadeTask mine = task;
    mine.parameters = @pointer@;
    FACET_DISPATCH(Shade@name@)(mine);
  }
  LightUse Light() const override { return LightUseOf<HWY_NAMESPACE::@name@>(); }
};
}  // namespace
std::unique_ptr<const FragmentShader> Make@name@(@taken@) {
  auto shader = std::make_unique<@name@Shader>();
  @keep@
  return shader;
}
}  // namespace facet
#endif
]])
  if(SHADER_MAY_INLINE)
    set_source_files_properties(${source} PROPERTIES COMPILE_DEFINITIONS FACET_MAY_INLINE)
  endif()
  target_sources(${target} PRIVATE ${source})
  target_include_directories(${target} PRIVATE ${folder})
  target_link_libraries(${target} PRIVATE facet::core facet::shader)
endfunction()
