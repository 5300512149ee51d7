// What a frame of a scene uses, what it leaves out and why, and what each thing costs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "facet/render.h"

namespace facet {

// A material as some of the geometry uses it.
struct ExplainedMaterial {
  std::string name;  // empty: it has none, or is glTF's default
  int index = -1;    // into Scene::materials; -1: glTF's default
  bool lit = false;
  std::vector<std::string> features;  // words of --without that shading it takes, and "double-sided"
  std::uint64_t drawables = 0;
  std::uint64_t triangles = 0;  // lines and points too
};

struct ExplainedTexture {
  std::string image;                 // its name, or where its bytes are
  std::vector<std::string> roles;    // "base-color", "metallic-roughness", "normal", "occlusion", "emission"
  ImageHeader file;                  // what the encoded picture says of itself
  std::optional<TextureStats> kept;  // none: no visible triangle reads it, or it could not be decoded
};

struct ExplainedLights {
  int directional = 0, point = 0, spot = 0;
};

// What one feature takes, by leaving it out and taking the difference. All may be negative: a surface that does not
// blend hides what is behind it.
struct FeatureCost {
  std::string feature;  // a word of --without, or "multisampling", "background", "planes", "anisotropy"
  std::string option;   // that leaves it out: "--without skins"
  int pairs = 0;        // of steady frames, with it and without it by turns
  // Seconds of a steady frame: median of the pairs' differences, and their quartiles. A cost whose quartiles have
  // different signs is within the noise.
  double seconds = 0, seconds_low = 0, seconds_high = 0;
  double first_seconds = 0;  // of the first frame's pose, decoding of textures, and environment
  std::int64_t bytes = 0;    // kept from frame to frame: textures, environment, copies of geometry
};

struct Explanation {
  std::string version;  // of facet
  int width = 0, height = 0, samples = 0;
  std::vector<ExplainedMaterial> materials;
  std::vector<ExplainedTexture> textures;
  ExplainedLights lights;
  bool environment_light = false, environment_background = false;
  std::vector<PlaneKind> planes;  // of the film, besides colour
  std::string environment;        // "studio", "WxH", or empty
  RenderStats first;              // of the first frame; `left_out` has what the frame does without and why
  RenderStats steady;             // of a frame like the one before
  int frames = 0;
  double steady_seconds = 0;  // median of as many
  std::vector<FeatureCost> costs;
};

// Renders the scene again and again: some ten frames at least for each feature that it uses. `settings.progress` is not
// called. Throws what Render() throws.
Explanation Explain(const Scene& scene, const RenderSettings& settings);

// For people: tables. `scene` is what the scene is called.
std::string ToText(const Explanation& explanation, const std::string& scene);
// The same numbers as one JSON object with stable keys; times in seconds.
std::string ToJson(const Explanation& explanation, const std::string& scene);

}  // namespace facet
