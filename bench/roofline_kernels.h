// The parts of a frame that no renderer can do without, each by itself; see roofline.cc.
#pragma once

#include <cstddef>
#include <cstdint>

namespace facet {

// Mean number of operations of one fragment. simple: what a processor starts several of in each cycle.
struct OperationCounts {
  double simple = 0.0, divisions = 0.0, roots = 0.0;
};

// Reads the 2 x 2 texels of each tap, 16 bytes a texel, in squares of 4 x 4, which touch the fewest cache lines. A tap
// is the number of its upper left texel, with the mip level in the upper five bits; `pitch`: squares in a row of each
// level.
inline constexpr int kTapLevelShift = 27;
std::int64_t ReadTaps(const std::uint32_t* taps, std::size_t count, const std::int32_t* texels,
                      const std::int32_t* pitch);

// Reads `reads` times 16 bytes for each of `count` fragments, from a table of 2^bits such entries, each fragment near
// the last one: maps and tables that stay in the cache.
std::int64_t ReadTable(const std::int32_t* table, int bits, std::size_t count, int reads);

// Reads 2 x 2 pixels of 16 bytes for each of `count` pixels that walk along the rows of an image, `width` pixels wide
// and enlarged `scale` times.
std::int64_t ReadImage(const std::int32_t* image, std::size_t pixels, std::size_t width, std::size_t count,
                       float scale);

// That many operations for each of `fragments`, a lane each, none waiting for another.
float Compute(const OperationCounts& of_each, std::size_t fragments);

// 16 bytes a pixel.
void WritePixels(float* film, std::size_t pixels);

}  // namespace facet
