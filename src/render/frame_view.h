// The camera of a frame in the form that the stages read.
#pragma once

#include "frame/geometry.h"
#include "scene/camera.h"
#include "scene/pose.h"

namespace facet {

FrameView MakeFrameView(const ResolvedCamera& camera, int width, int height);

// The direction from the eye through a point of the image (pixels), world axes, not normalised; for an orthographic
// camera, the direction in which it looks.
glm::dvec3 DirectionThrough(const FrameView& view, double x, double y);

// Places a drawable in front of the camera.
FrameDrawable MakeFrameDrawable(const FrameView& view, const Drawable& drawable);

}  // namespace facet
