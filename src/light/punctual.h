// Punctual lights (directional, point, spot) in the form that kernels take.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "scene/pose.h"

namespace facet {

// A light of KHR_lights_punctual, with derived values. World axes, metres, relative to the camera's eye.
struct PunctualLight {
  LightType type = LightType::Point;
  float position_eye[3] = {0, 0, 0};       // point and spot
  float direction[3] = {0, 0, -1};         // unit, in which the light shines; directional and spot
  float intensity[3] = {0, 0, 0};          // colour * intensity: lux for directional, else candela
  float inverse_range2 = 0.0f;             // range^-2; 0: unlimited
  float spot_scale = 0.0f;                 // angular attenuation = clamp(cos * scale + offset, 0, 1)^2
  float spot_offset = 1.0f;
};

// Prepares the lights in the scene's order. Lights that are black, of range 0 or infinitely far away are culled.
// `eye_world`: the camera's position.
std::vector<PunctualLight> MakePunctualLights(const std::vector<PosedLight>& lights, glm::dvec3 eye_world);

}  // namespace facet
