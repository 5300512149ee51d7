// Everything that stands in space: nodes, scenes, skins, cameras, lights and instances.
#pragma once

#include "facet/scene.h"
#include "gltf/accessor.h"

namespace facet::gltf {

void ReadCameras(Context& context, Scene& scene);

// KHR_lights_punctual. Needs no other part of the scene.
void ReadLights(Context& context, Scene& scene);

// Throws Error(InvalidInput) for a wrong type or count of inverse bind matrices.
void ReadSkins(Context& context, AccessorReader& reader, Scene& scene);

// Nodes, their instances (EXT_mesh_gpu_instancing) and visibility (KHR_node_visibility), and the scenes. Needs meshes,
// skins, cameras and lights. Throws Error(InvalidInput) for cycles, second parents, joints that a skin does not have.
void ReadNodes(Context& context, AccessorReader& reader, Scene& scene);

}  // namespace facet::gltf
