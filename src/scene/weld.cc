#include "scene/weld.h"

#include <algorithm>
#include <array>
#include <bit>

namespace facet {
namespace {

using Key = std::array<std::uint32_t, 8>;

// Adding +0 turns -0 into +0 and leaves all else as it is.
std::uint32_t Bits(float value) { return std::bit_cast<std::uint32_t>(value + 0.0f); }

Key KeyOf(const glm::vec3& p, const glm::vec3& n, const glm::vec2& uv) {
  return {Bits(p.x), Bits(p.y), Bits(p.z), Bits(n.x), Bits(n.y), Bits(n.z), Bits(uv.x), Bits(uv.y)};
}

std::uint64_t Hash(const Key& key) {
  std::uint64_t hash = 0x9E3779B97F4A7C15u;
  for (const std::uint32_t word : key) {
    hash = (hash ^ word) * 0xBF58476D1CE4E5B9u;
    hash ^= hash >> 29;
  }
  return hash;
}

}  // namespace

// Vertices are dealt into about as many buckets as there are, by their hashes, and each bucket is sorted: a file can be
// made so that all its hashes collide.
std::vector<std::uint32_t> WeldVertices(const Primitive& primitive, const std::vector<glm::vec2>& uvs) {
  const std::size_t count = primitive.positions.size();
  const auto key_of = [&](std::size_t i) { return KeyOf(primitive.positions[i], primitive.normals[i], uvs[i]); };
  const std::size_t mask = std::bit_ceil(count) - 1;
  std::vector<std::uint64_t> hashes(count);
  std::vector<std::uint32_t> start(mask + 2, 0);
  for (std::size_t i = 0; i < count; ++i) {
    hashes[i] = Hash(key_of(i));
    ++start[(hashes[i] & mask) + 1];
  }
  for (std::size_t b = 0; b <= mask; ++b) start[b + 1] += start[b];
  std::vector<std::uint32_t> vertices(count), end(start.begin(), start.end() - 1);
  for (std::size_t i = 0; i < count; ++i) vertices[end[hashes[i] & mask]++] = std::uint32_t(i);

  std::vector<std::uint32_t> first(count);
  for (std::size_t b = 0; b <= mask; ++b) {
    const auto low = vertices.begin() + start[b], high = vertices.begin() + start[b + 1];
    if (high - low > 1) {
      std::sort(low, high, [&](std::uint32_t v, std::uint32_t w) {
        if (hashes[v] != hashes[w]) return hashes[v] < hashes[w];
        const Key key_v = key_of(v), key_w = key_of(w);
        return key_v != key_w ? key_v < key_w : v < w;
      });
    }
    for (auto v = low; v != high; ++v) {
      const bool same = v != low && hashes[*(v - 1)] == hashes[*v] && key_of(*(v - 1)) == key_of(*v);
      first[*v] = same ? first[*(v - 1)] : *v;
    }
  }
  return first;
}

std::vector<std::uint32_t> FindNeighbors(const std::vector<std::uint32_t>& corners,
                                         const std::vector<std::uint8_t>& skipped, std::size_t vertex_count) {
  struct Edge {
    std::uint32_t high = 0;    // the larger of its two vertices
    std::uint32_t corner = 0;  // where it starts
  };
  const auto next_of = [](std::size_t corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; };

  // Edges by their smaller vertex, in the order of the list.
  std::vector<std::uint32_t> start(vertex_count + 1, 0);
  for (std::size_t c = 0; c < corners.size(); ++c) {
    if (!skipped[c / 3]) ++start[std::min(corners[c], corners[next_of(c)]) + 1];
  }
  for (std::size_t v = 0; v < vertex_count; ++v) start[v + 1] += start[v];
  std::vector<Edge> edges(start[vertex_count]);
  std::vector<std::uint32_t> end(start.begin(), start.end() - 1);
  for (std::size_t c = 0; c < corners.size(); ++c) {
    if (skipped[c / 3]) continue;
    const std::uint32_t a = corners[c], b = corners[next_of(c)];
    edges[end[std::min(a, b)]++] = {std::max(a, b), std::uint32_t(c)};
  }

  std::vector<std::uint32_t> neighbors(corners.size(), kNoFace);
  std::vector<std::uint32_t> waiting;  // corners of the edges without partner, all of one direction
  for (std::size_t v = 0; v < vertex_count; ++v) {
    const auto first = edges.begin() + start[v], last = edges.begin() + start[v + 1];
    std::sort(first, last, [](const Edge& a, const Edge& b) {
      return a.high != b.high ? a.high < b.high : a.corner < b.corner;
    });
    std::size_t served = 0;
    for (auto edge = first; edge != last; ++edge) {
      if (edge == first || edge->high != (edge - 1)->high) {
        waiting.clear();
        served = 0;
      }
      // The edge's direction shows in which vertex it starts from.
      if (served < waiting.size() && corners[waiting[served]] != corners[edge->corner]) {
        neighbors[edge->corner] = waiting[served] / 3;
        neighbors[waiting[served]] = edge->corner / 3;
        ++served;
      } else {
        waiting.push_back(edge->corner);
      }
    }
  }
  return neighbors;
}

}  // namespace facet
