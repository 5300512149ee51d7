// An explanation of a frame: the features it uses, those it disables and why, and the cost of each.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "facet/render.h"

namespace facet {

// A material together with the geometry that uses it.
struct ExplainedMaterial {
  std::string name;  // empty: none, or glTF's default material
  int index = -1;    // into Scene::materials; -1: glTF's default
  std::string model;  // its shading model, as `facet info` calls it
  bool lit = false;
  std::vector<std::string> features;  // words of --without for what shading it needs, and "double-sided"
  std::uint64_t drawables = 0;
  std::uint64_t triangles = 0;  // including lines and points
};

struct ExplainedTexture {
  std::string image;                 // its name, or the location of its bytes
  std::vector<std::string> roles;    // "base-color", "metallic-roughness", "normal", "occlusion", "emission"
  ImageHeader file;                  // the header of the encoded image
  std::optional<TextureStats> kept;  // the stored texture; none: nothing visible reads it, or decoding failed
};

struct ExplainedLights {
  int directional = 0, point = 0, spot = 0;
};

// The cost of one feature: the difference between frames with it and frames without it. It may be negative: a surface
// that does not blend, for example, hides what is behind it.
struct FeatureCost {
  std::string feature;  // a word of --without, or "multisampling", "background", "planes", "anisotropy"
  std::string option;   // the option that disables it: "--without skins"
  int pairs = 0;        // number of pairs of steady frames, alternately with and without it
  // Seconds of a steady frame: the median of the pairs' differences, and their quartiles. If the quartiles differ in
  // sign, the cost is lost in the noise.
  double seconds = 0, seconds_low = 0, seconds_high = 0;
  double first_seconds = 0;  // in the first frame: pose, decoding of textures, environment
  std::int64_t bytes = 0;    // of memory that lasts from frame to frame: textures, environment, copies of geometry
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
  RenderStats first;              // of the first frame; `disabled` says what is disabled and why
  RenderStats steady;             // of a later frame with the same settings
  int frames = 0;
  double steady_seconds = 0;  // median over `frames`
  std::vector<FeatureCost> costs;
};

// Renders the scene repeatedly, at least some ten frames for each feature that it uses. Does not call
// `settings.progress`. Throws what Render() throws.
Explanation Explain(const Scene& scene, const RenderSettings& settings);

// As tables for people. `scene`: the name to print.
std::string ToText(const Explanation& explanation, const std::string& scene);
// The same as one JSON object with stable keys; times in seconds.
std::string ToJson(const Explanation& explanation, const std::string& scene);

}  // namespace facet
