// From the choice of a camera to a place and a lens.
#pragma once

#include <glm/glm.hpp>

#include "facet/render.h"
#include "facet/scene.h"
#include "scene/pose.h"

namespace facet {

struct ResolvedCamera {
  glm::dmat4 world_from_camera{1.0};  // rigid; looks along -Z, +Y up
  Camera lens;                        // `aspect`, or xmag / ymag, is the picture's; both are positive
};

// The camera for a picture of width x height pixels.
//
// AutoCamera stands at theta 30 degrees, phi 75 degrees of an OrbitCamera around the centre of the bounds. A framed
// distance is the smallest at which the bounds' eight corners lie within the frustum, narrowed by 5 % as a margin;
// empty bounds count as a cube of side 1 around the origin. Orbits that look straight down or up have -Z or +Z up for
// theta 0, the limit of +Y up. Their near plane is so near that it cuts only what surrounds the eye (depth keeps its
// precision, it is stored as 1 / w); there is no far plane.
//
// A SceneCamera's node gives place and direction; its scale and shear are dropped. A FreeCamera stands as it is. The
// lenses of both are fitted to the picture: never cropped nor stretched. In a picture that is narrower than the lens
// (aspect, or xmag / ymag) the vertical field of view grows until the horizontal one is kept; in a wider one, and where
// a perspective lens has no aspect ratio, the vertical one is kept and more (or less) is seen to the sides. The sign of
// xmag and ymag means nothing.
// Source: glTF 2.0 specification, section 3.10.3.
//
// Throws Error(InvalidUsage) for numbers out of range (fields of view outside of (0, pi), angles or matrices that are
// not finite, a FreeCamera's matrix that is not rigid to 1e-6, a picture without pixels), for a camera that does not
// exist or that no node of the scene holds.
ResolvedCamera ResolveCamera(const CameraChoice& choice, const Scene& scene, const PosedScene& posed, int width,
                             int height);

}  // namespace facet
