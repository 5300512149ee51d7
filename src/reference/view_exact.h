// The camera of a reference image, in double and without snapping.
#pragma once

#include <algorithm>
#include <glm/glm.hpp>

#include "frame/constants.h"
#include "math/elementary.h"
#include "math/round_to_float.h"
#include "scene/camera.h"

namespace facet {

// "Screen space" is (x, y, w), homogeneous: a point with these is seen at (x / w, y / w) on a plane at distance 1,
// where y points up and `pixel` is the size of a pixel. w is the distance along the viewing axis; for an orthographic
// camera 1.
struct ExactView {
  ExactView(const ResolvedCamera& camera, int image_width, int image_height)
      : width(image_width),
        height(image_height),
        perspective(!camera.lens.orthographic),
        pixel(2.0 * (perspective ? Tan(0.5 * camera.lens.yfov) : camera.lens.ymag) / image_height),
        near_distance(std::max(camera.lens.znear, perspective ? kLeastDistance : -kMostDistance)),
        far_distance(perspective ? camera.lens.zfar : std::min(camera.lens.zfar, kMostDistance)),
        eye_world(camera.world_from_camera[3]),
        camera_from_world(glm::transpose(glm::dmat3(camera.world_from_camera))) {}

  // From a position in the image, in pixels.
  glm::dvec3 ScreenAt(const glm::dvec2& place) const {
    return {(place.x - 0.5 * width) * pixel, (0.5 * height - place.y) * pixel, 1.0};
  }
  // The inverse: pixels.
  glm::dvec2 PlaceOf(const glm::dvec3& screen) const {
    return {0.5 * width + screen.x / (screen.z * pixel), 0.5 * height - screen.y / (screen.z * pixel)};
  }
  glm::dvec3 ScreenOf(const glm::dvec3& in_camera) const {
    return {in_camera.x, in_camera.y, perspective ? -in_camera.z : 1.0};
  }
  // The view direction at a position in the image: unit, world axes.
  glm::dvec3 DirectionThrough(const glm::dvec2& place) const {
    const glm::dvec3 s = ScreenAt(place);
    return glm::normalize((perspective ? glm::dvec3(s.x, s.y, -1.0) : glm::dvec3(0.0, 0.0, -1.0)) * camera_from_world);
  }
  // The depth by which surfaces are ordered, as a float by the rasterizer's convention: larger is nearer.
  float DepthAt(double distance) const { return RoundToFloat(perspective ? 1.0 / distance : -distance); }

  int width, height;
  bool perspective;
  double pixel;
  double near_distance, far_distance;
  glm::dvec3 eye_world;
  glm::dmat3 camera_from_world;
};

}  // namespace facet
