// Refuses to be compiled where the compiler may compute something else than what is written: the picture's bits are
// promised (docs/determinism.md). cmake/FacetArithmeticCheck.cmake looks at the flags; contraction can be seen there only.
#pragma once

#include <limits>

#if defined(__FAST_MATH__) || defined(__RECIPROCAL_MATH__) || defined(__ASSOCIATIVE_MATH__) || \
    defined(__NO_SIGNED_ZEROS__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#error "facet is compiled without -ffast-math and its parts: its pictures are the same to the last bit everywhere"
#endif

// 16: more precision for half floats alone, of which facet has none.
#if defined(__FLT_EVAL_METHOD__) && __FLT_EVAL_METHOD__ != 0 && __FLT_EVAL_METHOD__ != 16
#error "facet needs float arithmetic in float, double in double; x87 arithmetic keeps more digits"
#endif

static_assert(std::numeric_limits<float>::is_iec559 && std::numeric_limits<double>::is_iec559);
