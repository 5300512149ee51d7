// What passes between the geometry stages (vertex, clip, bin) and the tiles.
#pragma once

#include <algorithm>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "base/pages.h"
#include "facet/scene.h"

namespace facet {

// The camera of a frame, reduced to what the stages need. "Homogeneous screen space" is (x, y, distance): for a
// perspective camera a point is at pixel (x / distance, y / distance) and its depth is 1 / distance; for an
// orthographic one it is at pixel (x, y) and its depth is -distance. Depth is affine over the screen, and larger is
// nearer.
struct FrameView {
  int width = 0, height = 0;
  bool perspective = true;
  double near_distance = 0.0;
  double far_distance = 0.0;   // infinity: none
  glm::dvec3 eye_world{0.0};
  glm::dmat3 camera_from_world{1.0};        // rotation
  glm::dvec3 screen_x{0.0}, screen_y{0.0};  // homogeneous x = dot(screen_x, position in camera space) + offset_x
  double offset_x = 0.0, offset_y = 0.0;    // orthographic: the picture's centre
};

// A drawable as the stages see it.
struct FrameDrawable {
  const Primitive* geometry = nullptr;
  int material = -1;               // index into the frame's materials
  std::uint32_t vertex_base = 0;   // of its vertices in the frame's vertex buffer
  std::uint32_t primitive_count = 0;  // triangles, lines or points
  bool mirrored = false;           // negative determinant: counter-clockwise turns clockwise
  bool double_sided = false;
  // Homogeneous screen space from mesh space, rows x, y, distance. `screen_from_local` takes positions relative to
  // `centre_mesh`, which keeps float precision far from the origin; `screen_from_mesh` is the same map in double.
  glm::vec3 centre_mesh{0.0f};
  glm::vec4 screen_from_local[3];
  glm::dvec4 screen_from_mesh[3];
  glm::dmat3x4 eye_relative_from_mesh{0.0};  // three rows: world axes, origin at the eye
  glm::dmat3 normal_from_mesh{1.0};          // cofactors of the upper left 3 x 3: right for singular matrices too
};

enum OutcodeBit : std::int32_t {
  kOutNear = 1, kOutFar = 2, kOutGuardLeft = 4, kOutGuardRight = 8, kOutGuardTop = 16, kOutGuardBottom = 32,
  kOutLeft = 64, kOutRight = 128, kOutTop = 256, kOutBottom = 512, kOutNotFinite = 1024,
};
// A vertex with one of these needs its primitives clipped.
inline constexpr std::int32_t kOutClip = 63;
// Primitives whose vertices share one of these are not visible.
inline constexpr std::int32_t kOutReject = 1023;

// A vertex on the screen. Position and depth are meaningful where (outcode & kOutClip) == 0.
struct ScreenVertex {
  std::int32_t x_fx8, y_fx8;
  float depth;
  std::int32_t outcode;
};

// One entry per vertex of every drawable.
using VertexBuffer = PageVector<ScreenVertex>;

enum class RecordKind : std::uint8_t { Triangle, Line, Point };

// A snapped screen triangle: a whole primitive, or a piece of one that was clipped or widened.
// depth(x, y) = depth_0 + depth_dx * (x - x_0) + depth_dy * (y - y_0), in pixels, kept within [depth_min, depth_max].
// In double, because the vertex may be thousands of pixels away; rounded to float once a block (MakeBlockDepth).
struct TriangleRecord {
  std::int32_t x_fx8[3], y_fx8[3];  // clockwise on the screen (y down): positive area
  double depth_0, depth_dx, depth_dy;
  float depth_min, depth_max;
  std::uint32_t drawable;
  std::uint32_t primitive;  // within the drawable
  RecordKind kind;
  bool back_facing;
  bool clipped;  // a piece of what the primitive covers: its depths are not those of the primitive's vertices
  // Of a triangle within a CoverageSquare, the samples that it covers: bit ((y << stride_bits) + x) * samples + s is
  // sample s of pixel (x, y) from FirstPixel() of its least x and y on. 0: not known.
  std::uint32_t covered;
  TriangleRecord()
      : primitive(0),
        kind(RecordKind::Triangle),
        back_facing(false),
        clipped(false),
        covered(0) {}  // NOLINT: rest unset
};

// Of three coordinates. (Pairs, and not lists of three, become instructions without a branch.)
inline std::int32_t LeastOf(const std::int32_t (&p)[3]) { return std::min(std::min(p[0], p[1]), p[2]); }
inline std::int32_t GreatestOf(const std::int32_t (&p)[3]) { return std::max(std::max(p[0], p[1]), p[2]); }

// A run of one drawable's primitives, processed by one task. Chunk order is submission order.
struct TriangleChunk {
  std::uint32_t drawable = 0;
  std::uint32_t first_primitive = 0, primitive_count = 0;
  std::vector<TriangleRecord> records;  // after binning in the order in which tiles read them, no longer as drawn
  // Records by tile: tile tiles[i] holds entries [begin[i], begin[i + 1]) of `entries`, each an index into `records`.
  std::vector<std::uint32_t> tiles, begin, entries;
  std::uint64_t culled = 0, clipped = 0;
};

}  // namespace facet
