// What a frame takes beyond its film and textures counts: drawables, vertices on the screen, layers of a tile, lists of
// triangles for tiles. A small scene may ask for any number of them.
#include <gtest/gtest.h>

#include "base/least_limit.h"
#include "frame/geometry.h"
#include "render/hand_built.h"
#include "scene/pose.h"

namespace facet {
namespace {

constexpr std::uint64_t kMiB = 1 << 20;

std::string Refusal(const Scene& scene, RenderSettings settings, std::uint64_t limit) {
  settings.memory_limit = limit;
  return MemoryRefusal([&] { Render(scene, settings); });
}

std::uint64_t Least(const Scene& scene, RenderSettings settings) {
  return LeastLimit([&](std::uint64_t limit) {
    settings.memory_limit = limit;
    Render(scene, settings);
  });
}

RenderSettings Small() { return Settings(16, 16, 1, Orthographic(1.0)); }

Scene Instances(std::size_t count, std::size_t vertices) {
  Scene scene;
  Primitive p = Rectangle(-1, -1, 1, 1);
  p.tex_coords.clear();
  p.positions.resize(vertices, glm::vec3(0));
  p.normals.resize(vertices, glm::vec3(0, 0, 1));
  const int node = Add(scene, std::move(p), AddMaterial(scene, Unlit(glm::vec4(1))));
  scene.nodes[std::size_t(node)].instances.resize(count);
  return scene;
}

TEST(FrameMemory, CountsDrawables) {
  constexpr std::uint64_t kCount = 5000;
  const std::uint64_t one = Least(Instances(1, 4), Small()), many = Least(Instances(kCount, 4), Small());
  EXPECT_GE(many, one + kCount * (sizeof(Drawable) + sizeof(FrameDrawable) + sizeof(TriangleChunk)));
  const std::string refusal = Refusal(Instances(kCount, 4), Small(), one + kMiB / 2);
  EXPECT_NE(refusal.find(" for drawables"), std::string::npos) << refusal;
}

TEST(FrameMemory, CountsVerticesOfEveryInstance) {
  constexpr std::uint64_t kInstances = 200, kVertices = 5000;
  const std::uint64_t one = Least(Instances(1, kVertices), Small()),
                      many = Least(Instances(kInstances, kVertices), Small());
  EXPECT_GE(many, one + (kInstances - 1) * kVertices * sizeof(ScreenVertex));
  const std::string refusal = Refusal(Instances(kInstances, kVertices), Small(), one + 4 * kMiB);
  EXPECT_NE(refusal.find("15.3 MiB for vertices on the screen"), std::string::npos) << refusal;
}

// Squares that cover the image, one behind the other, in one primitive.
Scene Layers(int count, AlphaMode mode) {
  Scene scene;
  Primitive all;
  for (int i = 0; i < count; ++i) {
    const Primitive layer = Rectangle(-2, -2, 2, 2, -0.001f * float(i));
    for (const std::uint32_t k : layer.indices) all.indices.push_back(k + std::uint32_t(all.positions.size()));
    all.positions.insert(all.positions.end(), layer.positions.begin(), layer.positions.end());
  }
  Add(scene, std::move(all), AddMaterial(scene, Unlit(glm::vec4(1, 1, 1, 0.01f), mode)));
  return scene;
}

// Why nothing is seen is found out by going through the geometry once more: that takes the place of the first time.
TEST(FrameMemory, AnEmptyImageTakesNoMoreThanAFullOne) {
  Scene front = Layers(2000, AlphaMode::Opaque), back = front;
  std::vector<std::uint32_t>& indices = back.meshes[0].primitives[0].indices;
  for (std::size_t i = 0; i + 2 < indices.size(); i += 3) std::swap(indices[i + 1], indices[i + 2]);
  EXPECT_EQ(Refusal(back, Small(), Least(front, Small())), "");
}

TEST(FrameMemory, CountsTheLayersOfATile) {
  RenderSettings settings = Settings(64, 64, 1, Orthographic(1.0));
  settings.tile_size = 64;
  settings.threads = 1;
  const Scene blended = Layers(100, AlphaMode::Blend);  // 409,600 fragments, of 120 bytes each
  const std::string refusal = Refusal(blended, settings, 24 * kMiB);
  EXPECT_NE(refusal.find(" for fragments of a tile"), std::string::npos) << refusal;
  EXPECT_NE(refusal.find("use smaller tiles or fewer threads"), std::string::npos) << refusal;
  EXPECT_EQ(Refusal(blended, settings, 128 * kMiB), "");
  EXPECT_EQ(Refusal(Layers(100, AlphaMode::Opaque), settings, 24 * kMiB), "") << "of these one is kept";
}

// Triangles in one tile, of which none is kept: their records are looked at all the same.
TEST(FrameMemory, CountsTheTrianglesOfATile) {
  RenderSettings settings = Small();
  settings.threads = 1;
  const auto scene = [](std::size_t count) {
    Scene made;
    Primitive small;
    for (std::size_t i = 0; i < count; ++i) {
      const float x = -0.9f + 0.3f * float(i % 6), y = -0.9f + 0.3f * float(i / 6 % 6);
      small.positions.insert(small.positions.end(), {{x, y, 0}, {x + 0.25f, y, 0}, {x, y + 0.25f, 0}});
    }
    Add(made, std::move(small), AddMaterial(made, Unlit(glm::vec4(1))));
    return made;
  };
  constexpr std::size_t kFew = 1 << 14, kMany = 3 << 14;
  const std::uint64_t few = Least(scene(kFew), settings), many = Least(scene(kMany), settings);
  // Positions, vertices on the screen, records; and what a tile has for each beyond what all tiles may have.
  constexpr std::uint64_t kEach = 3 * (sizeof(glm::vec3) + sizeof(ScreenVertex)) + sizeof(ScreenTriangle);
  EXPECT_GE(many, few + (kMany - kFew) * (kEach + 40));
}

TEST(FrameMemory, CountsTheListsOfTiles) {
  RenderSettings settings = Settings(512, 512, 1, Orthographic(1.0));
  settings.tile_size = 8;
  settings.threads = 1;
  const Scene scene = Layers(250, AlphaMode::Opaque);  // 500 triangles in half of 4096 tiles each, or more
  const std::string refusal = Refusal(scene, settings, 12 * kMiB);
  EXPECT_NE(refusal.find(" for lists of triangles for tiles"), std::string::npos) << refusal;
  EXPECT_NE(refusal.find("use larger tiles"), std::string::npos) << refusal;
  EXPECT_EQ(Refusal(scene, settings, 128 * kMiB), "");
  settings.tile_size = 64;
  EXPECT_EQ(Refusal(scene, settings, 12 * kMiB), "");
}

}  // namespace
}  // namespace facet
