// Planes besides colour of one tile, whose depths and records are made up.
#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <random>

#include "resolve/resolve_planes.h"

namespace facet {
namespace {

constexpr std::uint32_t kNobody = 0xffffffff;

struct Made {
  TileBuffers tile;
  std::vector<ScreenTriangle> records;
  std::vector<const ScreenTriangle*> pointers;
  FrameView view;
};

// Depths are few, so that samples share them.
Made RandomTile(int tile_size, int width, int height, int samples, bool perspective) {
  Made made;
  std::mt19937 random(unsigned(tile_size + samples));
  TileBuffers& tile = made.tile;
  tile.tile_size = tile_size, tile.width = width, tile.height = height, tile.samples = samples;
  for (int i = 0; i < tile_size * tile_size * samples; ++i) {
    tile.record.push_back(random() % 3 == 0 ? kNoRecord : std::int32_t(random() % 50));
    const float size = float(1 + random() % 4) * 0.25f;
    const float depth = perspective ? size : -size;
    tile.depth.push_back(tile.record.back() == kNoRecord ? -std::numeric_limits<float>::infinity() : depth);
  }
  made.records.resize(50);
  for (std::uint32_t i = 0; i < 50; ++i) made.records[i].primitive = 1000 - i;
  for (const ScreenTriangle& record : made.records) made.pointers.push_back(&record);
  made.view.perspective = perspective;
  return made;
}

std::vector<Plane> Sized(std::size_t pixels) {
  std::vector<Plane> planes(2);
  planes[0].kind = PlaneKind::Triangle;
  planes[1].kind = PlaneKind::Depth;
  for (Plane& plane : planes) plane.bytes.assign(pixels * 4, std::byte(0x5a));
  return planes;
}

TEST(ResolvePlanes, TakeTheFirstOfTheNearestSamples) {
  constexpr std::size_t kWidth = 40, kFirst = 3 * kWidth + 7;
  PlaneResolver resolver;
  for (const int samples : {1, 2, 4, 8}) {
    for (const bool perspective : {true, false}) {
      const Made made = RandomTile(16, 13, 9, samples, perspective);
      std::vector<Plane> planes = Sized(kWidth * 20);
      resolver.Run({made.tile, false, made.pointers.data(), made.view, nullptr}, kFirst, kWidth, planes);
      std::vector<std::uint32_t> triangles(kWidth * 20, 0x5a5a5a5a);
      std::vector<float> depths(kWidth * 20);
      std::memset(depths.data(), 0x5a, depths.size() * 4);
      for (int y = 0; y < 9; ++y) {
        for (int x = 0; x < 13; ++x) {
          const std::size_t p = kFirst + std::size_t(y) * kWidth + std::size_t(x);
          triangles[p] = kNobody;
          depths[p] = std::numeric_limits<float>::infinity();
          for (int s = 0; s < samples; ++s) {
            const std::size_t i = made.tile.Index(x, y, s);
            if (made.tile.record[i] == kNoRecord) continue;
            const float distance = perspective ? 1.0f / made.tile.depth[i] : -made.tile.depth[i];
            if (!(distance < depths[p])) continue;
            depths[p] = distance;
            triangles[p] = 1000 - std::uint32_t(made.tile.record[i]);
          }
        }
      }
      EXPECT_EQ(std::memcmp(planes[0].bytes.data(), triangles.data(), planes[0].bytes.size()), 0) << samples;
      EXPECT_EQ(std::memcmp(planes[1].bytes.data(), depths.data(), planes[1].bytes.size()), 0) << samples;
    }
  }
}

TEST(ResolvePlanes, OfAnEmptyTileAreNothingWhateverItsBuffersHold) {
  TileBuffers tile;
  tile.tile_size = 8, tile.width = 8, tile.height = 8, tile.samples = 4;
  std::vector<Plane> planes = Sized(64);
  PlaneResolver().Run({tile, true, nullptr, FrameView(), nullptr}, 0, 8, planes);
  for (const std::uint32_t triangle : planes[0].As<std::uint32_t>()) ASSERT_EQ(triangle, kNobody);
  for (const float depth : planes[1].As<float>()) ASSERT_EQ(depth, std::numeric_limits<float>::infinity());
}

}  // namespace
}  // namespace facet
