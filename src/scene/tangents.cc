#include "scene/tangents.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/memory_budget.h"
#include "base/parallel.h"
#include "math/elementary.h"
#include "scene/geometry.h"
#include "scene/held_bytes.h"
#include "scene/topology.h"
#include "scene/weld.h"

namespace facet {
namespace {

constexpr std::uint32_t kNoGroup = 0xFFFFFFFFu;
// Derivatives below this are taken for zero.
constexpr double kTiny = double(std::numeric_limits<float>::min());

// What one triangle says about the direction of u.
struct Face {
  glm::dvec3 along_u{0.0}, along_v{0.0};  // unit, mesh space; negated where the UVs are mirrored
  bool preserves = false;                 // counter-clockwise in UV space, as its vertices are in mesh space
  bool undefined = true;                  // no area in UV space: it follows its neighbours, whatever they are
};

// The corners around one vertex that share a tangent: triangles of one UV orientation, joined by edges.
struct Group {
  std::uint32_t vertex = 0;  // welded
  bool preserves = false;
  std::uint32_t begin = 0, end = 0;  // into Groups::members
};

struct Groups {
  std::vector<Group> groups;
  std::vector<std::uint32_t> members;          // corners, group by group
  std::vector<std::uint32_t> group_of_corner;  // kNoGroup: none
};

// A corner's share in its group's tangent.
struct Share {
  glm::dvec3 along_u{0.0}, along_v{0.0};  // unit, perpendicular to the vertex's normal
  double angle = 0.0;                     // of the corner, seen along the normal, radians
  bool undefined = false;
};

glm::dvec3 NormalizedOrZero(const glm::dvec3& v) {
  const double length = std::sqrt(glm::dot(v, v));
  return length > kTiny && std::isfinite(length) ? v / length : glm::dvec3(0.0);
}

// The part of v perpendicular to the unit vector n, at unit length.
glm::dvec3 Flattened(const glm::dvec3& v, const glm::dvec3& n) { return NormalizedOrZero(v - n * glm::dot(n, v)); }

// A unit vector perpendicular to the unit vector n.
// Source: Duff, Burgess, Christensen, Hery, Kensler, Liani, Villemin 2017, Building an orthonormal basis, revisited.
glm::dvec3 AnyPerpendicular(const glm::dvec3& n) {
  const double sign = std::copysign(1.0, n.z);
  const double a = -1.0 / (sign + n.z);
  return {1.0 + sign * n.x * n.x * a, sign * n.x * n.y * a, -sign * n.x};
}

// The tangent of a corner that no UVs give one: along +X as far as the normal n allows.
glm::dvec3 DefaultTangent(const glm::dvec3& n) {
  const glm::dvec3 tangent = Flattened({1.0, 0.0, 0.0}, n);
  return tangent == glm::dvec3(0.0) ? AnyPerpendicular(n) : tangent;
}

class TangentMaker {
 public:
  TangentMaker(const Primitive& primitive, const std::vector<glm::vec2>& uvs)
      : primitive_(primitive), uvs_(uvs), welded_of_vertex_(WeldVertices(primitive, uvs)) {
    corners_.resize(primitive.indices.size());
    for (std::size_t c = 0; c < corners_.size(); ++c) corners_[c] = welded_of_vertex_[primitive.indices[c]];
  }

  // The tangent of each corner.
  std::vector<glm::vec4> Make() {
    MakeFaces();
    MakeGroups();
    std::vector<glm::vec4> tangents(corners_.size());
    ParallelFor(groups_.groups.size(), 1024, [&](std::size_t begin, std::size_t end) {
      std::vector<Share> shares;
      for (std::size_t g = begin; g < end; ++g) MakeGroupTangents(groups_.groups[g], shares, tangents);
    });
    FillUngrouped(tangents);
    return tangents;
  }

 private:
  static std::size_t NextOf(std::size_t corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; }
  static std::size_t PreviousOf(std::size_t corner) { return corner % 3 == 0 ? corner + 2 : corner - 1; }

  glm::dvec3 Position(std::size_t corner) const { return glm::dvec3(primitive_.positions[corners_[corner]]); }
  glm::dvec3 Normal(std::uint32_t vertex) const {
    const glm::dvec3 normal = NormalizedOrZero(glm::dvec3(primitive_.normals[vertex]));
    return normal == glm::dvec3(0.0) ? glm::dvec3(0.0, 0.0, 1.0) : normal;
  }

  // Solves edge = du * dP/du + dv * dP/dv for two edges of each triangle.
  void MakeFaces() {
    faces_.resize(corners_.size() / 3);
    degenerate_.assign(faces_.size(), 0);
    ParallelFor(faces_.size(), 4096, [&](std::size_t begin, std::size_t end) {
      for (std::size_t f = begin; f < end; ++f) {
        const glm::dvec3 p0 = Position(3 * f), p1 = Position(3 * f + 1), p2 = Position(3 * f + 2);
        degenerate_[f] = p0 == p1 || p0 == p2 || p1 == p2;
        const glm::dvec2 uv0(uvs_[corners_[3 * f]]), uv1(uvs_[corners_[3 * f + 1]]), uv2(uvs_[corners_[3 * f + 2]]);
        const glm::dvec2 a = uv1 - uv0, b = uv2 - uv0;
        const double area = a.x * b.y - a.y * b.x;  // twice the signed area in UV space
        Face& face = faces_[f];
        face.preserves = area > 0.0;
        if (!(std::fabs(area) > kTiny)) continue;
        const double sign = face.preserves ? 1.0 : -1.0;
        const glm::dvec3 edge1 = p1 - p0, edge2 = p2 - p0;
        face.along_u = sign * NormalizedOrZero(edge1 * b.y - edge2 * a.y);
        face.along_v = sign * NormalizedOrZero(edge2 * a.x - edge1 * b.x);
        face.undefined = face.along_u == glm::dvec3(0.0) || face.along_v == glm::dvec3(0.0);
      }
    });
    neighbors_ = FindNeighbors(corners_, degenerate_, primitive_.positions.size());
  }

  // Grows a group from each corner that has none, around its vertex in both directions.
  void MakeGroups() {
    groups_.group_of_corner.assign(corners_.size(), kNoGroup);
    groups_.members.reserve(corners_.size());
    std::vector<std::uint32_t> open;  // faces, a stack
    for (std::size_t c = 0; c < corners_.size(); ++c) {
      const std::size_t f = c / 3;
      if (degenerate_[f] || faces_[f].undefined || groups_.group_of_corner[c] != kNoGroup) continue;
      const std::uint32_t begin = std::uint32_t(groups_.members.size());
      const Group seed{corners_[c], faces_[f].preserves, begin, begin};
      open.assign(1, std::uint32_t(f));
      while (!open.empty()) {
        const std::uint32_t face = open.back();
        open.pop_back();
        if (face != kNoFace) AddToGroup(face, seed, open);
      }
      groups_.groups.push_back(seed);
      groups_.groups.back().end = std::uint32_t(groups_.members.size());
    }
  }

  void AddToGroup(std::size_t face, const Group& group, std::vector<std::uint32_t>& open) {
    std::uint32_t* const assigned = &groups_.group_of_corner[3 * face];
    std::size_t k = 0;
    while (corners_[3 * face + k] != group.vertex) ++k;  // a neighbour across an edge at the vertex has it
    if (assigned[k] != kNoGroup) return;
    // A triangle without UV area takes the orientation of whichever group comes first.
    const bool untouched = assigned[0] == kNoGroup && assigned[1] == kNoGroup && assigned[2] == kNoGroup;
    if (faces_[face].undefined && untouched) faces_[face].preserves = group.preserves;
    if (faces_[face].preserves != group.preserves) return;
    const std::size_t corner = 3 * face + k;
    assigned[k] = std::uint32_t(groups_.groups.size());
    groups_.members.push_back(std::uint32_t(corner));
    open.push_back(neighbors_[PreviousOf(corner)]);
    open.push_back(neighbors_[corner]);
  }

  Share ShareOf(std::size_t corner, const glm::dvec3& normal) const {
    const Face& face = faces_[corner / 3];
    Share share;
    share.along_u = Flattened(face.along_u, normal);
    share.along_v = Flattened(face.along_v, normal);
    share.undefined = face.undefined;
    const glm::dvec3 p = Position(corner);
    const glm::dvec3 to_previous = Flattened(Position(PreviousOf(corner)) - p, normal);
    const glm::dvec3 to_next = Flattened(Position(NextOf(corner)) - p, normal);
    share.angle = Acos(std::clamp(glm::dot(to_previous, to_next), -1.0, 1.0));
    return share;
  }

  // Directions that are exactly opposite would cancel: such corners do not count for one another.
  static bool Opposed(const Share& a, const Share& b) {
    constexpr double kOpposite = -1.0 + 1e-10;
    return !a.undefined && !b.undefined &&
           (glm::dot(a.along_u, b.along_u) <= kOpposite || glm::dot(a.along_v, b.along_v) <= kOpposite);
  }

  // `shares` is memory to work in.
  void MakeGroupTangents(const Group& group, std::vector<Share>& shares, std::vector<glm::vec4>& tangents) const {
    const glm::dvec3 normal = Normal(group.vertex);
    const std::size_t count = group.end - group.begin;
    shares.resize(count);
    glm::dvec3 sum_u(0.0), sum_v(0.0);
    for (std::size_t i = 0; i < count; ++i) {
      shares[i] = ShareOf(groups_.members[group.begin + i], normal);
      if (shares[i].undefined) continue;
      sum_u += shares[i].angle * shares[i].along_u;
      sum_v += shares[i].angle * shares[i].along_v;
    }
    // Within a right angle of the sum no two are opposite; that spares nearly all groups the comparison of pairs.
    const bool coherent = std::all_of(shares.begin(), shares.end(), [&](const Share& share) {
      return share.undefined || (glm::dot(share.along_u, sum_u) > 0.0 && glm::dot(share.along_v, sum_v) > 0.0);
    });
    constexpr std::size_t kMostCompared = 256;  // bounds the time that a hostile file can take
    const bool compare = !coherent && count <= kMostCompared;
    // In UVs with v up MikkTSpace's sign is +1 for triangles that keep their orientation; glTF's v points down.
    const float w = group.preserves ? -1.0f : 1.0f;
    for (std::size_t i = 0; i < count; ++i) {
      glm::dvec3 sum = sum_u;
      if (compare) {
        sum = glm::dvec3(0.0);
        for (const Share& share : shares) {
          const bool counts = !share.undefined && (&share == &shares[i] || !Opposed(shares[i], share));
          if (counts) sum += share.angle * share.along_u;
        }
      }
      glm::dvec3 tangent = NormalizedOrZero(sum);
      if (tangent == glm::dvec3(0.0)) tangent = DefaultTangent(normal);
      tangents[groups_.members[group.begin + i]] = glm::vec4(glm::vec3(tangent), w);
    }
  }

  // Corners of triangles without area take the tangent of another triangle at the same vertex; the rest get any.
  void FillUngrouped(std::vector<glm::vec4>& tangents) const {
    constexpr std::uint32_t kNone = 0xFFFFFFFFu;
    std::vector<std::uint32_t> first_good(primitive_.positions.size(), kNone);  // corner, by welded vertex
    for (std::size_t c = 0; c < corners_.size(); ++c) {
      if (degenerate_[c / 3]) continue;
      if (first_good[corners_[c]] == kNone) first_good[corners_[c]] = std::uint32_t(c);
      if (groups_.group_of_corner[c] == kNoGroup) {
        tangents[c] = glm::vec4(glm::vec3(DefaultTangent(Normal(corners_[c]))), 1.0f);
      }
    }
    for (std::size_t c = 0; c < corners_.size(); ++c) {
      if (!degenerate_[c / 3]) continue;
      const std::uint32_t good = first_good[corners_[c]];
      tangents[c] =
          good != kNone ? tangents[good] : glm::vec4(glm::vec3(DefaultTangent(Normal(corners_[c]))), 1.0f);
    }
  }

  const Primitive& primitive_;
  const std::vector<glm::vec2>& uvs_;
  std::vector<std::uint32_t> welded_of_vertex_;
  std::vector<std::uint32_t> corners_;  // welded vertices, three per face
  std::vector<Face> faces_;
  std::vector<std::uint8_t> degenerate_;  // by face: two of its positions are the same
  std::vector<std::uint32_t> neighbors_;  // by corner, see FindNeighbors
  Groups groups_;
};

// For each corner the first one at the same vertex with the same tangent (-0 and +0 are the same). Sorts each vertex's
// corners: a file may have any number of tangents around one vertex.
std::vector<std::uint32_t> FirstAlike(const std::vector<glm::vec4>& corner_tangents, const Primitive& primitive) {
  const std::vector<std::uint32_t>& vertex_of = primitive.indices;
  const std::size_t vertex_count = primitive.positions.size();
  std::vector<std::uint32_t> start(vertex_count + 1, 0);  // into sorted, by vertex
  for (const std::uint32_t v : vertex_of) ++start[v + 1];
  for (std::size_t v = 0; v < vertex_count; ++v) start[v + 1] += start[v];
  std::vector<std::uint32_t> sorted(vertex_of.size()), end(start.begin(), start.end() - 1);
  for (std::size_t c = 0; c < vertex_of.size(); ++c) sorted[end[vertex_of[c]]++] = std::uint32_t(c);

  const auto order = [&](std::uint32_t a, std::uint32_t b) {
    const glm::vec4 &s = corner_tangents[a], &t = corner_tangents[b];
    for (int i = 0; i < 4; ++i) {
      if (s[i] != t[i]) return s[i] < t[i];
    }
    return a < b;
  };
  std::vector<std::uint32_t> alike(vertex_of.size());
  ParallelFor(vertex_count, 4096, [&](std::size_t begin, std::size_t last) {
    for (std::size_t v = begin; v < last; ++v) {
      std::sort(sorted.begin() + start[v], sorted.begin() + start[v + 1], order);
      for (std::uint32_t i = start[v]; i < start[v + 1]; ++i) {
        const std::uint32_t c = sorted[i];
        const bool follows = i > start[v] && corner_tangents[sorted[i - 1]] == corner_tangents[c];
        alike[c] = follows ? alike[sorted[i - 1]] : c;
      }
    }
  });
  return alike;
}

// Stores one tangent per corner as one per vertex, with copies of vertices whose corners disagree.
void StoreByVertex(const std::vector<glm::vec4>& corner_tangents, Primitive& primitive) {
  const std::size_t count = primitive.positions.size();
  const std::vector<std::uint32_t> alike = FirstAlike(corner_tangents, primitive);
  std::vector<std::uint32_t> source(count);
  std::vector<std::uint8_t> used(count, 0);
  std::vector<glm::vec4> tangents(count);
  for (std::size_t v = 0; v < count; ++v) source[v] = std::uint32_t(v);
  for (std::size_t c = 0; c < primitive.indices.size(); ++c) {
    std::uint32_t& v = primitive.indices[c];
    if (alike[c] != c) {
      v = primitive.indices[alike[c]];  // an earlier corner, which has its copy
    } else if (!used[v]) {
      used[v] = 1;
      tangents[v] = corner_tangents[c];
    } else {
      const std::uint32_t copy = std::uint32_t(source.size());
      source.push_back(v);
      tangents.push_back(corner_tangents[c]);
      v = copy;
    }
  }
  for (std::size_t v = 0; v < count; ++v) {
    if (used[v]) continue;
    const glm::dvec3 normal = NormalizedOrZero(glm::dvec3(primitive.normals[v]));
    tangents[v] = glm::vec4(glm::vec3(AnyPerpendicular(normal)), 1.0f);
  }
  if (source.size() > count) {
    primitive.tangents.clear();
    const MemoryLease lease(source.size(), HeldBytes(primitive) / count, "making tangents");
    GatherVertices(source, primitive);
  }
  primitive.tangents = std::move(tangents);
}

// The UVs as `map` turns and mirrors them. How far it moves and stretches them has no influence on directions.
std::vector<glm::vec2> Turned(const std::vector<glm::vec2>& uvs, const TextureRef& map) {
  const double c = Cos(double(map.rotation)), s = Sin(double(map.rotation));
  const glm::dvec2 scale(map.scale);
  std::vector<glm::vec2> turned(uvs.size());
  for (std::size_t i = 0; i < uvs.size(); ++i) {
    const glm::dvec2 uv = scale * glm::dvec2(uvs[i]);
    turned[i] = glm::vec2(glm::dvec2(c * uv.x + s * uv.y, c * uv.y - s * uv.x));
  }
  return turned;
}

bool TurnsOrMirrors(const TextureRef& map) {
  return map.rotation != 0.0f || !(map.scale.x > 0.0f && map.scale.y > 0.0f);
}

}  // namespace

void MakeTangents(const TextureRef& normal_map, Primitive& primitive) {
  // Measured: what welding, grouping and comparing take at their most, and the tangents by corner.
  constexpr std::uint64_t kPerCorner = 160, kPerVertex = 64;
  const MemoryLease lease(kPerCorner * 3 * PrimitiveCount(primitive) + kPerVertex * primitive.positions.size(), 1,
                          "making tangents");
  if (primitive.topology != Topology::Triangles || primitive.indices.empty()) MakeTriangleList(primitive);
  primitive.indices.resize(primitive.indices.size() / 3 * 3);
  const std::size_t set = std::size_t(normal_map.tex_coord);
  if (set < primitive.tex_coords.size() && !primitive.tex_coords[set].empty()) {
    const std::vector<glm::vec2>& uvs = primitive.tex_coords[set];
    const std::vector<glm::vec2> turned =
        TurnsOrMirrors(normal_map) ? Turned(uvs, normal_map) : std::vector<glm::vec2>();
    StoreByVertex(TangentMaker(primitive, turned.empty() ? uvs : turned).Make(), primitive);
    return;
  }
  primitive.tangents.resize(primitive.normals.size());
  for (std::size_t i = 0; i < primitive.normals.size(); ++i) {
    const glm::dvec3 normal = NormalizedOrZero(glm::dvec3(primitive.normals[i]));
    primitive.tangents[i] = glm::vec4(glm::vec3(AnyPerpendicular(normal)), 1.0f);
  }
}

}  // namespace facet
