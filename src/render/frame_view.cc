#include "render/frame_view.h"

#include <algorithm>
#include <cmath>

#include "frame/constants.h"
#include "math/elementary.h"
#include "math/round_to_float.h"
#include "scene/topology.h"

namespace facet {

FrameView MakeFrameView(const ResolvedCamera& camera, int width, int height) {
  FrameView view;
  const Camera& lens = camera.lens;
  view.width = width;
  view.height = height;
  view.perspective = !lens.orthographic;
  view.near_distance = std::max(lens.znear, view.perspective ? kLeastDistance : -kMostDistance);
  view.far_distance = view.perspective ? lens.zfar : std::min(lens.zfar, kMostDistance);
  view.eye_world = glm::dvec3(camera.world_from_camera[3]);
  view.camera_from_world = glm::transpose(glm::dmat3(camera.world_from_camera));
  if (view.perspective) {
    const double focal = height * 0.5 / Tan(lens.yfov * 0.5);  // pixels
    view.screen_x = {focal, 0.0, -0.5 * width};
    view.screen_y = {0.0, -focal, -0.5 * height};
  } else {
    view.screen_x = {width * 0.5 / lens.xmag, 0.0, 0.0};
    view.screen_y = {0.0, -height * 0.5 / lens.ymag, 0.0};
    view.offset_x = width * 0.5;
    view.offset_y = height * 0.5;
  }
  return view;
}

glm::dvec3 DirectionThrough(const FrameView& view, double x, double y) {
  if (!view.perspective) return glm::dvec3(0.0, 0.0, -1.0) * view.camera_from_world;
  const glm::dvec3 camera((x - view.width * 0.5) / view.screen_x.x, (y - view.height * 0.5) / view.screen_y.y, -1.0);
  return camera * view.camera_from_world;  // v * M is transpose(M) * v
}

namespace {

// The eye in mesh space. Positions relative to it are rounded in proportion to their distance, and so is what the
// screen shows of the error. All primitives of a mesh share it, so that there are no cracks between them.
glm::vec3 EyeInMesh(const glm::dmat3& linear, const glm::dvec3& origin_eye) {
  const glm::dvec3 eye = glm::inverse(linear) * -origin_eye;
  constexpr double kLimit = 1e30;  // of what is left of a singular matrix
  const bool usable = std::fabs(eye.x) < kLimit && std::fabs(eye.y) < kLimit && std::fabs(eye.z) < kLimit;
  return usable ? glm::vec3(eye) : glm::vec3(0.0f);
}

}  // namespace

FrameDrawable MakeFrameDrawable(const FrameView& view, const Drawable& drawable) {
  FrameDrawable out;
  out.geometry = drawable.geometry;
  out.primitive_count = PrimitiveCount(*drawable.geometry);
  const glm::dmat3 linear(drawable.world_from_mesh);
  const glm::dvec3 origin_eye = glm::dvec3(drawable.world_from_mesh[3]) - view.eye_world;
  const double determinant = glm::determinant(linear);
  out.mirrored = determinant < 0.0;
  out.metres_per_unit = RoundToFiniteFloat(Cbrt(std::fabs(determinant)));
  // Columns of the cofactor matrix; its sign follows the determinant's, normals do not.
  const glm::dmat3 cofactors(glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]),
                             glm::cross(linear[0], linear[1]));
  out.normal_from_mesh = out.mirrored ? -cofactors : cofactors;

  const glm::dmat3 by_row = glm::transpose(linear);
  for (int i = 0; i < 3; ++i) out.eye_relative_from_mesh[i] = glm::dvec4(by_row[i], origin_eye[i]);

  const glm::dmat3 camera_linear = view.camera_from_world * linear;
  const glm::dvec3 camera_origin = view.camera_from_world * origin_eye;
  const glm::dvec3 rows[3] = {view.screen_x, view.screen_y, {0.0, 0.0, -1.0}};
  const double offsets[3] = {view.offset_x, view.offset_y, 0.0};
  out.centre_mesh = EyeInMesh(linear, origin_eye);
  for (int i = 0; i < 3; ++i) {
    const glm::dvec3 row = rows[i] * camera_linear;
    const double translation = glm::dot(rows[i], camera_origin) + offsets[i];
    out.screen_from_mesh[i] = glm::dvec4(row, translation);
    out.screen_from_local[i] = RoundToFloat(glm::dvec4(row, glm::dot(row, glm::dvec3(out.centre_mesh)) + translation));
  }
  return out;
}

}  // namespace facet
