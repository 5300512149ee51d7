// The order of an image's blocks: each once, and evenly spread from the first on.
#include "reference/spread_blocks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace facet {
namespace {

TEST(SpreadBlocks, CoverEveryPixelOnce) {
  for (const auto& [width, height] : {std::pair(1, 1), {16, 16}, {17, 15}, {100, 7}, {7, 100}, {128, 96}, {1000, 33}}) {
    std::vector<int> covered(std::size_t(width * height), 0);
    for (const PixelBlock& block : SpreadBlocks(width, height, 0)) {
      ASSERT_GT(block.width, 0);
      ASSERT_LE(block.width, kBlockSide);
      ASSERT_LE(block.height, kBlockSide);
      for (int y = block.y; y < block.y + block.height; ++y) {
        for (int x = block.x; x < block.x + block.width; ++x) ++covered.at(std::size_t(y * width + x));
      }
    }
    EXPECT_EQ(std::count(covered.begin(), covered.end(), 1), width * height) << width << " x " << height;
  }
}

// Of 16 x 16 blocks the first 4^k lie in as many different squares of a board that is laid somewhere over the image,
// whose opposite sides meet.
TEST(SpreadBlocks, TheFirstOnesLieAllOverTheImage) {
  constexpr int kAcross = 16;
  for (const std::uint64_t seed : {0u, 1u, 77u}) {
    const std::vector<PixelBlock> blocks = SpreadBlocks(kAcross * kBlockSide, kAcross * kBlockSide, seed);
    ASSERT_EQ(blocks.size(), std::size_t(kAcross * kAcross));
    for (const int across : {2, 4, 8}) {
      std::size_t most = 0;
      for (int shift = 0; shift < kAcross * kAcross; ++shift) {
        std::set<std::pair<int, int>> squares;
        for (std::size_t i = 0; i < std::size_t(across * across); ++i) {
          const int column = (blocks[i].x / kBlockSide + shift % kAcross) % kAcross;
          const int row = (blocks[i].y / kBlockSide + shift / kAcross) % kAcross;
          squares.emplace(column * across / kAcross, row * across / kAcross);
        }
        most = std::max(most, squares.size());
      }
      EXPECT_EQ(most, std::size_t(across * across)) << seed << " " << across;
    }
  }
}

// Otherwise a mean over the first ones would favour some part of the image, also where that is no square.
TEST(SpreadBlocks, EachIsAsLikelyAsAnyOther) {
  constexpr int kColumns = 6, kRows = 3, kSeeds = 6000;
  std::map<std::pair<int, int>, int> first, fifth;
  for (int seed = 0; seed < kSeeds; ++seed) {
    const std::vector<PixelBlock> blocks = SpreadBlocks(kColumns * kBlockSide, kRows * kBlockSide, std::uint64_t(seed));
    ++first[{blocks[0].x, blocks[0].y}];
    ++fifth[{blocks[4].x, blocks[4].y}];
  }
  constexpr double kExpected = double(kSeeds) / (kColumns * kRows);  // with a deviation of 18
  for (const auto* counts : {&first, &fifth}) {
    ASSERT_EQ(counts->size(), std::size_t(kColumns * kRows));
    for (const auto& [block, count] : *counts)
      EXPECT_NEAR(count, kExpected, 90.0) << block.first << " " << block.second;
  }
}

}  // namespace
}  // namespace facet
