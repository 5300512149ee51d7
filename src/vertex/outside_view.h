// Whole drawables that the picture does not show.
#pragma once

#include "frame/geometry.h"
#include "scene/pose.h"

namespace facet {

// True only if the vertex stage would find every vertex within `box` (mesh space) beyond one and the same side of the
// view, rounding included: then none of the drawable's primitives is visible. False for an empty box.
bool OutsideView(const FrameView& view, const FrameDrawable& drawable, const Bounds& box);

}  // namespace facet
