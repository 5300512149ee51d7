// What the tests of the geometry stages and of the rasteriser share: random numbers, snapped triangles, and coverage by
// brute force, written without a look at the rasteriser's edge functions.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <sstream>
#include <string>
#include <vector>

#include "facet/shader/dispatch.h"
#include "frame/geometry.h"
#include "frame/tile.h"
#include "frame/tile_grid.h"
#include "raster/raster_tile.h"

namespace facet::test {

// splitmix64 (Steele, Lea, Flood 2014): the same numbers with every library.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  std::uint64_t Next() {
    std::uint64_t z = state_ += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }
  // Both ends included.
  int Int(int low, int high) {
    return low + static_cast<int>(Next() % static_cast<std::uint64_t>(std::int64_t{high} - low + 1));
  }
  double Real(double low, double high) { return low + (high - low) * static_cast<double>(Next() >> 11) * 0x1p-53; }

 private:
  std::uint64_t state_;
};

struct PointFx8 {
  std::int32_t x, y;
};

inline std::int64_t DoubleArea(PointFx8 a, PointFx8 b, PointFx8 c) {
  return (std::int64_t{b.x} - a.x) * (std::int64_t{c.y} - a.y) - (std::int64_t{c.x} - a.x) * (std::int64_t{b.y} - a.y);
}

// A record with a depth plane through the three depths. The area must not be 0; the vertices are put in order.
inline ScreenTriangle MakeScreenTriangle(PointFx8 a, PointFx8 b, PointFx8 c, float za = 1.0f, float zb = 1.0f,
                                         float zc = 1.0f) {
  if (DoubleArea(a, b, c) < 0) std::swap(b, c), std::swap(zb, zc);
  const double scale = 256.0 / static_cast<double>(DoubleArea(a, b, c));
  const double x1 = b.x - a.x, y1 = b.y - a.y, x2 = c.x - a.x, y2 = c.y - a.y;
  const double z1 = double{zb} - za, z2 = double{zc} - za;
  ScreenTriangle r{};
  r.x_fx8[0] = a.x, r.x_fx8[1] = b.x, r.x_fx8[2] = c.x;
  r.y_fx8[0] = a.y, r.y_fx8[1] = b.y, r.y_fx8[2] = c.y;
  r.depth_0 = za;
  r.depth_dx = (z1 * y2 - z2 * y1) * scale;
  r.depth_dy = (z2 * x1 - z1 * x2) * scale;
  r.depth_min = std::min({za, zb, zc});
  r.depth_max = std::max({za, zb, zc});
  r.kind = ScreenTriangleKind::Triangle;
  return r;
}

// Where sample s of pixel (x, y) stands.
inline PointFx8 SampleAt(int x, int y, int samples, int s) {
  const SamplePosition p = SamplePattern(samples)[s];
  return {x * 256 + p.x * 16, y * 256 + p.y * 16};
}

// Whether the triangle covers the point. The top-left rule as a displacement: the point is moved to the right by an
// infinitesimal amount and down by an infinitely smaller one; then it lies on no edge, and on the inner side of left
// and of top edges that it lay on.
inline bool CoversExactly(const ScreenTriangle& r, PointFx8 p) {
  const PointFx8 v[3] = {{r.x_fx8[0], r.y_fx8[0]}, {r.x_fx8[1], r.y_fx8[1]}, {r.x_fx8[2], r.y_fx8[2]}};
  const std::int64_t orientation = DoubleArea(v[0], v[1], v[2]);
  for (int i = 0; i < 3; ++i) {
    const PointFx8 from = v[i], to = v[(i + 1) % 3];
    std::int64_t side = DoubleArea(from, to, p);
    if (side == 0) side = from.y - to.y;  // the derivative of `side` by p.x ...
    if (side == 0) side = to.x - from.x;  // ... and by p.y
    if ((side > 0) != (orientation > 0)) return false;
  }
  return true;
}

inline std::vector<Target> AvailableTargets() {
  std::vector<Target> targets;
  for (const Target t : {Target::Scalar, Target::Sse4, Target::Avx2, Target::Avx3, Target::Neon}) {
    if (TargetIsAvailable(t)) targets.push_back(t);
  }
  return targets;
}

inline constexpr int kSampleCounts[] = {1, 2, 4, 8};
inline constexpr int kTileSizes[] = {8, 16, 32, 64};

inline TileBuffers MakeTile(const TileGrid& grid, int column, int row, int samples) {
  TileBuffers tile;
  tile.x0 = column * grid.tile_size, tile.y0 = row * grid.tile_size;
  tile.width = std::min(grid.tile_size, grid.width - tile.x0);
  tile.height = std::min(grid.tile_size, grid.height - tile.y0);
  tile.tile_size = grid.tile_size, tile.samples = samples;
  ClearTile(tile);
  return tile;
}

// Records in the form that the rasteriser takes, numbered from 0.
struct Submission {
  std::vector<const ScreenTriangle*> pointers;
  std::vector<std::int32_t> ids;

  explicit Submission(const std::vector<ScreenTriangle>& records) {
    for (const ScreenTriangle& r : records) {
      pointers.push_back(&r);
      ids.push_back(static_cast<std::int32_t>(ids.size()));
    }
  }
  TileTriangles All() const { return {pointers.data(), ids.data(), pointers.size()}; }
  TileTriangles One(std::size_t i) const { return {pointers.data() + i, ids.data() + i, 1}; }
};

// How often each sample of an image is covered; index (y * width + x) * samples + s.
struct CoverageCount {
  int width, height, samples;
  std::vector<int> count;

  CoverageCount(int w, int h, int n)
      : width(w), height(h), samples(n), count(std::size_t(w) * std::size_t(h) * std::size_t(n)) {}
  int& At(int x, int y, int s) { return count[std::size_t((y * width + x) * samples + s)]; }
  int Total() const {
    int sum = 0;
    for (const int c : count) sum += c;
    return sum;
  }
};

// By RasterCollect over empty tiles. With `turned`, back-facing records count -1.
inline CoverageCount CountCoverage(const std::vector<ScreenTriangle>& records, int width, int height, int tile_size,
                                   int samples, bool turned = false) {
  CoverageCount out(width, height, samples);
  const Submission submission(records);
  const TileGrid grid = MakeTileGrid(width, height, tile_size);
  FragmentList fragments;
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      const TileBuffers tile = MakeTile(grid, column, row, samples);
      fragments.Clear();
      RasterCollect(submission.All(), tile, fragments);
      for (std::size_t i = 0; i < fragments.Size(); ++i) {
        const int x = tile.x0 + fragments.pixel[i] % tile_size, y = tile.y0 + fragments.pixel[i] / tile_size;
        const bool back = records[std::size_t(fragments.record[i])].back_facing;
        for (int s = 0; s < samples; ++s) {
          if ((fragments.samples[i] >> s & 1) != 0) out.At(x, y, s) += turned && back ? -1 : 1;
        }
      }
    }
  }
  return out;
}

// Empty if `expected(x, y, s)` is the count of every sample (-1: any count will do); else the first that differs.
template <class Expected>
std::string Differences(CoverageCount& got, const Expected& expected) {
  std::ostringstream text;
  int wrong = 0;
  for (int y = 0; y < got.height; ++y) {
    for (int x = 0; x < got.width; ++x) {
      for (int s = 0; s < got.samples; ++s) {
        const int want = expected(x, y, s);
        if (want < 0 || want == got.At(x, y, s)) continue;
        if (wrong++ == 0) {
          text << "pixel (" << x << ", " << y << ") sample " << s << " is covered " << got.At(x, y, s) << " times, not "
               << want;
        }
      }
    }
  }
  if (wrong > 1) text << "; " << wrong << " samples differ";
  return text.str();
}

// A triangulation of a rectangle by exact integers: points may be put anywhere, on edges too, and edges be turned, and
// no triangle is ever empty or turned over.
class Triangulation {
 public:
  std::vector<PointFx8> points;
  std::vector<std::array<int, 3>> triangles;

  Triangulation(PointFx8 low, PointFx8 high)
      : points{{low.x, low.y}, {high.x, low.y}, {high.x, high.y}, {low.x, high.y}}, triangles{{0, 1, 2}, {0, 2, 3}} {}

  bool Insert(PointFx8 p) {
    const int q = static_cast<int>(points.size());
    std::vector<std::array<int, 3>> made;
    std::vector<std::size_t> gone;
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      const auto [a, b, c] = triangles[t];
      const int edges[3][2] = {{a, b}, {b, c}, {c, a}};
      int zeros = 0;
      bool outside = false;
      for (const auto& e : edges) {
        const std::int64_t area = DoubleArea(points[std::size_t(e[0])], points[std::size_t(e[1])], p);
        outside = outside || area < 0;
        zeros += area == 0;
      }
      if (outside) continue;
      if (zeros == 2) return false;  // there is a vertex already
      gone.push_back(t);
      for (const auto& e : edges) {
        if (DoubleArea(points[std::size_t(e[0])], points[std::size_t(e[1])], p) > 0) made.push_back({e[0], e[1], q});
      }
    }
    for (std::size_t i = gone.size(); i-- > 0;) triangles.erase(triangles.begin() + std::ptrdiff_t(gone[i]));
    if (gone.empty()) return false;
    points.push_back(p);
    triangles.insert(triangles.end(), made.begin(), made.end());
    return true;
  }

  // Turns one random edge within its two triangles where they make a convex quadrilateral.
  void Flip(Random& random) {
    const std::size_t t = random.Next() % triangles.size();
    const int k = random.Int(0, 2);
    const int a = triangles[t][std::size_t(k)], b = triangles[t][std::size_t((k + 1) % 3)],
              c = triangles[t][std::size_t((k + 2) % 3)];
    for (std::size_t u = 0; u < triangles.size(); ++u) {
      for (std::size_t j = 0; j < 3; ++j) {
        if (triangles[u][j] != b || triangles[u][(j + 1) % 3] != a) continue;
        const int d = triangles[u][(j + 2) % 3];
        const auto at = [&](int i) { return points[std::size_t(i)]; };
        if (DoubleArea(at(a), at(d), at(c)) <= 0 || DoubleArea(at(d), at(b), at(c)) <= 0) return;
        triangles[t] = {a, d, c};
        triangles[u] = {d, b, c};
        return;
      }
    }
  }

  std::vector<ScreenTriangle> Records() const {
    std::vector<ScreenTriangle> records;
    for (const auto& t : triangles) {
      records.push_back(
          MakeScreenTriangle(points[std::size_t(t[0])], points[std::size_t(t[1])], points[std::size_t(t[2])]));
    }
    return records;
  }
};

}  // namespace facet::test
