#include "light/cull_lights.h"

#include <algorithm>

namespace facet {

void LightsReaching(const LightingData& lighting, const glm::dvec3& low, const glm::dvec3& high,
                    std::vector<PunctualLight>& reaching) {
  // A margin for the rounding in shading: of squared distances, and of positions, in proportion to their distance from
  // the eye.
  constexpr double kBeyond = 1.0 + 1e-3, kRounding = 1e-6;
  const double extent = std::max(glm::length(low), glm::length(high));
  reaching.clear();
  for (int i = 0; i < lighting.light_count; ++i) {
    const PunctualLight& light = lighting.lights[i];
    const glm::dvec3 at(light.position_eye[0], light.position_eye[1], light.position_eye[2]);
    const double slack = kRounding * std::max(extent, glm::length(at));
    const glm::dvec3 away = glm::max(glm::max(low - at, at - high) - slack, glm::dvec3(0.0));
    const bool ends_before = light.type != LightType::Directional &&
                             glm::dot(away, away) * double(light.inverse_range2) > kBeyond;
    if (!ends_before) reaching.push_back(light);
  }
}

}  // namespace facet
