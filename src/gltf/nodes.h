// Everything that stands in space: nodes, skins, cameras, lights and instances.
#pragma once

#include "facet/scene.h"
#include "gltf/accessor.h"
#include "gltf/node_tree.h"

namespace facet::gltf {

// By index into Scene::cameras: false for one that cannot be used, which gets a lens that has no meaning, and no node.
std::vector<bool> ReadCameras(Context& context, Scene& scene);

// KHR_lights_punctual. Needs no other part of the scene.
void ReadLights(Context& context, Scene& scene);

// Throws Error(InvalidInput) where a skin that is shown cannot be read; another one gets no joints, and a warning.
void ReadSkins(Context& context, AccessorReader& reader, const Shown& shown, Scene& scene);

// What nodes hold: transforms, meshes, skins, cameras, lights, instances (EXT_mesh_gpu_instancing). Needs the tree,
// meshes, skins, cameras and lights. Throws Error(InvalidInput) where what a shown node draws, or where, is not known.
void ReadNodes(Context& context, AccessorReader& reader, const Shown& shown, const std::vector<bool>& usable_cameras,
               Scene& scene);

}  // namespace facet::gltf
