// Primitives: attributes, indices and morph targets.
#pragma once

#include <optional>

#include "facet/scene.h"
#include "gltf/accessor.h"
#include "gltf/node_tree.h"

namespace facet::gltf {

// Reads one primitive of a mesh; nothing (and a warning) where it has no positions, no vertices or no indices. Vertices
// that the indices do not come near are left out, and so are broken attributes that say how the surface looks.
// Throws Error(InvalidInput, OutOfMemory) where the vertices' places cannot be read.
std::optional<Primitive> ReadPrimitive(Context& context, BufferStore& buffers, AccessorReader& reader,
                                       const Json& object, const MeshUse& use, const Place& place);

}  // namespace facet::gltf
