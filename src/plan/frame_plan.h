// What this scene with these settings needs, and what it leaves out. Made once a frame, obeyed by every stage.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "facet/render.h"
#include "plan/frame_material.h"
#include "scene/pose.h"

namespace facet {

// A texture that has to be decoded: one image in one role.
struct PlannedTexture {
  int image = -1;
  TextureRole role = TextureRole::Data;
  bool mips = false;
};

// A material as one kind of drawable uses it.
struct PlannedMaterial {
  int material = -1;           // index into Scene::materials; -1: glTF's default
  bool vertex_colors = false;  // the geometry has colours
  bool unlit = false;          // the file says so, or points and lines without normals
  FrameMaterial frame;         // texture slots still empty
  // Index into FramePlan::textures for base colour, metallic-roughness, normal, occlusion, emission; -1: none.
  int textures[5] = {-1, -1, -1, -1, -1};
};

struct FramePlan {
  std::vector<PlannedMaterial> materials;
  std::vector<PlannedTexture> textures;
  std::vector<int> material_of_drawable;  // index into `materials`
  bool environment_light = false;         // some material is lit, and there is an environment
  bool environment_background = false;
  bool punctual_lights = false;
  bool alpha_test = false;
  bool blending = false;
  std::vector<std::string> left_out;  // one line each: "WHAT: WHY"
};

FramePlan MakeFramePlan(const Scene& scene, const PosedScene& posed, const RenderSettings& settings);

}  // namespace facet
