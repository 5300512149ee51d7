// View-frustum culling of whole drawables.
#pragma once

#include "frame/geometry.h"
#include "scene/pose.h"

namespace facet {

// True only if the vertex stage would find all vertices in `box` (mesh space) outside of the same side of the view,
// with rounding taken into account, so that no primitive of the drawable is visible. False for an empty box.
bool OutsideView(const FrameView& view, const FrameDrawable& drawable, const Bounds& box);

}  // namespace facet
