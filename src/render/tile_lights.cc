#include "render/tile_lights.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <glm/glm.hpp>
#include <limits>

#include "light/cull_lights.h"
#include "render/frame_view.h"
#include "scene/topology.h"

namespace facet {
namespace {

// In pixels. A fragment lies within the snapped triangle, whose corners have moved by at most kOff. Its attributes,
// hence the position at which it is lit, are those of the unsnapped triangle, clamped to its edges. That moves the
// position, and lines and points are wider than the positions at which they are lit: by less than kBorder in all.
constexpr double kOff = 1.0 / 64.0;
constexpr double kBorder = 2.0;
// The error of a sum of three floats, relative to the largest of them.
constexpr double kRounding = 0x1p-21;

// Whether a triangle is so thin that its fragments may be lit anywhere along it, because its area comes from snapping
// or its weights are clamped. (In a triangle at least 1/128 as high as it is long, an error of kOff moves a position by
// at most 128 kOff along an edge.)
bool IsSliver(const ScreenTriangle& r) {
  if (r.kind != ScreenTriangleKind::Triangle) return false;
  std::int64_t longest2 = 0, area2 = 0;
  for (int i = 0, j = 2; i < 3; j = i++) {
    const std::int64_t x = std::int64_t(r.x_fx8[i]) - r.x_fx8[j], y = std::int64_t(r.y_fx8[i]) - r.y_fx8[j];
    longest2 = std::max(longest2, x * x + y * y);
    area2 += std::int64_t(r.x_fx8[j]) * r.y_fx8[i] - std::int64_t(r.x_fx8[i]) * r.y_fx8[j];
  }
  return std::abs(area2) < longest2 / 128;
}
static_assert(128 * kOff <= kBorder);

double LengthXy(const glm::dvec3& v) { return glm::length(glm::dvec2(v)); }

// A bounding box of the positions at which the fragments of a tile are lit.
// For perspective views. The box is conservative: a light that does not reach it contributes exactly nothing to any of
// the fragments.
class LitBox {
 public:
  LitBox(const FrameView& view, const TileBuffers& tile) : view_(view), tile_(tile) {}

  // Extends the box by the fragments that a triangle has in the tile. False: they have no bound.
  bool Add(const ScreenTriangle& record, const FrameDrawable& drawable);

  // Relative to the eye, world axes; after the first Add().
  void Corners(glm::dvec3& low, glm::dvec3& high) const;

 private:
  bool AddPiece(const ScreenTriangle& record, const FrameDrawable& drawable);
  void AddDepths(double farthest, double nearest);

  const FrameView& view_;
  const TileBuffers& tile_;
  double nearest_ = 0.0, farthest_ = std::numeric_limits<double>::infinity();  // depth: 1 / distance
  double size_ = 0.0;  // how far from the eye corners of clipped triangles lie
};

bool LitBox::Add(const ScreenTriangle& record, const FrameDrawable& drawable) {
  if (record.clipped) return AddPiece(record, drawable);
  AddDepths(double(record.depth_min), double(record.depth_max));
  return !IsSliver(record);
}

void LitBox::AddDepths(double farthest, double nearest) {
  nearest_ = std::max(nearest_, nearest);
  farthest_ = std::min(farthest_, farthest);
}

// A piece's fragments lie on the whole triangle's plane, and where that is seen at a low angle, 1/256 of a pixel beyond
// a cut can be any distance beyond it. (x, y, 1) of a pixel is the sum of e[k] h[k] over the true corners, in
// homogeneous screen space; with e[k] off by d, a fragment is lit as if it lay d |h[k].xy - h[k].z (x, y)| elsewhere.
bool LitBox::AddPiece(const ScreenTriangle& record, const FrameDrawable& drawable) {
  const std::array<std::uint32_t, 3> vertex = PrimitiveVertices(*drawable.geometry, record.primitive);
  const int corners = record.kind == ScreenTriangleKind::Line ? 2 : 3;
  const double radius = 0.5 * glm::length(glm::dvec2(tile_.width, tile_.height));  // the origin is the tile's centre
  const double center_x = tile_.x0 + 0.5 * tile_.width, center_y = tile_.y0 + 0.5 * tile_.height;
  glm::dvec3 h[3];
  double least_distance = std::numeric_limits<double>::infinity(), most_distance = 0.0;
  for (int i = 0; i < corners; ++i) {
    const glm::dvec4 p(glm::dvec3(drawable.geometry->positions[vertex[std::size_t(i)]]), 1.0);
    const glm::dmat3x4& eye = drawable.eye_relative_from_mesh;
    size_ = std::max(size_, glm::length(glm::dvec3(glm::dot(eye[0], p), glm::dot(eye[1], p), glm::dot(eye[2], p))));
    const double distance = glm::dot(drawable.screen_from_mesh[2], p);
    h[i] = {glm::dot(drawable.screen_from_mesh[0], p) - center_x * distance,
            glm::dot(drawable.screen_from_mesh[1], p) - center_y * distance, distance};
    least_distance = std::min(least_distance, distance);
    most_distance = std::max(most_distance, distance);
  }
  if (corners == 2) {  // as its interpolation has it: the third stands for the line's width
    const glm::dvec3 line = glm::cross(h[0], h[1]);
    h[2] = {line.x, line.y, 0.0};
  }
  glm::dvec3 row[3] = {glm::cross(h[1], h[2]), glm::cross(h[2], h[0]), glm::cross(h[0], h[1])};
  double determinant = glm::dot(row[0], h[0]);
  if (corners == 2) row[2] = glm::dvec3(0.0);
  double largest = 0.0;  // that the floats of the interpolation reach, whose origin lies within 64 pixels
  for (glm::dvec3& r : row) {
    if (determinant < 0.0) r = -r;
    largest = std::max(largest, std::fabs(r.z) + 128.0 * (std::fabs(r.x) + std::fabs(r.y)));
  }
  determinant = std::fabs(determinant);

  double moved = 0.0, lost = 0.0;
  for (int k = 0; k < corners; ++k) {
    const bool inside = row[k].z > (radius + kOff) * LengthXy(row[k]);  // of that edge, the whole tile
    const double off = ((inside ? 0.0 : kOff) * LengthXy(row[k]) + kRounding * largest) / determinant;
    moved += off * (LengthXy(h[k]) + std::fabs(h[k].z) * radius);
    lost += off * std::fabs(h[k].z);
  }
  moved *= 2.0;  // divided by what the weights still sum to
  if (!(lost <= 0.5 && moved <= kBorder)) return false;

  const glm::dvec3 depth = (row[0] + row[1] + row[2]) / determinant;  // over the screen
  const double margin = (std::fabs(depth.x) + std::fabs(depth.y)) * (kOff + moved);
  const double nearest = double(record.depth_max) + margin;
  AddDepths(std::max(double(record.depth_min) - margin, 1.0 / most_distance),
            least_distance > 0.0 ? std::min(nearest, 1.0 / least_distance) : nearest);
  return true;
}

void LitBox::Corners(glm::dvec3& low, glm::dvec3& high) const {
  low = glm::dvec3(std::numeric_limits<double>::infinity()), high = -low;
  for (const double distance : {1.0 / nearest_, 1.0 / farthest_}) {
    for (const int corner : {0, 1, 2, 3}) {
      const double x = tile_.x0 + (corner & 1 ? tile_.width + kBorder : -kBorder);
      const double y = tile_.y0 + (corner >> 1 ? tile_.height + kBorder : -kBorder);
      const glm::dvec3 p = distance * DirectionThrough(view_, x, y);
      low = glm::min(low, p), high = glm::max(high, p);
    }
  }
  // Positions are weighted sums of corners, which may lie far outside of the image.
  const glm::dvec3 guard(kGuardBand / view_.screen_x.x, kGuardBand / view_.screen_y.y, 1.0);
  const double rounding = kRounding * std::max(size_, glm::length(guard) / farthest_);
  low -= rounding, high += rounding;
}

}  // namespace

TileLights::TileLights(const FrameView& view, const LightingData& lighting, bool cull)
    : view_(view), all_(lighting), reaching_(lighting) {
  constexpr int kFew = 4;  // lights, which are evaluated in less time than culling takes
  cull_ = cull && lighting.light_count > kFew && view.perspective;
}

const LightingData& TileLights::Reaching(const TileBuffers& tile, const TileRecords& records,
                                         const FragmentList& fragments) {
  if (!cull_ || fragments.Size() == 0) return all_;
  LitBox box(view_, tile);
  std::int32_t last_id = kNoRecord;
  for (const std::int32_t id : fragments.record) {
    if (id == last_id) continue;
    last_id = id;
    if (!box.Add(records.Record(id), records.DrawableOf(id))) return all_;
  }
  glm::dvec3 low, high;
  box.Corners(low, high);
  LightsReaching(all_, low, high, lights_);
  reaching_.lights = lights_.data();
  reaching_.light_count = static_cast<int>(lights_.size());
  return reaching_;
}

}  // namespace facet
