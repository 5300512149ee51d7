#include "reference/geometry_exact.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "math/elementary.h"
#include "scene/topology.h"

namespace facet {
namespace {

constexpr int kTile = 16;  // pixels

bool IsFiniteVector(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

}  // namespace

ExactGeometry::ExactGeometry(const ExactView& view, const PosedScene& posed, const std::vector<bool>& double_sided)
    : view_(view), columns_((view.width + kTile - 1) / kTile) {
  const std::size_t tiles = std::size_t(columns_) * std::size_t((view.height + kTile - 1) / kTile);
  Charge(tiles * sizeof(tiles_[0]) + posed.drawables.size() * sizeof(Placed));
  tiles_.resize(tiles);
  placed_.reserve(posed.drawables.size());
  for (std::size_t d = 0; d < posed.drawables.size(); ++d) {
    const Drawable& drawable = posed.drawables[d];
    const glm::dmat3 linear(drawable.world_from_mesh);
    const double determinant = glm::determinant(linear);
    const bool mirrored = determinant < 0.0;
    // Cofactors, for singular matrices too; normals do not follow the determinant's sign.
    const glm::dmat3 cofactors(glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]),
                               glm::cross(linear[0], linear[1]));
    placed_.push_back({drawable.geometry, linear, mirrored ? -cofactors : cofactors,
                       glm::dvec3(drawable.world_from_mesh[3]) - view_.eye_world, Cbrt(std::fabs(determinant)),
                       mirrored});
    const PrimitiveClass kind = ClassOf(drawable.geometry->topology);
    const std::uint32_t count = facet::PrimitiveCount(*drawable.geometry);
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::array<std::uint32_t, 3> vertex = PrimitiveVertices(*drawable.geometry, i);
      Shape shape{};
      shape.drawable = std::uint32_t(d);
      shape.index = i;
      shape.wide = -1;
      bool is_finite = true, some_behind_near = false, all_before_far = false;
      for (std::size_t k = 0; k < 3; ++k) {
        const glm::dvec3 in_camera = view_.camera_from_world * EyeRelative(placed_.back(), vertex[k]);
        is_finite = is_finite && IsFiniteVector(in_camera);
        shape.screen[k] = view_.ScreenOf(in_camera);
        shape.distance[k] = -in_camera.z;
        some_behind_near = some_behind_near || shape.distance[k] >= view_.near_distance;
        all_before_far = all_before_far || shape.distance[k] <= view_.far_distance;
      }
      if (!is_finite || !some_behind_near || !all_before_far) continue;
      if (kind == PrimitiveClass::Triangles) AddTriangle(shape, double_sided[d]);
      if (kind == PrimitiveClass::Lines) AddLine(shape);
      if (kind == PrimitiveClass::Points) AddPoint(shape);
    }
  }
}

glm::dvec3 ExactGeometry::EyeRelative(const Placed& placed, std::uint32_t vertex) const {
  return placed.eye_relative_from_mesh * glm::dvec3(placed.geometry->positions[vertex]) + placed.origin_eye;
}

void ExactGeometry::Charge(std::size_t bytes) {
  constexpr std::size_t kAtOnce = 1 << 20;
  needed_ += 2 * bytes;  // growing vectors reserve up to twice their size
  if (needed_ <= charged_) return;
  const std::size_t more = std::max(kAtOnce, needed_ - charged_);
  held_.emplace_back(more, 1, "the reference's lists of triangles");
  charged_ += more;
}

// `low` and `high`: bounds in pixels.
void ExactGeometry::Add(Shape& shape, const glm::dvec2& low, const glm::dvec2& high) {
  constexpr double kMargin = 0.01;  // larger than rounding errors
  if (!(high.x > -kMargin && high.y > -kMargin && low.x < view_.width + kMargin && low.y < view_.height + kMargin)) {
    return;
  }
  shape.left = static_cast<float>(std::max(low.x - kMargin, -1.0));
  shape.top = static_cast<float>(std::max(low.y - kMargin, -1.0));
  shape.right = static_cast<float>(std::min(high.x + kMargin, view_.width + 1.0));
  shape.bottom = static_cast<float>(std::min(high.y + kMargin, view_.height + 1.0));
  const auto number = std::uint32_t(primitives_.size());
  const int last_column = columns_ - 1, last_row = int(tiles_.size()) / columns_ - 1;
  const auto tile = [](float pixels, int last) { return std::clamp(int(pixels) / kTile, 0, last); };
  const int first_row = tile(shape.top, last_row), end_row = tile(shape.bottom, last_row) + 1;
  const int first_column = tile(shape.left, last_column), end_column = tile(shape.right, last_column) + 1;
  const std::size_t cells = std::size_t(end_row - first_row) * std::size_t(end_column - first_column);
  Charge(sizeof(Shape) + sizeof(WideShape) + cells * sizeof(number));
  primitives_.push_back(shape);
  for (int row = first_row; row < end_row; ++row) {
    for (int column = first_column; column < end_column; ++column) {
      tiles_[std::size_t(row * columns_ + column)].push_back(number);
    }
  }
}

void ExactGeometry::AddTriangle(Shape& shape, bool double_sided) {
  const double determinant = glm::dot(shape.screen[0], glm::cross(shape.screen[1], shape.screen[2]));
  if (!(determinant < 0.0 || determinant > 0.0)) return;
  // glTF's front faces run counter-clockwise: here that is a positive determinant, on either side of the eye.
  shape.is_back = (determinant < 0.0) != placed_[shape.drawable].mirrored;
  if (shape.is_back && !double_sided) return;
  glm::dvec2 low(view_.width, view_.height), high(0.0);
  for (const glm::dvec3& s : shape.screen) {
    if (!(s.z > 0.0)) return Add(shape, glm::dvec2(0.0), glm::dvec2(view_.width, view_.height));
    const glm::dvec2 place = view_.PlaceOf(s);
    low = glm::min(low, place);
    high = glm::max(high, place);
  }
  Add(shape, low, high);
}

// The rectangle one pixel wide around the line (Vulkan 1.3 specification, "Rectangular Line Segments").
void ExactGeometry::AddLine(Shape& shape) {
  // Clip the line by the near and far planes.
  double first = 0.0, last = 1.0;
  const double from = shape.distance[0], along = shape.distance[1] - from;
  for (const auto& [bound, sign] : {std::pair(view_.near_distance, 1.0), std::pair(view_.far_distance, -1.0)}) {
    const double slope = sign * along, inside = sign * (from - bound);
    if (slope > 0.0) first = std::max(first, -inside / slope);
    if (slope < 0.0) last = std::min(last, -inside / slope);
  }
  if (!(first < last)) return;
  const auto at = [&](double t) { return shape.screen[0] + (shape.screen[1] - shape.screen[0]) * t; };
  WideShape wide{view_.PlaceOf(at(first)), view_.PlaceOf(at(last)), 0.0, 0.0, true};
  const auto depth = [&](double t) { return view_.perspective ? 1.0 / (from + along * t) : -(from + along * t); };
  wide.from_depth = depth(first);
  wide.to_depth = depth(last);
  if (!(glm::length(wide.to - wide.from) > 0.0)) return;
  // The third vertex for the interpolation is a direction across the line.
  const glm::dvec3 line = glm::cross(shape.screen[0], shape.screen[1]);
  shape.screen[2] = {line.x, line.y, 0.0};
  shape.wide = std::int32_t(wide_.size());
  wide_.push_back(wide);
  Add(shape, glm::min(wide.from, wide.to) - 0.5, glm::max(wide.from, wide.to) + 0.5);
}

// The square of one pixel around the point, if the point itself is in the image.
void ExactGeometry::AddPoint(Shape& shape) {
  if (shape.distance[0] < view_.near_distance || shape.distance[0] > view_.far_distance) return;
  const glm::dvec2 place = view_.PlaceOf(shape.screen[0]);
  if (!(place.x >= 0.0 && place.y >= 0.0 && place.x <= view_.width && place.y <= view_.height)) return;
  const double depth = view_.perspective ? 1.0 / shape.distance[0] : -shape.distance[0];
  shape.wide = std::int32_t(wide_.size());
  wide_.push_back({place, place, depth, depth, false});
  Add(shape, place - 0.5, place + 0.5);
}

void ExactGeometry::CandidatesOf(int x, int y, std::vector<std::uint32_t>& candidates) const {
  candidates.clear();
  for (const std::uint32_t i : tiles_[std::size_t(y / kTile * columns_ + x / kTile)]) {
    const Shape& s = primitives_[i];
    const auto left = static_cast<float>(x), top = static_cast<float>(y);
    if (s.right >= left && s.left <= left + 1.0f && s.bottom >= top && s.top <= top + 1.0f) candidates.push_back(i);
  }
}

// The weights are proportional to those of the inverse of the matrix of the vertices (Olano and Greer, 1997, Triangle
// Scan Conversion using 2D Homogeneous Coordinates). Negation is exact, so both triangles of an edge agree about it.
bool ExactGeometry::HitTriangle(const Shape& shape, const glm::dvec3& screen, Hit& hit) const {
  const glm::dvec3* v = shape.screen;
  const double side = shape.is_back != placed_[shape.drawable].mirrored ? -1.0 : 1.0;
  for (int i = 0; i < 3; ++i) {
    const glm::dvec3 edge = glm::cross(v[(i + 1) % 3], v[(i + 2) % 3]) * side;
    const double weight = glm::dot(edge, screen);
    if (weight < 0.0) return false;
    if (weight == 0.0) {
      const double first = edge.x != 0.0 ? edge.x : edge.y != 0.0 ? edge.y : edge.z;
      if (first < 0.0) return false;
    }
    hit.weight[i] = weight;
  }
  const double sum = hit.weight.x + hit.weight.y + hit.weight.z;
  if (!(sum > 0.0)) return false;
  hit.weight /= sum;
  const double distance =
      hit.weight.x * shape.distance[0] + hit.weight.y * shape.distance[1] + hit.weight.z * shape.distance[2];
  if (!(distance >= view_.near_distance && distance <= view_.far_distance)) return false;
  hit.depth = view_.DepthAt(distance);
  return true;
}

bool ExactGeometry::HitWide(const Shape& shape, const glm::dvec2& place, Hit& hit) const {
  const WideShape& wide = wide_[std::size_t(shape.wide)];
  const glm::dvec2 off = place - wide.from;
  if (!wide.is_line) {
    hit.weight = {1.0, 0.0, 0.0};
    hit.depth = RoundToFloat(wide.from_depth);
    return std::fabs(off.x) <= 0.5 && std::fabs(off.y) <= 0.5;
  }
  const glm::dvec2 whole = wide.to - wide.from;
  const double length = glm::length(whole), along = glm::dot(off, whole) / (length * length);
  const double across = (off.x * whole.y - off.y * whole.x) / length;
  if (along < 0.0 || along > 1.0 || std::fabs(across) > 0.5) return false;
  hit.depth = RoundToFloat(wide.from_depth + (wide.to_depth - wide.from_depth) * along);
  const glm::dvec3* v = shape.screen;
  const glm::dvec3 screen = view_.ScreenAt(place);
  const double first = glm::dot(glm::cross(v[1], v[2]), screen), second = glm::dot(glm::cross(v[2], v[0]), screen);
  const double share = std::clamp(second / (first + second), 0.0, 1.0);
  hit.weight = {1.0 - share, share, 0.0};
  return true;
}

void ExactGeometry::HitsAt(const glm::dvec2& place, const std::vector<std::uint32_t>& candidates,
                           std::vector<Hit>& hits) const {
  hits.clear();
  const glm::dvec3 screen = view_.ScreenAt(place);
  Hit hit;
  for (const std::uint32_t i : candidates) {
    const Shape& shape = primitives_[i];
    hit.primitive = i;
    if (shape.wide < 0 ? HitTriangle(shape, screen, hit) : HitWide(shape, place, hit)) hits.push_back(hit);
  }
}

SurfacePoint ExactGeometry::SurfaceAt(const Hit& hit) const {
  return Surface(TriangleOf(hit), hit.weight, primitives_[hit.primitive].is_back, nullptr);
}

SurfacePoint ExactGeometry::SurfaceOf(const TriangleId& triangle, const glm::dvec3& weight, bool is_back,
                                      const glm::dvec3& view) const {
  return Surface(triangle, weight, is_back, &view);
}

std::array<glm::dvec3, 3> ExactGeometry::CornersOf(const TriangleId& triangle) const {
  const Placed& placed = placed_[triangle.drawable];
  const std::array<std::uint32_t, 3> vertex = PrimitiveVertices(*placed.geometry, triangle.index);
  return {EyeRelative(placed, vertex[0]), EyeRelative(placed, vertex[1]), EyeRelative(placed, vertex[2])};
}

// `view`: null for that towards the camera.
SurfacePoint ExactGeometry::Surface(const TriangleId& primitive, const glm::dvec3& weight, bool is_back,
                                    const glm::dvec3* view) const {
  const Placed& placed = placed_[primitive.drawable];
  const Primitive& geometry = *placed.geometry;
  SurfacePoint point;
  point.geometry = &geometry;
  point.vertex = PrimitiveVertices(geometry, primitive.index);
  point.weight = weight;
  point.metres_per_unit = is_back ? 0.0 : placed.metres_per_unit;
  const auto mix = [&](const auto& of) { return of(0) * weight.x + of(1) * weight.y + of(2) * weight.z; };
  glm::dvec3 corner[3];
  for (std::size_t i = 0; i < 3; ++i) corner[i] = EyeRelative(placed, point.vertex[i]);
  point.position = mix([&](int i) { return corner[i]; });
  point.view = view != nullptr     ? *view
               : view_.perspective ? UnitOr(-point.position, {0.0, 0.0, 1.0})
                                   : glm::dvec3(0.0, 0.0, 1.0) * view_.camera_from_world;

  const double side = is_back ? -1.0 : 1.0, turn = placed.mirrored ? -side : side;
  const glm::dvec3 flat =
      UnitOr(glm::cross(corner[1] - corner[0], corner[2] - corner[0]) * turn, UnitOr(-corner[0], {0.0, 0.0, 1.0}));
  point.flat_normal = flat;
  point.interpolated_normal = flat;
  if (!geometry.normals.empty()) {
    point.interpolated_normal = mix([&](int i) {
      return UnitOr(placed.normal_from_mesh * glm::dvec3(geometry.normals[point.vertex[std::size_t(i)]]) * side, flat);
    });
  }
  point.normal = UnitOr(point.interpolated_normal, point.view);
  if (!geometry.tangents.empty()) {
    point.tangent = mix([&](int i) {
      const glm::dvec4 t(geometry.tangents[point.vertex[std::size_t(i)]]);
      const glm::dvec3 turned = UnitOr(placed.eye_relative_from_mesh * glm::dvec3(t), {1.0, 0.0, 0.0}) * side;
      return glm::dvec4(turned, t.w * turn);
    });
  }
  if (!geometry.colors.empty()) {
    point.color = mix([&](int i) { return glm::dvec4(geometry.colors[point.vertex[std::size_t(i)]]); });
  }
  return point;
}

}  // namespace facet
