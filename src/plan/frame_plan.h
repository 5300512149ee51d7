// The plan of a frame: what this scene with these settings needs, and what is disabled. It is made once, and every
// stage obeys it.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "facet/settings.h"
#include "light/albedo_tables.h"
#include "plan/frame_material.h"
#include "scene/pose.h"

namespace facet {

inline constexpr int kWhiteImage = -1;  // one white texel

// One image that is read in one role, to be decoded if it is visible.
struct PlannedTexture {
  int image = kWhiteImage;
  TextureRole role = TextureRole::Data;
  bool mips = false;
  int channels = 0;       // those that are read, as bits of ChannelMask
  bool emission = false;  // read for emission only

  bool operator==(const PlannedTexture&) const = default;
};

// A material as one kind of geometry uses it.
struct PlannedMaterial {
  int material = -1;           // index into Scene::materials; -1: glTF's default
  bool vertex_colors = false;  // the geometry has colours
  std::shared_ptr<const ModelParameters> parameters;  // those of `frame`
  FrameMaterial frame;         // texture slots still empty
  std::array<int, kMaxSlots> textures = NoTextures();  // by Slot: index into FramePlan::textures; -1: none

  static constexpr std::array<int, kMaxSlots> NoTextures() {
    std::array<int, kMaxSlots> none{};
    none.fill(-1);
    return none;
  }
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
  AlbedoTables albedo_tables;     // that some material needs
  bool transmission = false;      // some material is seen through
  std::vector<PlaneKind> planes;  // of the film, besides colour
  bool zero_light = false;        // add a light of intensity zero
  bool every_texture = false;  // decode textures even if no visible material reads them
  FeatureSet uses;             // features of the scene that the frame uses; not those of UseEverything()
  std::vector<std::string> disabled;  // one line each: "WHAT: WHY"
};

// The pose that a frame with these settings draws.
PoseSettings PoseOf(const RenderSettings& settings);

// `posed`: by PoseOf(settings).
FramePlan MakeFramePlan(const Scene& scene, const PosedScene& posed, const RenderSettings& settings);

}  // namespace facet
