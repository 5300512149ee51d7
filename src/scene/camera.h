// From the choice of a camera to a place and a lens.
#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "facet/scene.h"
#include "facet/settings.h"
#include "scene/framing.h"
#include "scene/pose.h"

namespace facet {

struct ResolvedCamera {
  glm::dmat4 world_from_camera{1.0};  // rigid; looks along -Z, +Y up
  Camera lens;                        // `aspect`, or xmag / ymag, is the picture's; both are positive
  double target_distance = 1.0;       // of what an AutoCamera or an OrbitCamera looks at; 1 of others
};

// A measured ball and what it was measured for, kept from frame to frame.
struct KnownBall {
  PoseSettings pose;
  std::optional<glm::dvec3> centre;
  std::optional<OrbitBall> ball;
};

// The camera for a picture of width x height pixels.
//
// AutoCamera stands at theta 30 degrees, phi 75 degrees around the centre of the bounds, at the smallest distance at
// which all vertices lie within the frustum, narrowed by 5 % as a margin, and moved aside so that the margins are
// equal. An OrbitCamera without a radius stands where its OrbitBall (framing.h), a margin of 5 % larger, just lies
// within the frustum. Empty bounds count as a cube of side 1 around the origin. Orbits that look straight down or up
// have -Z or +Z up for theta 0, the limit of +Y up. Their near plane is so near that it cuts only what surrounds the
// eye (depth keeps its precision, it is stored as 1 / w); there is no far plane.
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
// exist or that no node of the scene holds. `known`: may be null.
ResolvedCamera ResolveCamera(const CameraChoice& choice, const Scene& scene, const PosedScene& posed, int width,
                             int height, KnownBall* known = nullptr);

}  // namespace facet
