#include "blend/backdrop.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include "base/parallel.h"

namespace facet {
namespace {

constexpr float kNothing = -std::numeric_limits<float>::infinity();
constexpr int kRowsATask = 16;
// How many levels finer the parts of a texel are that are looked at where the whole is too near.
constexpr int kFinerLevels = 2;

// The standard deviation of a cubic B-spline over texels that are themselves means: sqrt(1/3 + 1/12) texels.
constexpr float kSplineDeviation = 0.645497f;

// The share of a texel at `place` of a level that lies inside of the picture, along one axis of `size` pixels: the last
// one may stick out.
float ShareInside(std::size_t level, int place, int size) {
  const int width = 1 << level;
  return static_cast<float>(std::min(size - (place << level), width)) / static_cast<float>(width);
}

}  // namespace

Backdrop::Backdrop(int width, int height) {
  std::size_t count = 0;
  for (int w = width, h = height;; w = (w + 1) / 2, h = (h + 1) / 2) {
    levels_.push_back({w, h, count});
    count += std::size_t(w) * std::size_t(h);
    if (w == 1 && h == 1) break;
  }
  lease_ = MemoryLease(count, sizeof(Texel), "the picture behind surfaces with transmission", "",
                       "make the picture smaller, or render without transmission");
  texels_.resize(count);
}

void Backdrop::SetTile(const TileBuffers& at, bool is_empty, const std::vector<glm::vec4>& pixels) {
  const float share = 1.0f / static_cast<float>(at.samples);
  for (int y = 0; y < at.height; ++y) {
    Texel* out = texels_.data() + std::size_t(at.y0 + y) * std::size_t(levels_[0].width) + at.x0;
    for (int x = 0; x < at.width; ++x) {
      Texel texel{glm::vec4(0.0f), kNothing, 0.0f};
      if (!is_empty) {
        texel.light = pixels[std::size_t(y * at.tile_size + x)];
        for (int s = 0; s < at.samples; ++s) {
          const float depth = at.depth[at.Index(x, y, s)];
          texel.nearest = std::max(texel.nearest, depth);
          if (depth > kNothing) texel.depth += depth * share;
        }
      }
      out[x] = texel;
    }
  }
}

void Backdrop::GetTile(const TileBuffers& at, std::vector<glm::vec4>& pixels) const {
  pixels.assign(std::size_t(at.tile_size) * std::size_t(at.tile_size), glm::vec4(0.0f));
  for (int y = 0; y < at.height; ++y) {
    const Texel* texels = texels_.data() + std::size_t(at.y0 + y) * std::size_t(levels_[0].width) + at.x0;
    for (int x = 0; x < at.width; ++x) pixels[std::size_t(y * at.tile_size + x)] = texels[x].light;
  }
}

float Backdrop::AreaInside(std::size_t level, int column, int row) const {
  return ShareInside(level, column, levels_[0].width) * ShareInside(level, row, levels_[0].height);
}

template <class Visit>
void Backdrop::ForEachPart(std::size_t level, int column, int row, const Visit& visit) const {
  const Level& parts = levels_[level - 1];
  const int right = std::min(2 * column + 2, parts.width), bottom = std::min(2 * row + 2, parts.height);
  float area = 0.0f;
  for (int j = 2 * row; j < bottom; ++j) {
    for (int i = 2 * column; i < right; ++i) area += AreaInside(level - 1, i, j);
  }
  for (int j = 2 * row; j < bottom; ++j) {
    for (int i = 2 * column; i < right; ++i) visit(i, j, AreaInside(level - 1, i, j) / area);
  }
}

void Backdrop::Finish() {
  for (std::size_t l = 1; l < levels_.size(); ++l) {
    const Level from = levels_[l - 1], to = levels_[l];
    ParallelFor(std::size_t(to.height), kRowsATask, [&](std::size_t begin, std::size_t end) {
      for (std::size_t y = begin; y < end; ++y) {
        for (int x = 0; x < to.width; ++x) {
          Texel sum{glm::vec4(0.0f), kNothing, 0.0f};
          ForEachPart(l, x, int(y), [&](int column, int row, float share) {
            const Texel& t = texels_[from.offset + std::size_t(row) * std::size_t(from.width) + std::size_t(column)];
            sum.light += t.light * share;
            sum.depth += t.depth * share;
            sum.nearest = std::max(sum.nearest, t.nearest);
          });
          texels_[to.offset + y * std::size_t(to.width) + std::size_t(x)] = sum;
        }
      }
    });
  }
}

void Backdrop::AddTexel(std::size_t level, int column, int row, float weight, float nearest, int finer,
                        Mean& sum) const {
  const Level& at = levels_[level];
  const Texel& texel = texels_[at.offset + std::size_t(row) * std::size_t(at.width) + std::size_t(column)];
  if (!(texel.nearest > nearest)) {
    sum.accepted += weight;
    sum.light += texel.light * weight;
    sum.depth += texel.depth * weight;
    return;
  }
  if (level == 0 || finer == 0) return;
  ForEachPart(level, column, row,
              [&](int i, int j, float part) { AddTexel(level - 1, i, j, weight * part, nearest, finer - 1, sum); });
}

void Backdrop::AddWeighted(std::size_t level, int column, int row, int count, const float* weights_x,
                           const float* weights_y, float nearest, float share, Mean& sum) const {
  const Level& at = levels_[level];
  for (int j = 0; j < count; ++j) {
    if (row + j < 0 || row + j >= at.height) continue;
    for (int i = 0; i < count; ++i) {
      if (column + i < 0 || column + i >= at.width) continue;
      const float weight = weights_x[i] * weights_y[j] * share * AreaInside(level, column + i, row + j);
      sum.inside += weight;
      AddTexel(level, column + i, row + j, weight, nearest, kFinerLevels, sum);
    }
  }
}

void Backdrop::AddLinear(float x, float y, float nearest, float share, Mean& sum) const {
  const float u = x - 0.5f, v = y - 0.5f, left = std::floor(u), top = std::floor(v);
  const float weights_x[2] = {1.0f - (u - left), u - left}, weights_y[2] = {1.0f - (v - top), v - top};
  AddWeighted(0, static_cast<int>(left), static_cast<int>(top), 2, weights_x, weights_y, nearest, share, sum);
}

void Backdrop::AddSpline(std::size_t level, float x, float y, float nearest, float share, Mean& sum) const {
  const float scale = 1.0f / static_cast<float>(std::uint32_t{1} << level);
  const float u = x * scale - 0.5f, v = y * scale - 0.5f, left = std::floor(u), top = std::floor(v);
  float weights[2][4];
  for (int axis = 0; axis < 2; ++axis) {
    const float t = axis == 0 ? u - left : v - top, r = 1.0f - t, sixth = 1.0f / 6.0f;
    weights[axis][0] = r * r * r * sixth;
    weights[axis][1] = (t * t * (3.0f * t - 6.0f) + 4.0f) * sixth;
    weights[axis][2] = (r * r * (3.0f * r - 6.0f) + 4.0f) * sixth;
    weights[axis][3] = t * t * t * sixth;
  }
  AddWeighted(level, static_cast<int>(left) - 1, static_cast<int>(top) - 1, 4, weights[0], weights[1], nearest, share,
              sum);
}

Backdrop::Mean Backdrop::Around(float x, float y, float deviation, float nearest) const {
  Mean sum;
  const float texel = deviation / kSplineDeviation;  // the size of a texel whose spline has this deviation
  if (texel < 1.0f) {
    const float spline = texel * texel;
    AddLinear(x, y, nearest, 1.0f - spline, sum);
    if (spline > 0.0f) AddSpline(0, x, y, nearest, spline, sum);
  } else {
    // The logarithm, but linear between powers of two.
    const float bounded = std::min(texel, 0x1p20f);
    const std::uint32_t bits = std::bit_cast<std::uint32_t>(bounded);
    const std::size_t level = (bits >> 23) - 127, last = levels_.size() - 1;
    const float next = std::bit_cast<float>((bits & 0x7fffffu) | 0x3f800000u) - 1.0f;
    if (level >= last) {
      AddSpline(last, x, y, nearest, 1.0f, sum);
    } else {
      AddSpline(level, x, y, nearest, 1.0f - next, sum);
      if (next > 0.0f) AddSpline(level + 1, x, y, nearest, next, sum);
    }
  }
  // A mean over less than this has more rounding error than light.
  constexpr float kLeastInside = 1e-6f, kLeastAccepted = 1e-3f;
  if (!(sum.inside > kLeastInside)) return {};
  if (sum.accepted <= kLeastAccepted * sum.inside) {
    Mean none;
    none.inside = sum.inside;
    return none;
  }
  sum.light /= sum.accepted, sum.depth /= sum.accepted;
  return sum;
}

}  // namespace facet
