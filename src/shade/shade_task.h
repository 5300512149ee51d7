// A batch of fragments of one material, as it crosses into a shading kernel.
#pragma once

#include <cstddef>
#include <cstdint>

#include "light/lighting.h"
#include "plan/frame_material.h"

namespace facet {

struct ShadeTask {
  // Inputs, `count` of each, readable up to a multiple of 16: the fragment's triangle setup, and its place in pixels
  // from the anchor (the pixel's centre, or the centroid of its covered samples where the triangle covers a part).
  const std::int32_t* setup = nullptr;  // index into `setups`
  const float* x = nullptr;
  const float* y = nullptr;
  std::size_t count = 0;
  const float* setups = nullptr;  // SetupLayout::Stride() floats each
  const FrameMaterial* material = nullptr;
  const LightingData* lighting = nullptr;
  const void* parameters = nullptr;  // of a user's shader
  // Orthographic cameras look from everywhere in this direction (world axes, unit, towards the eye).
  bool orthographic = false;
  float view_direction[3] = {0, 0, 1};
  // Outputs, writable up to a multiple of 16: linear radiance, not multiplied by alpha, and alpha.
  float* red = nullptr;
  float* green = nullptr;
  float* blue = nullptr;
  float* alpha = nullptr;
  std::uint64_t* non_finite = nullptr;  // fragments that were replaced by black are added here
};

inline constexpr std::size_t kTaskPadding = 16;

}  // namespace facet
