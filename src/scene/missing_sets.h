// Which textures name a set of texture coordinates that the geometry lacks.
#pragma once

#include <cstddef>

#include "facet/scene.h"
#include "material/features.h"
#include "material/model_parameters.h"
#include "scene/topology.h"

namespace facet {

// Calls visit(SlotInfo, set) for each texture of `material` that shows on the primitive and reads TEXCOORD_set, which
// the primitive does not have.
template <class Visit>
void ForEachMissingSet(const Primitive& primitive, const Material& material, const Visit& visit) {
  const bool on_surface = ClassOf(primitive.topology) == PrimitiveClass::Triangles || !primitive.normals.empty();
  ForEachSlotOf(material.model, FeaturesOf(material, on_surface), [&](const SlotInfo& slot) {
    const auto set = std::size_t(TextureIn(material, slot).tex_coord);
    if (set >= primitive.tex_coords.size() || primitive.tex_coords[set].empty()) visit(slot, set);
  });
}

}  // namespace facet
