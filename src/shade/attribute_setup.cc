#include "shade/attribute_setup.h"

#include <algorithm>
#include <array>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shade/attribute_setup.cc"
#include "hwy/foreach_target.h"
// Must come after foreach_target.h.
#include "facet/shader/dispatch.h"
#include "facet/shader/vec-inl.h"
#include "math/round_to_float.h"
#include "scene/topology.h"

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace HWY_NAMESPACE {

// --- Lanes of doubles, one for each of several triangles ------------------------------------------------------------

using DoubleTag = hn::ScalableTag<double>;
using HalfTag = hn::Rebind<float, DoubleTag>;
inline constexpr std::size_t kMaxDoubles = kMaxLanes < 2 ? 1 : kMaxLanes / 2;

struct Double {
  using Raw = hn::Vec<DoubleTag>;
  Raw raw;
  Double() = default;
  FACET_INLINE Double(Raw r) : raw(r) {}                           // NOLINT: as Float
  FACET_INLINE Double(double d) : raw(hn::Set(DoubleTag(), d)) {}  // NOLINT
};
struct DoubleMask {
  hn::Mask<DoubleTag> raw;
};
template <>
struct LaneTraits<Double> {
  using MaskType = DoubleMask;
};

FACET_INLINE Double operator+(Double a, Double b) { return hn::Add(a.raw, b.raw); }
FACET_INLINE Double operator-(Double a, Double b) { return hn::Sub(a.raw, b.raw); }
FACET_INLINE Double operator*(Double a, Double b) { return hn::Mul(a.raw, b.raw); }
FACET_INLINE Double operator/(Double a, Double b) { return hn::Div(a.raw, b.raw); }
FACET_INLINE Double operator-(Double a) { return hn::Neg(a.raw); }
FACET_INLINE DoubleMask operator<(Double a, Double b) { return {hn::Lt(a.raw, b.raw)}; }
FACET_INLINE DoubleMask operator&(DoubleMask a, DoubleMask b) { return {hn::And(a.raw, b.raw)}; }
FACET_INLINE bool All(DoubleMask a) { return hn::AllTrue(DoubleTag(), a.raw); }
FACET_INLINE Double Abs(Double a) { return hn::Abs(a.raw); }
FACET_INLINE Double Sqrt(Double a) { return hn::Sqrt(a.raw); }
FACET_INLINE Double Select(DoubleMask m, Double a, Double b) { return hn::IfThenElse(m.raw, a.raw, b.raw); }
FACET_INLINE Double Max(Double a, Double b) { return Select(b < a, a, b); }  // like Float's: if a is NaN, returns b
FACET_INLINE Double Load(const double* p) { return hn::LoadU(DoubleTag(), p); }
FACET_INLINE Double LoadPromoted(const float* p) { return hn::PromoteTo(DoubleTag(), hn::LoadU(HalfTag(), p)); }
FACET_INLINE void StoreRounded(Double a, float* p) {
#if HWY_TARGET == HWY_SCALAR  // Highway's demotion would clamp to the largest float
  *p = RoundToFloat(hn::GetLane(a.raw));
#else
  hn::StoreU(hn::DemoteTo(HalfTag(), a.raw), HalfTag(), p);
#endif
}

using Point = Vec3<Double>;

// --- Inputs and outputs of a group of triangles ---------------------------------------------------------------------

// One component of each triangle of a group.
using LaneFloats = float[kMaxDoubles];

// A three-component attribute of all vertices.
struct Corners {
  alignas(64) LaneFloats components[9];
  FACET_INLINE void Set(std::size_t lane, int corner, const float* xyz) {
    for (int c = 0; c < 3; ++c) components[3 * corner + c][lane] = xyz[c];
  }
  FACET_INLINE Point Get(int corner) const {
    const LaneFloats* n = components + 3 * corner;
    return {LoadPromoted(n[0]), LoadPromoted(n[1]), LoadPromoted(n[2])};
  }
};

// The setups of a group up to the tangents, one component after the other, with triangles in lanes.
struct AttributeLanes {
  static constexpr int kCount = (AttributeLayout::kColors + 3) / 4 * 4;
  alignas(64) LaneFloats components[kCount] = {};

  FACET_INLINE void Put(int component, Double value) { StoreRounded(value, components[component]); }
  FACET_INLINE void Put(int component, const Point& p) {
    Put(component, p.x), Put(component + 1, p.y), Put(component + 2, p.z);
  }

  // Transposes the first `count` components of `lanes` triangles into their setups. Writes four at a time, so up to
  // three more may be written.
  FACET_INLINE void WriteTo(float* setups, std::size_t stride, std::size_t lanes, int count) const {
    alignas(64) float fours[4 * kMaxDoubles];
    const HalfTag half;
    for (int i = 0; i < count; i += 4) {
      hn::StoreInterleaved4(hn::LoadU(half, components[i]), hn::LoadU(half, components[i + 1]),
                            hn::LoadU(half, components[i + 2]), hn::LoadU(half, components[i + 3]), half, fours);
      for (std::size_t k = 0; k < lanes; ++k) std::memcpy(setups + k * stride + i, fours + 4 * k, 16);
    }
  }
};

// --- The arithmetic -------------------------------------------------------------------------------------------------

FACET_INLINE Double HomogeneousRow(const glm::dvec4& row, const Point& p) {
  return (Double(row.x) * p.x + Double(row.y) * p.y) + (Double(row.z) * p.z + Double(row.w));
}

// `w`: 1 for positions, 0 for directions.
FACET_INLINE Point Transform(const glm::dmat3x4& rows, const Point& p, double w) {
  const auto row = [&](int i) HWY_ATTR {
    const glm::dvec4& r = rows[i];
    return p.x * Double(r.x) + p.y * Double(r.y) + p.z * Double(r.z) + Double(w * r.w);
  };
  return {row(0), row(1), row(2)};
}

FACET_INLINE Point Transform(const glm::dmat3& m, const Point& p) {
  const auto row = [&](int i) HWY_ATTR {
    return Double(m[0][i]) * p.x + Double(m[1][i]) * p.y + Double(m[2][i]) * p.z;
  };
  return {row(0), row(1), row(2)};
}

// v / |v|, or fallback() where v has no direction. It is evaluated only if some lane needs it.
template <class Fallback>
FACET_INLINE Point UnitOr(const Point& v, const Fallback& fallback) {
  const Double length = Sqrt(Dot(v, v));
  const DoubleMask good = (Double(0.0) < length) & (length < Double(HUGE_VAL));
  const Point unit = v / length;
  return All(good) ? unit : Select(good, unit, fallback());
}

// Computes the weights' planes: the rows of the inverse of the matrix with columns h[0], h[1], h[2], up to a positive
// factor, which cancels as weights are divided by their sum. A degenerate triangle gets all attributes from its first
// vertex.
//
// Returns the determinant of the planes, 0 if they do not depend on all vertices.
FACET_INLINE Double PutPlanes(const Point (&h)[3], ScreenTriangleKind kind, AttributeLanes& out) {
  Point row[3] = {Cross(h[1], h[2]), Cross(h[2], h[0]), Cross(h[0], h[1])};
  const Double determinant = Dot(row[0], h[0]), zero(0.0);
  const Double sign = Select(determinant < zero, Double(-1.0), Double(1.0));
  Double largest = zero;
  for (Point& r : row) {
    r = r * sign;
    // The scale is chosen so that weights are at most about 1 within the 64 pixels that a tile spans.
    const Double reach(64.0);
    largest = Max(Max(Max(largest, Abs(r.x) * reach), Abs(r.y) * reach), Abs(r.z));
  }
  if (kind == ScreenTriangleKind::Line) row[2] = {zero, zero, zero};  // the third vertex only gives the line's width
  const DoubleMask good = (zero < largest) & (largest < Double(HUGE_VAL)) & (zero < Abs(determinant));
  for (int i = 0; i < 3; ++i) {
    const Point plane = row[i] / largest;
    const Point degenerate = {zero, zero, Double(i == 0 ? 1.0 : 0.0)};
    out.Put(AttributeLayout::kPlanes + 3 * i,
            kind == ScreenTriangleKind::Point ? degenerate : Select(good, plane, degenerate));
  }
  if (kind != ScreenTriangleKind::Triangle) return zero;
  const Double scale = determinant / largest;  // the determinant of the rows is that of the vertices, squared
  return Select(good, scale * scale / largest, zero);
}

// --- Groups ---------------------------------------------------------------------------------------------------------

// Triangles of one drawable and kind that are set up together, one per lane. Unused lanes have old values, whose
// results are not read.
struct Group {
  const FrameDrawable* drawable;
  const Primitive* geometry;
  ScreenTriangleKind kind;
  Corners positions, normals, tangents;
  alignas(64) double sides[kMaxDoubles];  // -1 for back faces, otherwise 1
};

constexpr float kNoTangent[3] = {1.0f, 0.0f, 0.0f};

using Vertices = std::array<std::uint32_t, 3>;

void SetUpGroup(const AttributeSetupTask& task, const Group& group, AttributeLanes& out) {
  const FrameView& view = *task.view;
  const FrameDrawable& drawable = *group.drawable;
  Point h[3];
  for (int i = 0; i < 3; ++i) {
    const Point p = group.positions.Get(i);
    const Double w = view.perspective ? HomogeneousRow(drawable.screen_from_mesh[2], p) : Double(1.0);
    h[i] = {HomogeneousRow(drawable.screen_from_mesh[0], p) - Double(task.anchor_x) * w,
            HomogeneousRow(drawable.screen_from_mesh[1], p) - Double(task.anchor_y) * w, w};
  }
  if (group.kind == ScreenTriangleKind::Line) {
    const Point line = Cross(h[0], h[1]);  // its x and y point across the line on the screen
    h[2] = {line.x, line.y, Double(0.0)};
  }
  const Double planes = PutPlanes(h, group.kind, out);

  const Double side = Load(group.sides), mirrored_side = drawable.mirrored ? -side : side;
  if (task.material->Has(kLit)) {
    Point position[3];
    for (int i = 0; i < 3; ++i) {
      position[i] = Transform(drawable.eye_relative_from_mesh, group.positions.Get(i), 1.0);
      out.Put(AttributeLayout::kPositions + 3 * i, position[i]);
    }
    const auto toward_eye = [&]() HWY_ATTR {
      return UnitOr(-position[0], []() HWY_ATTR { return Point{Double(0.0), Double(0.0), Double(1.0)}; });
    };
    const auto flat = [&]() HWY_ATTR {
      return UnitOr(Cross(position[1] - position[0], position[2] - position[0]) * mirrored_side, toward_eye);
    };
    const bool given = !group.geometry->normals.empty();
    Point normal[3];
    for (int i = 0; i < 3; ++i) {
      normal[i] = given ? UnitOr(Transform(drawable.normal_from_mesh, group.normals.Get(i)) * side, flat) : flat();
      out.Put(AttributeLayout::kNormals + 3 * i, normal[i]);
    }
    const bool sweeps = given && task.material->specular_antialiasing;
    out.Put(AttributeLayout::kNormalSweep,
            sweeps ? Abs(Dot(normal[0], Cross(normal[1] - normal[0], normal[2] - normal[0]))) * planes : Double(0.0));
  }
  if (task.material->Has(kTangentSpaceBits)) {
    for (int i = 0; i < 3; ++i) {
      const Point turned = Transform(drawable.eye_relative_from_mesh, group.tangents.Get(i), 0.0);
      const Point x_axis{Double(1.0), Double(0.0), Double(0.0)};
      out.Put(AttributeLayout::kTangents + 4 * i, UnitOr(turned, [&]() HWY_ATTR { return x_axis; }) * side);
      out.Put(AttributeLayout::kTangents + 4 * i + 3, mirrored_side);  // CopyAttributes() multiplies by the handedness
    }
  }
}

// Copies the attributes that need no arithmetic.
void CopyAttributes(const FrameMaterial& material, const Primitive& geometry, const Vertices& vertex, float* setup) {
  if (material.Has(kTangentSpaceBits) && !geometry.tangents.empty()) {
    float* handedness = setup + AttributeLayout::kTangents + 3;
    for (int i = 0; i < 3; ++i) handedness[4 * i] *= geometry.tangents[vertex[std::size_t(i)]].w;
  }
  if (material.vertex_colors) {
    for (int i = 0; i < 3; ++i) {
      const glm::vec4 c = geometry.colors[vertex[std::size_t(i)]];
      std::copy(&c.x, &c.x + 4, setup + AttributeLayout::kColors + 4 * i);
    }
  }
  for (int slot = 0; slot < material.uv_slots; ++slot) {
    const std::size_t set = std::size_t(material.uv_sets[slot]);
    const bool present = set < geometry.tex_coords.size() && !geometry.tex_coords[set].empty();
    for (int i = 0; i < 3; ++i) {
      const glm::vec2 uv = present ? geometry.tex_coords[set][vertex[std::size_t(i)]] : glm::vec2(0.0f);
      float* out = setup + AttributeLayout::kTexCoords + 6 * slot + 2 * i;
      out[0] = uv.x, out[1] = uv.y;
    }
  }
}

void SetUpTriangleAttributesKernel(const AttributeSetupTask& task) {
  // Indices are prefetched ahead, and, when they have arrived, the vertices: with small triangles, memory latency would
  // dominate otherwise.
  constexpr std::size_t kAhead = 16;  // triangles; at least twice the number of lanes
  static_assert(kAhead >= 2 * kMaxDoubles);
  const FrameMaterial& material = *task.material;
  const bool lit = material.Has(kLit), tangent_space = material.Has(kTangentSpaceBits);
  const auto stride = std::size_t(AttributeLayout::Stride(material.uv_slots));
  const int count = tangent_space ? AttributeLayout::kColors
                    : lit         ? AttributeLayout::kTangents
                                  : AttributeLayout::kPositions;
  Vertices vertices[kAhead];  // of triangle i at i % kAhead
  const auto ahead_index = [](std::size_t i) { return i % kAhead; };
  const auto ask_for_indices = [&](std::size_t i) HWY_ATTR {
    if (i >= task.count) return;
    const auto& indices = task.attributes[task.records[i]->drawable]->indices;
    const std::size_t first = std::size_t(task.records[i]->primitive) * 3;  // wrong for strips, harmlessly
    if (first + 2 < indices.size()) __builtin_prefetch(&indices[first]);
  };
  const auto ask_for_vertices = [&](std::size_t i) HWY_ATTR {
    if (i >= task.count) return;
    const Primitive& geometry = *task.attributes[task.records[i]->drawable];
    const Vertices vertex = PrimitiveVertices(geometry, task.records[i]->primitive);
    vertices[ahead_index(i)] = vertex;
    const glm::vec3* positions = geometry.positions.data();
    const glm::vec3* normals = geometry.normals.empty() ? positions : geometry.normals.data();
    for (const std::uint32_t v : vertex) __builtin_prefetch(positions + v), __builtin_prefetch(normals + v);
  };
  for (std::size_t i = 0; i < 2 * kAhead; ++i) ask_for_indices(i);
  for (std::size_t i = 0; i < kAhead; ++i) ask_for_vertices(i);

  Group group{};
  AttributeLanes out;
  for (std::size_t i = 0; i < task.count;) {
    group.drawable = task.drawables + task.records[i]->drawable;
    group.geometry = task.attributes[task.records[i]->drawable];
    group.kind = task.records[i]->kind;
    const Primitive& geometry = *group.geometry;
    const glm::vec3* positions = geometry.positions.data();
    const glm::vec3* normals = lit && !geometry.normals.empty() ? geometry.normals.data() : nullptr;
    const glm::vec4* tangents = tangent_space && !geometry.tangents.empty() ? geometry.tangents.data() : nullptr;
    const std::size_t most = std::min(hn::Lanes(DoubleTag()), task.count - i);
    std::size_t n = 0;
    for (; n < most; ++n) {
      const ScreenTriangle& record = *task.records[i + n];
      if (task.drawables + record.drawable != group.drawable || record.kind != group.kind) break;
      const Vertices& vertex = vertices[ahead_index(i + n)];
      for (int k = 0; k < 3; ++k) {
        const std::size_t v = vertex[std::size_t(k)];
        group.positions.Set(n, k, &positions[v].x);
        if (normals != nullptr) group.normals.Set(n, k, &normals[v].x);
        if (tangent_space) group.tangents.Set(n, k, tangents != nullptr ? &tangents[v].x : kNoTangent);
      }
      group.sides[n] = record.back_facing ? -1.0 : 1.0;
    }
    SetUpGroup(task, group, out);
    float* setups = task.setups + i * stride;
    out.WriteTo(setups, stride, n, count);
    for (std::size_t k = 0; k < n; ++k) {
      CopyAttributes(material, geometry, vertices[ahead_index(i + k)], setups + k * stride);
    }
    if (material.Has(kVolume)) {
      for (std::size_t k = 0; k < n; ++k) {
        setups[k * stride + stride - 1] = task.records[i + k]->back_facing ? 0.0f : group.drawable->metres_per_unit;
      }
    }
    for (std::size_t k = i; k < i + n; ++k) ask_for_vertices(k + kAhead), ask_for_indices(k + 2 * kAhead);
    i += n;
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace facet
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace facet {

FACET_EXPORT(SetUpTriangleAttributesKernel);

void SetUpTriangleAttributes(const AttributeSetupTask& task) { FACET_DISPATCH(SetUpTriangleAttributesKernel)(task); }

}  // namespace facet
#endif
