// The fill rule: which samples a screen triangle covers. I is an integer, std::int64_t or lanes of 32 bits (Int).

#if defined(FACET_FRAME_EDGE_FUNCTION_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FACET_FRAME_EDGE_FUNCTION_INL_H_
#undef FACET_FRAME_EDGE_FUNCTION_INL_H_
#else
#define FACET_FRAME_EDGE_FUNCTION_INL_H_
#endif

#include "facet/shader/lane-inl.h"

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace HWY_NAMESPACE {

// a * x + b * y + c, with x and y in 1/256 pixel: 0 or more on the inner side of one edge. A sample for which that
// holds of all three edges is covered.
template <class I>
struct EdgeFunction {
  I a, b, c;
};

// Of the edge from one corner to the next, clockwise on the screen (y down). Exact, if it does not overflow.
template <class I>
FACET_INLINE EdgeFunction<I> MakeEdgeFunction(I from_x, I from_y, I to_x, I to_y) {
  const I a = from_y - to_y, b = to_x - from_x;
  // A sample on an edge belongs to the triangle if the edge is a left one (inside lies towards +x) or a top one
  // (horizontal, inside below), so that two triangles with a common edge never both cover it, and never neither. For
  // integers, e > 0 is e - 1 >= 0.
  const auto left_or_top = (a > I(0)) | ((a == I(0)) & (b > I(0)));
  return {a, b, Select(left_or_top, I(0), I(-1)) - a * from_x - b * from_y};
}

// Whether all three edge functions have the sample on their inner side.
template <class I>
FACET_INLINE auto IsCovered(I e0, I e1, I e2) {
  return !((e0 | e1 | e2) < I(0));
}

}  // namespace HWY_NAMESPACE
}  // namespace facet
HWY_AFTER_NAMESPACE();

#endif
