#include "render/environment_background.h"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "render/frame_view.h"
#include "scene/camera.h"
#include "shade/shade_task.h"

namespace facet {
namespace {

TEST(ViewDirections, AreThoseThroughEachPixelToTheBit) {
  for (const bool orthographic : {false, true}) {
    ResolvedCamera camera;
    const glm::dvec3 eye(3.1, 2.3, -7.7), target(0.4, -0.2, 0.9);
    camera.world_from_camera = glm::inverse(glm::lookAt(eye, target, glm::dvec3(0, 1, 0)));
    camera.lens.orthographic = orthographic;
    const FrameView view = MakeFrameView(camera, 71, 33);
    const ViewDirections d = MakeViewDirections(view);
    for (int y = 0; y < view.height; ++y) {
      for (int x = 0; x < view.width; ++x) {
        const glm::dvec3 want = DirectionThrough(view, x + 0.5, y + 0.5);
        for (int c = 0; c < 3; ++c) {
          ASSERT_EQ((d.column[c][std::size_t(x)] + d.row[c][std::size_t(y)]) + d.whole[c], want[c]) << x << " " << y;
        }
      }
    }
    for (const auto& column : d.column) EXPECT_EQ(column.size(), std::size_t(view.width) + kTaskPadding);
  }
}

}  // namespace
}  // namespace facet
