// Morph targets and skins.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "facet/scene.h"

namespace facet {

// A copy of everything but morph targets, joints and weights.
Primitive CopyWithoutDeformers(const Primitive& primitive);

// True if some target with a weight other than zero changes something.
bool IsMorphed(const Primitive& primitive, const std::vector<float>& weights);

// Adds the displacements of the targets times their weights (missing ones are zero, surplus ones ignored) to
// `deformed`, a copy of the attributes of `primitive`, which keeps the targets. Normals and tangents are made unit
// again (one that vanishes keeps its undeformed direction), colours clamped to [0, 1].
void ApplyMorph(const Primitive& primitive, const std::vector<float>& weights, Primitive& deformed);

// One skin at one moment.
struct JointMatrices {
  std::vector<glm::dmat4> local_from_mesh;  // by joint
  glm::dmat4 unskinned_from_mesh{1.0};      // for vertices that no joint can be found for
  glm::dmat4 world_from_local{1.0};         // a translation, with a mirror in x where the skin mirrors
};

// The joints' matrices, relative to an origin near the mesh: coordinates of a figure far from the world's origin would
// lose their last digits in float. Where most joints mirror, so does world_from_local: the winding of the triangles
// then follows from its determinant as it does for any other mesh.
JointMatrices PlaceJoints(const Skin& skin, const std::vector<glm::dmat4>& world_from_node,
                          const glm::dmat4& world_from_mesh_node);

// Skins positions, normals and tangents of `primitive` by the joints and weights of `influences`, which has as many
// vertices. Weights are divided by their sum; those not above zero have no influence, and a vertex that has no other
// follows the joint of its first slot. Normals go with the blended matrix's inverse transpose, from its cofactors,
// which exist for singular matrices too. Throws Error(InvalidInput), with `where`, if a joint with influence is not one
// of the skin's.
void ApplySkin(const JointMatrices& matrices, const Primitive& influences, const std::string& where,
               Primitive& primitive);

}  // namespace facet
