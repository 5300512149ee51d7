// FACET_INLINE stands before functions of lanes. Kernels are fast because everything that they call is inlined into one
// loop, which takes a compiler long, and a compiler that adds checks to each access very long: ten minutes for one
// file. FACET_MAY_INLINE leaves the choice to the compiler, for builds with sanitizers and for the evaluation in
// double; the values are the same.
#pragma once

#include "hwy/base.h"

#ifdef FACET_MAY_INLINE
#define FACET_INLINE inline
#else
#define FACET_INLINE HWY_INLINE
#endif
