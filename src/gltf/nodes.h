// Nodes, skins, cameras, lights and instances.
#pragma once

#include "facet/scene.h"
#include "gltf/accessor.h"
#include "gltf/node_tree.h"

namespace facet::gltf {

// Reads the cameras. The result tells for each whether it can be used; others get an arbitrary lens, and no node.
std::vector<bool> ReadCameras(Context& context, Scene& scene);

// Reads KHR_lights_punctual. Needs no other part of the scene.
void ReadLights(Context& context, Scene& scene);

// Reads the skins. Throws Error(InvalidInput) if a visible skin cannot be read; others get no joints, with a warning.
void ReadSkins(Context& context, AccessorReader& reader, const Shown& shown, Scene& scene);

// Reads the nodes' transforms, meshes, skins, cameras, lights and instances (EXT_mesh_gpu_instancing). Needs the tree,
// meshes, skins, cameras and lights. Throws Error(InvalidInput) if the mesh or transform of a visible node cannot be
// read.
void ReadNodes(Context& context, AccessorReader& reader, const Shown& shown, const std::vector<bool>& usable_cameras,
               Scene& scene);

}  // namespace facet::gltf
