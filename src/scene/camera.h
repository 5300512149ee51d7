// Resolves the choice of a camera to a pose and a lens.
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
  Camera lens;                        // `aspect`, or xmag / ymag, is the image's; all are positive
  double target_distance = 1.0;       // AutoCamera and OrbitCamera: distance of the target; others: 1
};

// An OrbitBall, cached from frame to frame, with the inputs that it was computed from.
struct KnownBall {
  PoseSettings pose;
  std::optional<glm::dvec3> centre;
  std::optional<OrbitBall> ball;
};

// The camera for an image of width x height pixels.
//
// An AutoCamera looks at the centre of the bounds from theta 30 degrees, phi 75 degrees. Its distance is the smallest
// at which all vertices lie within the frustum, narrowed by a margin of 5 %, and it is moved sideways so that the
// margins are equal. An OrbitCamera without a radius has the smallest distance at which its OrbitBall (framing.h),
// enlarged by a margin of 5 %, lies within the frustum. Empty bounds count as a cube of side 1 around the origin.
// Orbits that look straight down or up have -Z or +Z up for theta 0, which is the limit of +Y up. The near plane is so
// near that it clips only what surrounds the eye (depth is stored as 1 / w, so this costs no precision); there is no
// far plane.
//
// A SceneCamera gets position and direction from its node, whose scale and shear are dropped. A FreeCamera is used as
// it is. The lenses of both are fitted to the image without cropping or stretching. In an image that is narrower than
// the lens (aspect, or xmag / ymag), the horizontal field of view is kept and the vertical one grows. In a wider image,
// and for a perspective lens without aspect ratio, the vertical field of view is kept and more (or less) is visible at
// the sides. The signs of xmag and ymag are ignored. Source: glTF 2.0 specification, section 3.10.3.
//
// Throws Error(InvalidUsage) for values out of range (fields of view outside of (0, pi), angles or matrices that are
// not finite, a FreeCamera's matrix that is not rigid to 1e-6, an image without pixels), and for a camera that does not
// exist or that no node of the scene has. `known`: may be null.
ResolvedCamera ResolveCamera(const CameraChoice& choice, const Scene& scene, const PosedScene& posed, int width,
                             int height, KnownBall* known = nullptr);

}  // namespace facet
