#include "scene/deform.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "base/parallel.h"
#include "facet/error.h"
#include "math/round_to_float.h"

namespace facet {
namespace {

constexpr std::size_t kVerticesPerPiece = 4096;

// `v` at unit length, or `otherwise` where it has no direction.
glm::dvec3 NormalizedOr(const glm::dvec3& v, const glm::dvec3& otherwise) {
  const double length = std::sqrt(glm::dot(v, v));
  return length > 0.0 && std::isfinite(length) ? v / length : otherwise;
}

// The weight and the displacements of each target that changes an attribute; `list` returns a target's array of it.
template <class T, class List>
std::vector<std::pair<double, const T*>> ActiveTargets(const Primitive& primitive, const std::vector<float>& weights,
                                                       const List& list) {
  std::vector<std::pair<double, const T*>> active;
  const std::size_t count = std::min(primitive.targets.size(), weights.size());
  for (std::size_t i = 0; i < count; ++i) {
    const std::vector<T>* values = list(primitive.targets[i]);
    if (weights[i] != 0.0f && values != nullptr && !values->empty()) active.emplace_back(weights[i], values->data());
  }
  return active;
}

// values[i] = finish(values[i] + sum of weight * displacement, values[i]), summed in double in the order of targets.
// V is the vector that is displaced, T the targets'; a tangent's handedness (V longer than T) stays.
template <class V, class T, class Finish>
void Displace(const std::vector<std::pair<double, const T*>>& active, std::vector<V>& values, const Finish& finish) {
  if (active.empty() || values.empty()) return;
  using Sum = glm::vec<T::length(), double>;
  ParallelFor(values.size(), kVerticesPerPiece, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Sum base = Sum(values[i]);
      Sum sum = base;
      for (const auto& [weight, displacements] : active) sum += weight * Sum(displacements[i]);
      const T result = RoundToFloat(finish(sum, base));
      for (int c = 0; c < T::length(); ++c) values[i][c] = result[c];
    }
  });
}

// The matrix that transforms normals, up to a factor: determinant * inverse transpose.
glm::dmat3 Cofactors(const glm::dmat3& m) {
  return {glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1])};
}

void CheckJoints(const Primitive& influences, std::size_t joint_count, const std::string& where) {
  for (std::size_t set = 0; set < influences.joints.size(); ++set) {
    for (std::size_t i = 0; i < influences.joints[set].size(); ++i) {
      for (int c = 0; c < 4; ++c) {
        const std::size_t joint = influences.joints[set][i][c];
        if (joint >= joint_count && influences.weights[set][i][c] > 0.0f) {
          throw Error(ErrorCode::InvalidInput,
                      "vertex " + std::to_string(i) + " follows joint " + std::to_string(joint) + " of a skin of " +
                          std::to_string(joint_count),
                      where);
        }
      }
    }
  }
}

// The matrix of one vertex.
glm::dmat4 Blend(const JointMatrices& matrices, const Primitive& influences, std::size_t vertex) {
  double sum = 0.0;
  for (const auto& set : influences.weights) {
    for (int c = 0; c < 4; ++c) sum += set[vertex][c] > 0.0f ? double(set[vertex][c]) : 0.0;
  }
  if (sum == 0.0) {  // some exporters forget weights; most often they mean the first joint
    const std::size_t joint = influences.joints.empty() ? 0 : influences.joints[0][vertex][0];
    const bool exists = joint < matrices.local_from_mesh.size();
    return exists ? matrices.local_from_mesh[joint] : matrices.unskinned_from_mesh;
  }
  if (!std::isfinite(sum)) return matrices.unskinned_from_mesh;
  glm::dmat4 blended(0.0);
  for (std::size_t set = 0; set < influences.weights.size(); ++set) {
    for (int c = 0; c < 4; ++c) {
      const float weight = influences.weights[set][vertex][c];
      if (!(weight > 0.0f)) continue;
      blended += (double(weight) / sum) * matrices.local_from_mesh[influences.joints[set][vertex][c]];
    }
  }
  return blended;
}

}  // namespace

Primitive CopyWithoutDeformers(const Primitive& primitive) {
  Primitive copy;
  copy.topology = primitive.topology;
  copy.positions = primitive.positions;
  copy.normals = primitive.normals;
  copy.tangents = primitive.tangents;
  copy.tex_coords = primitive.tex_coords;
  copy.colors = primitive.colors;
  copy.indices = primitive.indices;
  copy.material = primitive.material;
  copy.variant_materials = primitive.variant_materials;
  return copy;
}

bool IsMorphed(const Primitive& primitive, const std::vector<float>& weights) {
  const std::size_t count = std::min(primitive.targets.size(), weights.size());
  return std::any_of(weights.begin(), weights.begin() + std::ptrdiff_t(count), [](float w) { return w != 0.0f; });
}

void ApplyMorph(const Primitive& primitive, const std::vector<float>& weights, Primitive& deformed) {
  const auto keep = [](const auto& sum, const auto&) { return sum; };
  const auto unit = [](const glm::dvec3& sum, const glm::dvec3& base) { return NormalizedOr(sum, base); };
  Displace(ActiveTargets<glm::vec3>(primitive, weights, [](const MorphTarget& t) { return &t.positions; }),
           deformed.positions, keep);
  Displace(ActiveTargets<glm::vec3>(primitive, weights, [](const MorphTarget& t) { return &t.normals; }),
           deformed.normals, unit);
  Displace(ActiveTargets<glm::vec3>(primitive, weights, [](const MorphTarget& t) { return &t.tangents; }),
           deformed.tangents, unit);
  for (std::size_t set = 0; set < deformed.tex_coords.size(); ++set) {
    const auto list = [set](const MorphTarget& t) { return set < t.tex_coords.size() ? &t.tex_coords[set] : nullptr; };
    Displace(ActiveTargets<glm::vec2>(primitive, weights, list), deformed.tex_coords[set], keep);
  }
  Displace(ActiveTargets<glm::vec4>(primitive, weights, [](const MorphTarget& t) { return &t.colors; }),
           deformed.colors, [](const glm::dvec4& sum, const glm::dvec4&) { return glm::clamp(sum, 0.0, 1.0); });
}

JointMatrices PlaceJoints(const Skin& skin, const std::vector<glm::dmat4>& world_from_node,
                          const glm::dmat4& world_from_mesh_node) {
  JointMatrices matrices;
  std::size_t mirrored = 0;
  for (std::size_t i = 0; i < skin.joints.size(); ++i) {
    const glm::dmat4 mesh_to_joint = skin.inverse_bind.empty() ? glm::dmat4(1.0) : glm::dmat4(skin.inverse_bind[i]);
    matrices.local_from_mesh.push_back(world_from_node[std::size_t(skin.joints[i])] * mesh_to_joint);
    if (glm::determinant(glm::dmat3(matrices.local_from_mesh.back())) < 0.0) ++mirrored;
  }
  glm::dvec3 origin(0.0);
  if (!skin.joints.empty()) origin = glm::dvec3(world_from_node[std::size_t(skin.joints[0])][3]);
  for (int c = 0; c < 3; ++c) origin[c] = std::isfinite(origin[c]) ? origin[c] : 0.0;
  const double sign_x = mirrored * 2 > skin.joints.size() ? -1.0 : 1.0;
  matrices.world_from_local[0][0] = sign_x;
  matrices.world_from_local[3] = glm::dvec4(origin, 1.0);

  // Row by row rather than as a product with the inverse: exact.
  const auto to_local = [&](const glm::dmat4& world_from_mesh) {
    glm::dmat4 result = world_from_mesh;
    result[3] = glm::dvec4(glm::dvec3(result[3]) - origin, 1.0);
    for (int c = 0; c < 4; ++c) result[c].x *= sign_x;
    return result;
  };
  for (glm::dmat4& matrix : matrices.local_from_mesh) matrix = to_local(matrix);
  matrices.unskinned_from_mesh = to_local(world_from_mesh_node);
  return matrices;
}

void ApplySkin(const JointMatrices& matrices, const Primitive& influences, const std::string& where,
               Primitive& primitive) {
  CheckJoints(influences, matrices.local_from_mesh.size(), where);
  ParallelFor(primitive.positions.size(), kVerticesPerPiece, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const glm::dmat4 matrix = Blend(matrices, influences, i);
      const glm::dmat3 linear(matrix);
      primitive.positions[i] = RoundToFloat(linear * glm::dvec3(primitive.positions[i]) + glm::dvec3(matrix[3]));
      if (primitive.normals.empty()) continue;
      const glm::dmat3 cofactors = Cofactors(linear);
      const double handedness = glm::dot(linear[0], cofactors[0]) < 0.0 ? -1.0 : 1.0;  // sign of the determinant
      const glm::dvec3 normal(primitive.normals[i]);
      // A matrix that flattens the mesh to a line or a point leaves no normal; the transformed old one is used instead.
      const glm::dvec3 fallback = NormalizedOr(linear * normal, normal);
      primitive.normals[i] = glm::vec3(NormalizedOr(handedness * (cofactors * normal), fallback));
      if (primitive.tangents.empty()) continue;
      const glm::dvec3 tangent(primitive.tangents[i]);
      const glm::dvec3 turned = NormalizedOr(linear * tangent, tangent);
      primitive.tangents[i] = glm::vec4(glm::vec3(turned), primitive.tangents[i].w * float(handedness));
    }
  });
}

}  // namespace facet
