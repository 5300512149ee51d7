// Everything that a user's fragment shader needs. A shader is a functor in its own file:
//
//   #include "facet/shader/shader-inl.h"
//   FACET_SHADER_BEGIN
//   struct Toon {
//     template <class T>
//     FACET_INLINE Shaded<T> operator()(const Surface<T>& surface, const MaterialView<T>& material,
//                                     const LightingView<T>& lighting) const { ... }
//   };
//   FACET_SHADER_END
//
// and in CMake:  facet_add_shader(my_program Toon toon.h)
// which compiles it for every instruction set and gives the program `facet::MakeToon()`, declared in "toon.shader.h":
// a std::unique_ptr<const facet::FragmentShader> for RenderSettings::shader.
//
// A functor that reads no light, or reads it for unlit materials as well, declares it: `static constexpr LightUse
// kLight = LightUse::None;` (facet/shader.h). The frame does not prefilter an environment that no shader reads.
//
// T is Float, a packet of lanes: arithmetic, comparison, Select, Min, Max, Clamp, Sqrt and the functions of
// elementary-inl.h work on it; `if` does not. The file may be included many times: it has no include guard of its own
// and defines nothing outside FACET_SHADER_BEGIN and FACET_SHADER_END.

#if defined(FACET_SHADER_SHADER_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FACET_SHADER_SHADER_INL_H_
#undef FACET_SHADER_SHADER_INL_H_
#else
#define FACET_SHADER_SHADER_INL_H_
#endif

#include "facet/shader.h"
#include "facet/shader/elementary-inl.h"
#include "facet/shader/surface-inl.h"
#include "light/lighting-inl.h"
#include "material/models/all-inl.h"
#include "shade/material_view-inl.h"
#include "shade/shade_packets-inl.h"

#undef FACET_SHADER_BEGIN
#undef FACET_SHADER_END
#define FACET_SHADER_BEGIN  \
  HWY_BEFORE_NAMESPACE();   \
  namespace facet {         \
  namespace HWY_NAMESPACE {
#define FACET_SHADER_END \
  }                      \
  }                      \
  HWY_AFTER_NAMESPACE();

#endif
