// Fragments by pixel.
#pragma once

#include <cstdint>
#include <vector>

#include "frame/tile.h"

namespace facet {

// Those of pixel p are order[first[p]] to order[first[p + 1] - 1], in the order of their list.
struct FragmentsByPixel {
  std::vector<std::uint32_t> first, next, order;
  void Fill(const FragmentList& list, std::size_t pixel_count);
};

// A fragment at one sample.
struct Layer {
  float depth;
  std::uint32_t fragment;
};

// From back to front. Indices of fragments follow submission order, so the order is that of a stable sort, without its
// memory.
inline constexpr auto IsBehind = [](const Layer& a, const Layer& b) {
  return a.depth != b.depth ? a.depth < b.depth : a.fragment < b.fragment;
};

}  // namespace facet
