// The data that the geometry stages (vertex, clip, bin) pass on to one another and to the tiles.
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
  double offset_x = 0.0, offset_y = 0.0;    // orthographic: the image's centre
};

// A drawable as the stages see it.
struct FrameDrawable {
  const Primitive* geometry = nullptr;
  int material = -1;               // index into the frame's materials
  std::uint32_t vertex_base = 0;   // index of its first vertex in the frame's vertex buffer
  std::uint32_t primitive_count = 0;  // triangles, lines or points
  bool mirrored = false;           // negative determinant: the winding order is reversed
  bool double_sided = false;
  // From mesh space to homogeneous screen space; the rows give x, y and distance. `screen_from_local` takes positions
  // relative to `centre_mesh`, so that float is precise enough for meshes far from the origin; `screen_from_mesh` is
  // the same transform in double.
  glm::vec3 centre_mesh{0.0f};
  glm::vec4 screen_from_local[3];
  glm::dvec4 screen_from_mesh[3];
  glm::dmat3x4 eye_relative_from_mesh{0.0};  // three rows; world axes, origin at the eye
  glm::dmat3 normal_from_mesh{1.0};          // cofactor matrix of the upper left 3 x 3, valid if singular
  float metres_per_unit = 1.0f;              // of the mesh: the cube root of its determinant's absolute value
};

enum OutcodeBit : std::int32_t {
  kOutNear = 1, kOutFar = 2, kOutGuardLeft = 4, kOutGuardRight = 8, kOutGuardTop = 16, kOutGuardBottom = 32,
  kOutLeft = 64, kOutRight = 128, kOutTop = 256, kOutBottom = 512, kOutNotFinite = 1024,
};
// A primitive must be clipped if one of its vertices has one of these bits.
inline constexpr std::int32_t kOutClip = 63;
// A primitive is invisible if all its vertices have one of these bits in common.
inline constexpr std::int32_t kOutReject = 1023;

// A vertex on the screen. Position and depth are valid if (outcode & kOutClip) == 0.
struct ScreenVertex {
  std::int32_t x_fx8, y_fx8;
  float depth;
  std::int32_t outcode;
};

// One entry per vertex of every drawable.
using VertexBuffer = PageVector<ScreenVertex>;

enum class ScreenTriangleKind : std::uint8_t { Triangle, Line, Point };

// A triangle on the screen, with vertices snapped to 1/256 pixel: a primitive, or one of the pieces that a clipped
// triangle, a line or a point is made of. In the lists of chunks and tiles it is called a record. Its depth, clamped to
// [depth_min, depth_max], is
//   depth(x, y) = depth_0 + depth_dx * (x - x_0) + depth_dy * (y - y_0), with x and y in pixels,
// in double, because vertex 0 may be thousands of pixels away; it is rounded to float once per block (MakeBlockDepth).
struct ScreenTriangle {
  std::int32_t x_fx8[3], y_fx8[3];  // clockwise on the screen (y down): positive area
  double depth_0, depth_dx, depth_dy;
  float depth_min, depth_max;
  std::uint32_t drawable;
  std::uint32_t primitive;  // within the drawable
  ScreenTriangleKind kind;
  bool back_facing;
  bool clipped;  // a piece of a clipped primitive: its vertices are not the primitive's
  // For triangles within a CoverageSquare, the mask of covered samples: bit ((y << stride_bits) + x) * samples + s is
  // sample s of pixel (x, y), counted from FirstPixel() of the least vertex x and y. 0: not computed yet.
  std::uint32_t covered;
  ScreenTriangle()
      : primitive(0),
        kind(ScreenTriangleKind::Triangle),
        back_facing(false),
        clipped(false),
        covered(0) {}  // NOLINT: rest unset
};

// The least and greatest of three coordinates. (Nested calls of two arguments compile without branches, those with a
// list of three do not.)
inline std::int32_t LeastOf(const std::int32_t (&p)[3]) { return std::min(std::min(p[0], p[1]), p[2]); }
inline std::int32_t GreatestOf(const std::int32_t (&p)[3]) { return std::max(std::max(p[0], p[1]), p[2]); }

// A run of one drawable's primitives that one task processes. The order of chunks is submission order.
struct TriangleChunk {
  std::uint32_t drawable = 0;
  std::uint32_t first_primitive = 0, primitive_count = 0;
  std::vector<ScreenTriangle> records;  // binning reorders them to the order in which tiles read them
  // Triangles by tile: tile tiles[i] has the entries [begin[i], begin[i + 1]) of `entries`, indices into `records`.
  std::vector<std::uint32_t> tiles, begin, entries;
  std::uint64_t culled = 0, clipped = 0;
};

}  // namespace facet
