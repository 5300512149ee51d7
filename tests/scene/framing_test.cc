#include "scene/framing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "scene_helpers.h"

namespace facet {
namespace {

constexpr CameraAxes kAxes = {{0.8, 0.0, -0.6}, {-0.36, 0.8, -0.48}, {0.48, 0.6, 0.64}};

// Some hundred small drawables here and there, turned and stretched.
Scene Scattered(unsigned seed) {
  std::mt19937 random(seed);
  const auto number = [&] { return std::ldexp(static_cast<double>(random()), -31) - 1.0; };
  Scene scene;
  for (int i = 0; i < 200; ++i) {
    Primitive p;
    for (int k = 0; k < 30; ++k) p.positions.emplace_back(number(), number(), number());
    if (i % 4 == 0) p.positions[std::size_t(i % 30)].y = i % 8 == 0 ? HUGE_VALF : NAN;
    scene.meshes.emplace_back().primitives.push_back(std::move(p));
    Node& node = scene.nodes.emplace_back();
    node.mesh = i;
    node.transform.translation = glm::dvec3(number(), number(), number()) * (i % 10 == 0 ? 3.0 : 2.0);
    node.transform.rotation = glm::normalize(glm::dquat(number(), number(), number(), number()));
    node.transform.scale = glm::dvec3(number(), number(), number());
  }
  return scene;
}

// Drawables whose boxes lie within what was measured are left out: that must not be seen.
TEST(MeasureView, IsTheGreatestOverAllVertices) {
  const double tan_x = 0.7, tan_y = 0.4;
  const glm::dvec3 target(1.0, -2.0, 3.0);
  for (unsigned seed = 1; seed <= 40; ++seed) {
    const Scene scene = Scattered(seed);
    const PosedScene posed = Pose(scene, {});
    ASSERT_EQ(posed.drawables.size(), 200u);
    double expected[5] = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    for (const Drawable& drawable : posed.drawables) {
      EXPECT_FALSE(drawable.bounds_mesh.empty) << "the test shows nothing";
      for (std::size_t i = 0; i < drawable.geometry->positions.size(); ++i) {
        const glm::dvec3 p = WorldPosition(drawable, i) - target;
        const double x = glm::dot(p, kAxes.right), y = glm::dot(p, kAxes.up), z = glm::dot(p, kAxes.back);
        const double values[5] = {x + tan_x * z, -x + tan_x * z, y + tan_y * z, -y + tan_y * z, z};
        if (!std::isfinite(x) || !std::isfinite(y)) continue;
        for (int k = 0; k < 5; ++k) expected[k] = std::max(expected[k], values[k]);
      }
    }
    const ViewExtent seen = MeasureView(posed, target, kAxes, tan_x, tan_y);
    const double got[5] = {seen.right, seen.left, seen.top, seen.bottom, seen.nearest};
    for (int k = 0; k < 5; ++k) EXPECT_NEAR(got[k], expected[k], 1e-12 * 100) << "measure " << k << ", seed " << seed;

    // Without boxes nothing can be left out.
    PosedScene unknown = Pose(scene, {});
    for (Drawable& drawable : unknown.drawables) drawable.bounds_mesh = Bounds{};
    const ViewExtent whole = MeasureView(unknown, target, kAxes, tan_x, tan_y);
    const double all[5] = {whole.right, whole.left, whole.top, whole.bottom, whole.nearest};
    for (int k = 0; k < 5; ++k) EXPECT_EQ(got[k], all[k]) << "measure " << k << ", seed " << seed;
  }
}

}  // namespace
}  // namespace facet
