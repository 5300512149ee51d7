#include "bin/bin_triangles.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <numeric>

#include "base/memory_budget.h"
#include "facet/error.h"
#include "frame/constants.h"

namespace facet {
namespace {

struct TileRange {
  int x0, y0, x1, y1;  // inclusive; empty if x1 < x0 or y1 < y0
};

// Whether the triangle lies in one tile: its vertices' coordinates differ only in the bits below the tile's index.
bool InOneTile(int tile_bits_fx8, const ScreenTriangle& r) {
  const std::int32_t x = (r.x_fx8[0] ^ r.x_fx8[1]) | (r.x_fx8[0] ^ r.x_fx8[2]);
  const std::int32_t y = (r.y_fx8[0] ^ r.y_fx8[1]) | (r.y_fx8[0] ^ r.y_fx8[2]);
  return (x | y) >> tile_bits_fx8 == 0;
}

TileRange TilesOf(const TileGrid& grid, int tile_bits_fx8, const ScreenTriangle& r) {
  return {std::max(LeastOf(r.x_fx8) >> tile_bits_fx8, 0), std::max(LeastOf(r.y_fx8) >> tile_bits_fx8, 0),
          std::min(GreatestOf(r.x_fx8) >> tile_bits_fx8, grid.columns - 1),
          std::min(GreatestOf(r.y_fx8) >> tile_bits_fx8, grid.rows - 1)};
}

// False if the whole tile lies outside of one edge. Conservative, as it tests the tile's corners.
bool MayTouch(const TileGrid& grid, const ScreenTriangle& r, int tile_x, int tile_y) {
  const std::int64_t size = std::int64_t{grid.tile_size} * kSubpixelScale;
  const std::int64_t left = tile_x * size, top = tile_y * size;
  for (int i = 0; i < 3; ++i) {
    const int j = i == 2 ? 0 : i + 1;
    const std::int64_t a = r.y_fx8[i] - r.y_fx8[j], b = r.x_fx8[j] - r.x_fx8[i];
    const std::int64_t x = a > 0 ? left + size : left, y = b > 0 ? top + size : top;  // the corner furthest inside
    if (a * (x - r.x_fx8[i]) + b * (y - r.y_fx8[i]) < 0) return false;
  }
  return true;
}

struct Entry {
  std::uint32_t tile, record;
};

// Sorts by tile with a stable radix sort, whose digits have as many bits as suit the number of entries, in linear time.
// `scratch` has the same size.
void SortByTile(std::vector<Entry>& entries, std::vector<Entry>& scratch) {
  if (entries.empty()) return;
  const auto by_tile = [](const Entry& a, const Entry& b) { return a.tile < b.tile; };
  const auto [low, high] = std::minmax_element(entries.begin(), entries.end(), by_tile);
  const std::uint32_t first = low->tile;
  const int bits = static_cast<int>(std::bit_width(high->tile - first));
  const int digit_bits = std::min(static_cast<int>(std::bit_width(entries.size())), 11);
  std::uint32_t place[1 << 11];
  for (int shift = 0; shift < bits; shift += digit_bits) {
    const std::uint32_t digits = 1u << digit_bits;
    const auto digit = [&](const Entry& e) { return (e.tile - first) >> shift & (digits - 1); };
    std::fill(place, place + digits, 0u);
    for (const Entry& e : entries) ++place[digit(e)];
    std::exclusive_scan(place, place + digits, place, 0u);
    for (const Entry& e : entries) scratch[place[digit(e)]++] = e;
    entries.swap(scratch);
  }
}

// Charges the memory of a chunk's entries while they are listed and sorted. The amount that nearly every chunk needs is
// not charged, to save time.
class EntryCharge {
 public:
  void Admit(std::size_t entries) {
    if (entries <= admitted_) return;
    const std::size_t more = std::max(entries, 2 * admitted_) - admitted_;
    // A growing vector has two copies for a moment, and sorting needs another.
    leases_.emplace_back(more, 3 * sizeof(Entry), kTileListsCharge, "", "use larger tiles");
    admitted_ += more;
  }

 private:
  std::size_t admitted_ = std::size_t{1} << 16;
  std::vector<MemoryLease> leases_;
};

}  // namespace

void BinChunk(const TileGrid& grid, TriangleChunk& chunk) {
  const int tile_bits_fx8 = std::countr_zero(static_cast<unsigned>(grid.tile_size)) + kSubpixelBits;
  std::vector<Entry> entries;
  EntryCharge charge;
  entries.reserve(chunk.records.size() + chunk.records.size() / 4);
  for (std::uint32_t i = 0; i < chunk.records.size(); ++i) {
    const ScreenTriangle& r = chunk.records[i];
    if (InOneTile(tile_bits_fx8, r)) {
      const int x = r.x_fx8[0] >> tile_bits_fx8, y = r.y_fx8[0] >> tile_bits_fx8;
      if (x >= 0 && y >= 0 && x < grid.columns && y < grid.rows) {
        entries.push_back({static_cast<std::uint32_t>(y * grid.columns + x), i});
      }
      continue;
    }
    const TileRange range = TilesOf(grid, tile_bits_fx8, r);
    const bool test = range.x1 - range.x0 + range.y1 - range.y0 >= 2;
    if (range.x1 >= range.x0 && range.y1 >= range.y0) {
      charge.Admit(entries.size() + std::size_t(range.x1 - range.x0 + 1) * std::size_t(range.y1 - range.y0 + 1));
    }
    for (int y = range.y0; y <= range.y1; ++y) {
      for (int x = range.x0; x <= range.x1; ++x) {
        if (!test || MayTouch(grid, r, x, y)) entries.push_back({static_cast<std::uint32_t>(y * grid.columns + x), i});
      }
    }
    if (entries.size() > std::numeric_limits<std::uint32_t>::max()) {  // the index type; 32 GiB of them
      throw Error(ErrorCode::OutOfMemory, "the triangles of the scene touch too many tiles", {},
                  "use larger tiles, or render a smaller picture");
    }
  }
  std::vector<Entry> scratch(entries.size());
  SortByTile(entries, scratch);
  chunk.tiles.clear();
  chunk.begin.clear();
  chunk.entries.resize(entries.size());
  // With scattered records, tiles would spend more time waiting for memory than computing.
  constexpr std::uint32_t kNowhere = ~0u;
  std::vector<std::uint32_t> place(chunk.records.size(), kNowhere);
  std::vector<ScreenTriangle> ordered;
  ordered.reserve(chunk.records.size());
  const ScreenTriangle* records = chunk.records.data();
  std::uint32_t count = 0;  // the size of `ordered`, since size() needs a division
  const auto put = [&](std::uint32_t record) {
    std::uint32_t& at = place[record];
    if (at == kNowhere) at = count++, ordered.push_back(records[record]);
    return at;
  };
  std::uint32_t last_tile = kNowhere;
  for (std::uint32_t i = 0; i < entries.size(); ++i) {
    const Entry e = entries[i];
    if (e.tile != last_tile) {
      last_tile = e.tile;
      chunk.tiles.push_back(e.tile);
      chunk.begin.push_back(i);
    }
    chunk.entries[i] = put(e.record);
  }
  for (std::uint32_t i = 0; count < place.size(); ++i) put(i);  // records that touch no tile come last
  chunk.records.swap(ordered);
  chunk.begin.push_back(static_cast<std::uint32_t>(entries.size()));
  MemoryBudget::Current().Charge(
      chunk.records.size() * sizeof(ScreenTriangle) +
          (chunk.entries.size() + chunk.tiles.size() + chunk.begin.size()) * sizeof(std::uint32_t),
      1, kTileListsCharge);
}

}  // namespace facet
