#include "reference/spread_blocks.h"

#include <algorithm>
#include <bit>

#include "reference/sample_sequence.h"

namespace facet {

std::vector<PixelBlock> SpreadBlocks(int image_width, int image_height, std::uint64_t seed) {
  const int columns = (image_width + kBlockSide - 1) / kBlockSide;
  const int rows = (image_height + kBlockSide - 1) / kBlockSide;
  // The first side * side points lie in different cells of a square, of which those in the image are used. This favours
  // some cells if the image does not fill the square, so all are shifted by a random offset with wraparound.
  const std::uint32_t side = std::bit_ceil(std::uint32_t(std::max(columns, rows)));
  const std::uint64_t random = MixBits(MixBits(seed) ^ 0xB10C5u);
  const SampleSequence sequence(random);
  const int right = int((random >> 32) % std::uint64_t(columns)),
            down = int((random & 0xFFFFFFFFu) % std::uint64_t(rows));
  std::vector<PixelBlock> blocks;
  for (std::uint32_t i = 0; i < side * side; ++i) {
    const glm::dvec2 cell = sequence.Point(0, i) * double(side);
    if (!(cell.x < columns && cell.y < rows)) continue;
    const int x = (int(cell.x) + right) % columns * kBlockSide, y = (int(cell.y) + down) % rows * kBlockSide;
    blocks.push_back({x, y, std::min(kBlockSide, image_width - x), std::min(kBlockSide, image_height - y)});
  }
  return blocks;
}

}  // namespace facet
