// The bundled scenes.
#pragma once

#include "glb.h"

namespace facet::assets {

Glb MaterialGrid();  // spheres over roughness (x) and metalness (y)
Glb Showcase();      // a still life: textures, normal maps, occlusion, emission, cutouts, glass
Glb Materials();     // a row of spheres for each parameter of the material extensions
Glb Gallery();       // a showpiece of the material extensions: glass, lacquer, velvet, paper, soap, spun steel
Glb Room();          // a box with a point, a spot and a directional light
Glb Animated();      // a skinned tentacle, a morphing blob, a hopping cube

// A node's matrix: at `eye`, looking at `target` along -Z, +Y up; for cameras and lights.
Json LookAt(Vec3 eye, Vec3 target);
Json ToJson(Vec3 v);
// Linear base colour, metalness and perceptual roughness.
Json PlainMaterial(const char* name, Vec3 color, double metallic, double roughness);
int AddPerspectiveCamera(Glb& glb, const char* name, Vec3 eye, Vec3 target, double yfov);
// A node with a light of KHR_lights_punctual; `light` without its name.
void AddLight(Glb& glb, const char* name, Json light, Json node);

}  // namespace facet::assets
