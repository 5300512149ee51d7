// A batch of fragments of one material: the input and output of a shading kernel.
#pragma once

#include <cstddef>
#include <cstdint>

#include "light/lighting.h"
#include "plan/frame_material.h"

namespace facet {

// Where a kernel puts what surfaces with transmission do to what is seen through them. Writable up to a multiple of 16.
struct SeenThroughOutputs {
  float* tint[3] = {};  // red, green, blue: factors of what is seen
  // Where it is seen, in pixels from the fragment. By channel; the last two may be null if the material does not
  // disperse light.
  float* shift_x[3] = {};
  float* shift_y[3] = {};
  // The standard deviation of its blur, in pixels: in perspective views, of what is infinitely far behind; in
  // orthographic ones, of what is a metre behind.
  float* blur = nullptr;
};

struct ShadeTask {
  // Inputs, `count` of each, readable up to a multiple of 16: the index of the triangle's attribute setup, and the
  // position in pixels from the anchor, which is the pixel's centre, or the centroid of the covered samples if the
  // triangle does not cover all of them.
  const std::int32_t* setup = nullptr;  // index into `setups`
  const float* x = nullptr;
  const float* y = nullptr;
  std::size_t count = 0;
  const float* setups = nullptr;  // AttributeLayout::Stride() floats each
  const FrameMaterial* material = nullptr;
  const LightingData* lighting = nullptr;
  const void* parameters = nullptr;  // of a user's shader
  // For orthographic cameras the direction towards the eye, which is the same everywhere (world axes, unit).
  bool orthographic = false;
  float view_direction[3] = {0, 0, 1};
  // Outputs, writable up to a multiple of 16: linear radiance, not multiplied by alpha, and alpha.
  float* red = nullptr;
  float* green = nullptr;
  float* blue = nullptr;
  float* alpha = nullptr;
  const SeenThroughOutputs* seen_through = nullptr;  // for FrameMaterial::is_seen_through, else null
  // Homogeneous screen space (FrameView) from vectors in world axes, without offsets; read with `seen_through`.
  float screen_from_eye[3][3] = {};
  float pixels_per_tangent = 0.0f;      // pixels by which a tangent of 1 shifts: see SeenThroughOutputs::blur
  std::uint64_t* non_finite = nullptr;  // incremented for each fragment that is replaced by black
};

inline constexpr std::size_t kTaskPadding = 16;

}  // namespace facet
