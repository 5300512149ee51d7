#include "clip/assemble.h"

#include <algorithm>
#include <cmath>

#include "clip/clip_polygon.h"
#include "clip/small_triangles.h"
#include "frame/constants.h"
#include "scene/topology.h"

namespace facet {
namespace {

struct Corner {
  std::int32_t x_fx8, y_fx8;
  double depth;
};

// Snaps a coordinate. `size`: of the image along that axis. Nothing lies beyond the guard band except for half the
// width of lines, and for rounding errors at tiny distances, so the value is clamped.
std::int32_t Snap(double pixels, int size) {
  const double middle = size * 0.5, reach = kGuardBand + 1.0;
  return static_cast<std::int32_t>(std::nearbyint(std::clamp(pixels, middle - reach, middle + reach) * kSubpixelScale));
}

class Assembler {
 public:
  Assembler(const FrameView& view, const FrameDrawable& drawable, const VertexBuffer& vertices, int samples,
            TriangleChunk& chunk)
      : view_(view), drawable_(drawable), vertices_(vertices.data() + drawable.vertex_base), chunk_(chunk),
        samples_(samples) {}

  // Small triangles are set up in groups. A group that has other triangles is assembled one by one.
  void Triangles() {
    std::vector<std::uint32_t> unrolled;
    TriangleRun run;
    run.drawable = &drawable_;
    run.vertices = vertices_;
    run.corners = Corners(unrolled);
    run.drawable_index = chunk_.drawable;
    run.first_primitive = chunk_.first_primitive;
    run.samples = samples_;
    const auto advance = [&](std::uint32_t n) { run.corners += 3 * std::size_t{n}, run.first_primitive += n; };
    const std::uint32_t end = chunk_.first_primitive + chunk_.primitive_count;
    chunk_.records.reserve(chunk_.primitive_count);  // unused capacity takes no physical memory
    while (run.first_primitive < end) {
      run.count = end - run.first_primitive;
      const SmallTriangles small = SetUpSmallTriangles(run, chunk_.records);
      chunk_.culled += small.culled;
      chunk_.clipped += small.rejected;
      advance(small.taken);
      const std::uint32_t group = std::min(end - run.first_primitive, kTriangleGroup);
      for (std::uint32_t i = 0; i < group; ++i) {
        const std::uint32_t* v = run.corners + std::size_t{i} * 3;
        Triangle(run.first_primitive + i, {v[0], v[1], v[2]});
      }
      advance(group);
    }
  }

  void Triangle(std::uint32_t primitive, const std::array<std::uint32_t, 3>& v) {
    const std::int32_t c0 = Code(v[0]), c1 = Code(v[1]), c2 = Code(v[2]);
    if (Rejected(c0, c1, c2)) return;
    if (((c0 | c1 | c2) & kOutClip) == 0) {
      Emit(Vertex(v[0]), Vertex(v[1]), Vertex(v[2]), primitive, ScreenTriangleKind::Triangle);
      return;
    }
    ++chunk_.clipped;
    ClipVertex polygon[kMaxClipVertices + 1];
    const std::int32_t codes[3] = {c0, c1, c2};
    for (int i = 0; i < 3; ++i) polygon[i] = {Homogeneous(v[std::size_t(i)]), i, codes[i]};
    const int count = ClipPolygon(view_, c0 | c1 | c2, polygon, 3);
    Corner screen[kMaxClipVertices + 1];
    for (int i = 0; i < count; ++i) screen[i] = Project(polygon[i], v);
    for (int i = 2; i < count; ++i)
      Emit(screen[0], screen[i - 1], screen[i], primitive, ScreenTriangleKind::Triangle, true);
  }

  // A line is drawn as the rectangle of width 1 pixel around it (Vulkan 1.3 specification, "Rectangular Line
  // Segments").
  void Line(std::uint32_t primitive) {
    const auto v = PrimitiveVertices(*drawable_.geometry, primitive);
    const std::int32_t c0 = Code(v[0]), c1 = Code(v[1]);
    if (Rejected(c0, c1, c1)) return;
    ClipVertex ends[2] = {{Homogeneous(v[0]), 0}, {Homogeneous(v[1]), 1}};
    const bool clipped = ((c0 | c1) & kOutClip) != 0;
    if (clipped) {
      ++chunk_.clipped;
      if (ClipLine(view_, c0 | c1, ends) == 0) return;
    }
    const glm::dvec2 a = Pixel(ends[0].position), b = Pixel(ends[1].position);
    const glm::dvec2 along = b - a;
    const double length = glm::length(along);
    if (!(length > 0.0)) return void(++chunk_.culled);
    const glm::dvec2 across = glm::dvec2(-along.y, along.x) * (0.5 / length);
    const double depth_a = Depth(ends[0].position), depth_b = Depth(ends[1].position);
    Quad({At(a - across, depth_a), At(b - across, depth_b), At(b + across, depth_b), At(a + across, depth_a)},
         primitive, ScreenTriangleKind::Line, clipped);
  }

  // A point is drawn as the square of side 1 pixel around it.
  void Point(std::uint32_t primitive) {
    const auto v = PrimitiveVertices(*drawable_.geometry, primitive);
    const std::int32_t c = Code(v[0]);
    // The square of a point outside the image may reach into it, but the centre decides, as in OpenGL ES.
    if (Rejected(c, c, c)) return;
    if ((c & kOutClip) != 0) return void(++chunk_.clipped);
    const glm::dvec3 h = Homogeneous(v[0]);
    const glm::dvec2 p = Pixel(h);
    const double depth = Depth(h);
    Quad({At(p + glm::dvec2(-0.5, -0.5), depth), At(p + glm::dvec2(0.5, -0.5), depth),
          At(p + glm::dvec2(0.5, 0.5), depth), At(p + glm::dvec2(-0.5, 0.5), depth)},
         primitive, ScreenTriangleKind::Point);
  }

 private:
  // Three indices for each of the chunk's triangles: those of a triangle list, or computed into `unrolled`.
  const std::uint32_t* Corners(std::vector<std::uint32_t>& unrolled) const {
    const Primitive& geometry = *drawable_.geometry;
    if (geometry.topology == Topology::Triangles && !geometry.indices.empty()) {
      return geometry.indices.data() + std::size_t{chunk_.first_primitive} * 3;
    }
    unrolled.reserve(std::size_t{chunk_.primitive_count} * 3);
    for (std::uint32_t i = 0; i < chunk_.primitive_count; ++i) {
      for (const std::uint32_t v : PrimitiveVertices(geometry, chunk_.first_primitive + i)) unrolled.push_back(v);
    }
    return unrolled.data();
  }

  std::int32_t Code(std::uint32_t vertex) const { return vertices_[vertex].outcode; }

  Corner Vertex(std::uint32_t vertex) const {
    const ScreenVertex& v = vertices_[vertex];
    return {v.x_fx8, v.y_fx8, v.depth};
  }

  bool Rejected(std::int32_t c0, std::int32_t c1, std::int32_t c2) {
    if ((c0 & c1 & c2 & kOutReject) == 0 && ((c0 | c1 | c2) & kOutNotFinite) == 0) return false;
    ++chunk_.clipped;
    return true;
  }

  glm::dvec3 Homogeneous(std::uint32_t vertex) const {
    const glm::dvec4 p(glm::dvec3(drawable_.geometry->positions[vertex]), 1.0);
    return {glm::dot(drawable_.screen_from_mesh[0], p), glm::dot(drawable_.screen_from_mesh[1], p),
            glm::dot(drawable_.screen_from_mesh[2], p)};
  }

  glm::dvec2 Pixel(const glm::dvec3& h) const {
    return view_.perspective ? glm::dvec2(h.x / h.z, h.y / h.z) : glm::dvec2(h.x, h.y);
  }
  double Depth(const glm::dvec3& h) const { return view_.perspective ? 1.0 / h.z : -h.z; }

  Corner At(const glm::dvec2& pixel, double depth) const {
    return {Snap(pixel.x, view_.width), Snap(pixel.y, view_.height), depth};
  }

  // A vertex that clipping did not change keeps the position that the vertex stage computed, because neighbouring
  // triangles that are not clipped use it. For vertices that must be clipped that stage computes no position.
  Corner Project(const ClipVertex& v, const std::array<std::uint32_t, 3>& source) const {
    if (v.source >= 0 && (v.outcode & kOutClip) == 0) return Vertex(source[std::size_t(v.source)]);
    return At(Pixel(v.position), Depth(v.position));
  }

  // Emits a quad as two triangles. Facing does not matter, since it stands for a line or a point.
  void Quad(const std::array<Corner, 4>& q, std::uint32_t primitive, ScreenTriangleKind kind, bool clipped = false) {
    Emit(q[0], q[1], q[2], primitive, kind, clipped);
    Emit(q[0], q[2], q[3], primitive, kind, clipped);
  }

  void Emit(Corner a, Corner b, Corner c, std::uint32_t primitive, ScreenTriangleKind kind, bool clipped = false) {
    std::int64_t area = std::int64_t{b.x_fx8 - a.x_fx8} * (c.y_fx8 - a.y_fx8) -
                        std::int64_t{c.x_fx8 - a.x_fx8} * (b.y_fx8 - a.y_fx8);
    // glTF's front faces run counter-clockwise; with y down that is a negative area.
    const bool back = kind == ScreenTriangleKind::Triangle && (area > 0) != drawable_.mirrored;
    if (area == 0 || (back && !drawable_.double_sided)) return void(++chunk_.culled);
    if (area < 0) std::swap(b, c), area = -area;

    const std::int32_t x_fx8[3] = {a.x_fx8, b.x_fx8, c.x_fx8}, y_fx8[3] = {a.y_fx8, b.y_fx8, c.y_fx8};
    const SampleCoverage coverage = CoverageOf(x_fx8, y_fx8, samples_);
    if (!coverage.some) return void(++chunk_.culled);
    ScreenTriangle& r = chunk_.records.emplace_back();
    std::copy_n(x_fx8, 3, r.x_fx8);
    std::copy_n(y_fx8, 3, r.y_fx8);
    const double scale = static_cast<double>(kSubpixelScale) / static_cast<double>(area);
    const double x1 = b.x_fx8 - a.x_fx8, y1 = b.y_fx8 - a.y_fx8, x2 = c.x_fx8 - a.x_fx8, y2 = c.y_fx8 - a.y_fx8;
    const double z1 = b.depth - a.depth, z2 = c.depth - a.depth;
    r.depth_0 = a.depth;
    r.depth_dx = std::clamp((z1 * y2 - z2 * y1) * scale, -kSteepestDepth, kSteepestDepth);
    r.depth_dy = std::clamp((z2 * x1 - z1 * x2) * scale, -kSteepestDepth, kSteepestDepth);
    r.depth_min = static_cast<float>(std::min({a.depth, b.depth, c.depth}));
    r.depth_max = static_cast<float>(std::max({a.depth, b.depth, c.depth}));
    r.drawable = chunk_.drawable;
    r.primitive = primitive;
    r.kind = kind;
    r.back_facing = back;
    r.clipped = clipped;
    r.covered = coverage.covered;
  }

  const FrameView& view_;
  const FrameDrawable& drawable_;
  const ScreenVertex* vertices_;
  TriangleChunk& chunk_;
  const int samples_;
};

}  // namespace

void AssembleChunk(const FrameView& view, const FrameDrawable& drawable, const VertexBuffer& vertices, int samples,
                   TriangleChunk& chunk) {
  Assembler assembler(view, drawable, vertices, samples, chunk);
  const std::uint32_t end = chunk.first_primitive + chunk.primitive_count;
  chunk.records.clear();
  chunk.culled = chunk.clipped = 0;
  switch (ClassOf(drawable.geometry->topology)) {
    case PrimitiveClass::Points:
      for (std::uint32_t i = chunk.first_primitive; i < end; ++i) assembler.Point(i);
      break;
    case PrimitiveClass::Lines:
      for (std::uint32_t i = chunk.first_primitive; i < end; ++i) assembler.Line(i);
      break;
    case PrimitiveClass::Triangles:
      assembler.Triangles();
      break;
  }
}

}  // namespace facet
