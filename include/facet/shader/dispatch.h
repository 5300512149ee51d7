// Run-time choice of the instruction set, and dispatch to a kernel's version for it. A kernel's source file looks like
// this:
//
//   #undef HWY_TARGET_INCLUDE
//   #define HWY_TARGET_INCLUDE "raster/raster_tile.cc"   // itself, as the include path finds it
//   #include "hwy/foreach_target.h"
//   #include "facet/shader/lane-inl.h"
//   HWY_BEFORE_NAMESPACE();
//   namespace facet { namespace HWY_NAMESPACE {
//   void RasterTile(const TileTask& task) { ... }        // once per instruction set
//   } }
//   HWY_AFTER_NAMESPACE();
//   #if HWY_ONCE
//   namespace facet {
//   FACET_EXPORT(RasterTile);
//   void RasterTile(const TileTask& task) { FACET_DISPATCH(RasterTile)(task); }
//   }
//   #endif
//
// Only pointers, references and scalars may be passed through the dispatch. Lambdas in a kernel need HWY_ATTR.
#pragma once

#include "facet/shader/arithmetic_check.h"

namespace facet {

// Instruction sets by Highway's names. Neon is the best target of 64-bit Arm.
enum class Target { Scalar, Sse4, Avx2, Avx3, Neon };

// The target in use: the one named by the environment variable FACET_TARGET (SCALAR, SSE4, AVX2, AVX3, NEON), otherwise
// the best that the processor supports. Throws Error(InvalidUsage) if the variable names an unknown target, or one that
// the processor does not support.
Target ActiveTarget();
const char* TargetName(Target target);
bool TargetIsAvailable(Target target);

// For tests: overrides FACET_TARGET for the lifetime of the object. Must not be used while a frame is rendered.
class ScopedTarget {
 public:
  explicit ScopedTarget(Target target);
  ~ScopedTarget();
  ScopedTarget(const ScopedTarget&) = delete;
  ScopedTarget& operator=(const ScopedTarget&) = delete;

 private:
  int previous_;
};

// The version for `target`, or the scalar one if the build does not contain it.
template <class Function>
Function ChooseKernel(Target target, Function scalar, Function sse4, Function avx2, Function avx3, Function neon) {
  const Function best = target == Target::Sse4   ? sse4
                        : target == Target::Avx2 ? avx2
                        : target == Target::Avx3 ? avx3
                        : target == Target::Neon ? neon
                                                 : scalar;
  return best != nullptr ? best : scalar;
}

}  // namespace facet

#define FACET_EXPORT(F)                                                                     \
  static decltype(&HWY_STATIC_DISPATCH(F)) F##ForTarget(::facet::Target target) {           \
    return ::facet::ChooseKernel<decltype(&HWY_STATIC_DISPATCH(F))>(                        \
        target, HWY_CHOOSE_FALLBACK(F), HWY_CHOOSE_SSE4(F), HWY_CHOOSE_AVX2(F),             \
        HWY_CHOOSE_AVX3(F), HWY_CHOOSE_NEON(F));                                            \
  }                                                                                         \
  static_assert(true, "")
#define FACET_DISPATCH(F) (F##ForTarget(::facet::ActiveTarget()))
