// Primitives: attributes, indices and morph targets.
#pragma once

#include <optional>

#include "facet/scene.h"
#include "gltf/accessor.h"
#include "gltf/node_tree.h"

namespace facet::gltf {

// Reads one primitive of a mesh. Returns nothing, with a warning, if it has no positions, vertices or indices. Vertices
// beyond the range of the indices are dropped, and broken attributes that affect only appearance are ignored. Throws
// Error(InvalidInput, OutOfMemory) if positions cannot be read.
std::optional<Primitive> ReadPrimitive(Context& context, BufferStore& buffers, AccessorReader& reader,
                                       const Json& object, const MeshUse& use, const Place& place);

}  // namespace facet::gltf
