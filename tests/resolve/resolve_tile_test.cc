// Samples into pixels, against a mean over samples written out one by one.
#include <gtest/gtest.h>

#include <cstring>
#include <random>

#include "resolve/resolve_tile.h"

namespace facet {
namespace {

struct Tile {
  TileBuffers buffers;
  ShadedFragments fragments;
  std::vector<std::vector<int>> owner;  // of each pixel's samples: index of a fragment, -1: none
};

Tile RandomTile(int tile_size, int samples, unsigned seed) {
  std::mt19937 random(seed);
  Tile tile;
  tile.buffers.tile_size = tile.buffers.width = tile.buffers.height = tile_size;
  tile.buffers.samples = samples;
  for (int p = 0; p < tile_size * tile_size; ++p) {
    std::vector<int> owner(std::size_t(samples), -1);
    const int count = int(random() % 4);  // fragments of this pixel
    std::vector<unsigned> masks(std::size_t(count), 0u);
    for (int s = 0; s < samples; ++s) {
      const int k = int(random() % 5);
      if (k < count) masks[std::size_t(k)] |= 1u << s;
    }
    for (int k = 0; k < count; ++k) {
      if (masks[std::size_t(k)] == 0) continue;
      for (int s = 0; s < samples; ++s) {
        if (masks[std::size_t(k)] >> s & 1) owner[std::size_t(s)] = int(tile.fragments.list.Size());
      }
      tile.fragments.list.Push(std::uint16_t(p), k, std::uint8_t(masks[std::size_t(k)]));
    }
    tile.owner.push_back(owner);
  }
  tile.fragments.Resize();
  for (auto* v : {&tile.fragments.red, &tile.fragments.green, &tile.fragments.blue, &tile.fragments.alpha}) {
    for (float& value : *v) value = float(random() >> 8) / 16777216.0f;
  }
  return tile;
}

TEST(ResolveOpaque, IsTheMeanOverSamples) {
  for (int samples : {1, 2, 4, 8}) {
    const Tile tile = RandomTile(16, samples, unsigned(samples));
    TilePixels pixels(3, glm::vec4(9.0f));
    ResolveOpaque(tile.buffers, tile.fragments, pixels);
    ASSERT_EQ(pixels.size(), 256u);
    for (std::size_t p = 0; p < 256; ++p) {
      glm::dvec4 mean(0.0);
      for (int k : tile.owner[p]) {
        // The alpha of an opaque fragment counts for nothing.
        if (k < 0) continue;
        const std::size_t i = std::size_t(k);
        mean += glm::dvec4(tile.fragments.red[i], tile.fragments.green[i], tile.fragments.blue[i], 1.0);
      }
      mean /= double(samples);
      for (int c = 0; c < 4; ++c) ASSERT_NEAR(pixels[p][c], mean[c], 1e-6 * (1.0 + mean[c])) << samples << " " << p;
    }
  }
}

TEST(ResolveOpaque, OneFragmentThatCoversAllIsExact) {
  for (int samples : {1, 2, 4, 8}) {
    Tile tile = RandomTile(8, samples, 5);
    tile.fragments.list.Clear();
    tile.fragments.list.Push(9, 0, std::uint8_t((1u << samples) - 1));
    tile.fragments.Resize();
    tile.fragments.red[0] = 0.1f, tile.fragments.green[0] = 3e30f, tile.fragments.blue[0] = 1e-40f;
    TilePixels pixels;
    ResolveOpaque(tile.buffers, tile.fragments, pixels);
    EXPECT_EQ(pixels[9], glm::vec4(0.1f, 3e30f, 1e-40f, 1.0f));
    EXPECT_EQ(pixels[8], glm::vec4(0.0f));
  }
}

}  // namespace
}  // namespace facet
