// Primitives: attributes, indices and morph targets.
#pragma once

#include <optional>

#include "facet/scene.h"
#include "gltf/accessor.h"

namespace facet::gltf {

// Reads one primitive of a mesh; nothing (and a warning) where it has no positions. Vertices that the indices do not
// come near are left out. Throws Error(InvalidInput, OutOfMemory).
std::optional<Primitive> ReadPrimitive(Context& context, BufferStore& buffers, AccessorReader& reader, std::size_t mesh,
                                       std::size_t primitive);

}  // namespace facet::gltf
