// Morph targets and skins.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "facet/scene.h"

namespace facet {

// A copy of a primitive without morph targets, joints and weights.
Primitive CopyWithoutDeformers(const Primitive& primitive);

// Whether some target with a weight other than 0 has displacements.
bool IsMorphed(const Primitive& primitive, const std::vector<float>& weights);

// Adds the displacements of the targets times their weights (missing ones are zero, surplus ones ignored) to
// `deformed`, a copy of the attributes of `primitive`, which keeps the targets. Normals and tangents are made unit
// again (one that vanishes keeps its undeformed direction), colours clamped to [0, 1].
void ApplyMorph(const Primitive& primitive, const std::vector<float>& weights, Primitive& deformed);

// The matrices of a skin at one moment.
struct JointMatrices {
  std::vector<glm::dmat4> local_from_mesh;  // by joint
  glm::dmat4 unskinned_from_mesh{1.0};      // for vertices without a joint
  glm::dmat4 world_from_local{1.0};         // a translation, with a mirror in x where the skin mirrors
};

// Computes the joints' matrices relative to an origin near the mesh, so that float is precise enough for figures far
// from the world's origin. If most joints mirror, world_from_local mirrors too, so that the triangles' winding follows
// from its determinant as for any other mesh.
JointMatrices PlaceJoints(const Skin& skin, const std::vector<glm::dmat4>& world_from_node,
                          const glm::dmat4& world_from_mesh_node);

// Skins positions, normals and tangents of `primitive` by the joints and weights of `influences`, which has as many
// vertices. Weights are divided by their sum; those not above 0 have no influence, and a vertex that has no other
// follows the joint of its first slot. Normals are transformed by the inverse transpose of the blended matrix, computed
// from its cofactors, which also exist for singular matrices. Throws Error(InvalidInput), with `where`, if a joint with
// influence does not belong to the skin.
void ApplySkin(const JointMatrices& matrices, const Primitive& influences, const std::string& where,
               Primitive& primitive);

}  // namespace facet
