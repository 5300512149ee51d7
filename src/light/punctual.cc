#include "light/punctual.h"

#include <algorithm>
#include <cmath>

#include "math/elementary.h"
#include "math/round_to_float.h"

namespace facet {
namespace {

bool IsFinite(const float (&v)[3]) { return std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]); }

void Copy(glm::dvec3 from, float* to) {
  for (int i = 0; i < 3; ++i) to[i] = RoundToFloat(from[i]);
}

}  // namespace

std::vector<PunctualLight> MakePunctualLights(const std::vector<PosedLight>& lights, glm::dvec3 eye_world) {
  std::vector<PunctualLight> result;
  result.reserve(lights.size());
  for (const PosedLight& posed : lights) {
    const Light& light = *posed.light;
    const glm::dvec3 intensity = glm::dvec3(light.color) * double(light.intensity);
    const bool shines = intensity.x > 0.0 || intensity.y > 0.0 || intensity.z > 0.0;
    if (!shines || !(light.range > 0.0f)) continue;
    PunctualLight p;
    p.type = light.type;
    Copy(posed.position_world - eye_world, p.position_eye);
    // A distance that overflows a float is so large that no light arrives.
    if (light.type != LightType::Directional && !IsFinite(p.position_eye)) continue;
    Copy(posed.direction_world, p.direction);
    Copy(intensity, p.intensity);
    if (light.type != LightType::Directional) {
      const double r2 = double(light.range) * double(light.range);
      p.inverse_range2 = static_cast<float>(std::min(1.0 / r2, 1e30));  // 0 for an infinite range
    }
    if (light.type == LightType::Spot) {
      // KHR_lights_punctual, "Inner and Outer Cone Angles", the implementation that it recommends.
      const double cos_outer = Cos(double(light.outer_cone_angle));
      const double scale = 1.0 / std::max(0.001, Cos(double(light.inner_cone_angle)) - cos_outer);
      p.spot_scale = static_cast<float>(scale);
      p.spot_offset = static_cast<float>(-cos_outer * scale);
    }
    result.push_back(p);
  }
  return result;
}

}  // namespace facet
