// Refuses compilation with options that allow the compiler to change floating-point results, because the bits of images
// are guaranteed (docs/determinism.md). cmake/FacetArithmeticCheck.cmake checks the flags as well, since contraction is
// visible only there.
#pragma once

#include <limits>

#if defined(__FAST_MATH__) || defined(__RECIPROCAL_MATH__) || defined(__ASSOCIATIVE_MATH__) || \
    defined(__NO_SIGNED_ZEROS__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#error "facet is compiled without -ffast-math and its parts: its pictures are the same to the last bit everywhere"
#endif

// 16 means more precision for half floats only, which facet does not use.
#if defined(__FLT_EVAL_METHOD__) && __FLT_EVAL_METHOD__ != 0 && __FLT_EVAL_METHOD__ != 16
#error "facet needs float arithmetic in float, double in double; x87 arithmetic keeps more digits"
#endif

static_assert(std::numeric_limits<float>::is_iec559 && std::numeric_limits<double>::is_iec559);
