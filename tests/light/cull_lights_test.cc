// A light that is left out gives nothing anywhere in the box.
#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "light/cull_lights.h"
#include "light/lighting-inl.h"

namespace facet {
namespace {

namespace lanes = HWY_NAMESPACE;

TEST(CullLights, CulledLightsGiveNothingInTheBox) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(-10.0, 10.0), size(0.0, 3.0), unit(0.0, 1.0), range(0.1, 8.0);
  Light light;
  std::vector<PosedLight> posed;
  std::vector<Light> lights;
  lights.reserve(401);  // others point into it
  lights.resize(400, light);
  for (std::size_t i = 0; i < lights.size(); ++i) {
    lights[i].type = i % 3 == 0 ? LightType::Spot : LightType::Point;
    if (i % 7 != 0) lights[i].range = static_cast<float>(range(random));
    posed.push_back({&lights[i], {place(random), place(random), place(random)}, {0.0, -1.0, 0.0}});
  }
  lights.push_back(light);
  lights.back().type = LightType::Directional;
  posed.push_back({&lights.back(), {0, 0, 0}, {0.0, -1.0, 0.0}});
  const std::vector<PunctualLight> all = MakePunctualLights(posed, {0, 0, 0});
  LightingData lighting;
  lighting.lights = all.data();
  lighting.light_count = static_cast<int>(all.size());
  std::vector<PunctualLight> reaching;
  std::size_t culled = 0, wrongly_kept = 0;
  for (int round = 0; round < 200; ++round) {
    const glm::dvec3 low(place(random), place(random), place(random));
    const glm::dvec3 high = low + glm::dvec3(size(random), size(random), size(random));
    LightsReaching(lighting, low, high, reaching);
    std::size_t next = 0;
    for (const PunctualLight& l : all) {
      const bool kept = next < reaching.size() && reaching[next].position_eye[0] == l.position_eye[0] &&
                        reaching[next].inverse_range2 == l.inverse_range2 && reaching[next].type == l.type;
      bool lit = false;
      for (int k = 0; k < 27; ++k) {  // corners, middles of edges and faces, the centre
        const glm::vec3 t(float(k % 3) / 2, float(k / 3 % 3) / 2, float(k / 9) / 2);
        const glm::vec3 p = glm::vec3(low) + glm::vec3(high - low) * t;
        lit |= lanes::SamplePunctual<float>(l, {p.x, p.y, p.z}).irradiance.x != 0.0f;
      }
      if (kept) {
        ++next;
        wrongly_kept += !lit;
      } else {
        ++culled;
        EXPECT_FALSE(lit);
      }
    }
    EXPECT_EQ(next, reaching.size());  // the order is kept
  }
  EXPECT_GT(culled, 40000u);  // of 80,200
  EXPECT_LT(wrongly_kept, 20000u);
}

}  // namespace
}  // namespace facet
