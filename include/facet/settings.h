// What a picture is made with: camera, light, approximations, and what is disabled.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <initializer_list>
#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "facet/image.h"
#include "facet/planes.h"
#include "facet/scene.h"

namespace facet {

class FragmentShader;     // facet/shader.h
class EnvironmentSource;  // OpenEnvironment() of facet/load.h makes one

// --- Camera ----------------------------------------------------------------------------------------------------------

// Frames the scene's bounds from the front, a little above.
struct AutoCamera {
  std::optional<double> yfov;  // radians; 45 degrees if none
};

// eye = target + radius * (sin phi * sin theta, cos phi, sin phi * cos theta), +Y up.
struct OrbitCamera {
  double theta = 0.0, phi = 1.5707963267948966;  // radians
  // None, or not positive: the distance that shows the whole scene from every side, and at every moment of the
  // animation, so that turntables neither swell nor shrink.
  std::optional<double> radius;
  std::optional<glm::dvec3> target;  // none: the centre of the bounds (without a radius, of all those moments)
  std::optional<double> yfov;        // radians; 45 degrees if none
};

// A camera of the scene, by index into Scene::cameras, placed by the first node of the scene that holds it.
struct SceneCamera {
  int camera = 0;
};

// Any other.
struct FreeCamera {
  glm::dmat4 world_from_camera{1.0};  // looks along -Z, +Y up; rigid
  Camera lens;
};

using CameraChoice = std::variant<AutoCamera, OrbitCamera, SceneCamera, FreeCamera>;

// --- Light -----------------------------------------------------------------------------------------------------------

// Light from all around. The picture is equirectangular: its centre column lies towards +X, +Z is a quarter further to
// the right (docs/conventions.md).
struct EnvironmentSettings {
  enum class Kind : std::uint8_t { Studio, None, Image };
  Kind kind = Kind::Studio;
  std::shared_ptr<const Image> image;  // Kind::Image: any type; 32768 pixels a side and 2^28 in all at most
  std::shared_ptr<const EnvironmentSource> source;  // Kind::Image where `image` is null: a file
  double rotation = 0.0;                            // radians about +Y, counter-clockwise seen from above
  double intensity = 1.0;
};

enum class Background : std::uint8_t { Transparent, Environment };

// --- Approximations --------------------------------------------------------------------------------------------------

// How textures are kept. Mixed: colour as 16 bits of linear light a channel, all else as the file's 8 (or 16) bits.
enum class TexelBits : std::uint8_t { Mixed, Eight, Sixteen };

// How the light that a diffuse surface gathers is integrated over the environment. SphericalHarmonics: nine
// coefficients (Ramamoorthi and Hanrahan, 2001, An Efficient Representation for Irradiance Environment Maps).
enum class IrradianceMethod : std::uint8_t { Convolution, SphericalHarmonics };

// Whose tangents normal maps are read with. Generated: MikkTSpace's, also where the file has some.
enum class TangentSource : std::uint8_t { File, Generated };

// --- Leaving out -----------------------------------------------------------------------------------------------------

// What a scene may have and a picture can do without. Bits of a mask.
enum class Feature : std::uint32_t {
  BaseColorTexture = 1u << 0,
  MetallicRoughnessTexture = 1u << 1,
  NormalTexture = 1u << 2,
  Occlusion = 1u << 3,  // the texture
  Emission = 1u << 4,   // factor and texture
  VertexColors = 1u << 5,
  EnvironmentLight = 1u << 6,  // the background stays
  PunctualLights = 1u << 7,
  AlphaTest = 1u << 8,  // MASK is drawn as OPAQUE
  Blending = 1u << 9,   // BLEND is drawn as OPAQUE
  Skins = 1u << 10,     // meshes stand where their nodes do
  MorphTargets = 1u << 11,
};
inline constexpr int kFeatureCount = 12;

class FeatureSet {
 public:
  constexpr FeatureSet() = default;
  constexpr FeatureSet(std::initializer_list<Feature> features) {
    for (const Feature feature : features) Add(feature);
  }
  constexpr bool Has(Feature feature) const { return (bits_ & static_cast<std::uint32_t>(feature)) != 0; }
  constexpr void Add(Feature feature) { bits_ |= static_cast<std::uint32_t>(feature); }
  constexpr bool operator==(const FeatureSet&) const = default;

 private:
  std::uint32_t bits_ = 0;
};

// --- Settings --------------------------------------------------------------------------------------------------------

struct RenderSettings {
  int width = 1024;                          // 1 to 16384
  int height = 1024;                         // 1 to 16384
  int samples = 4;                           // coverage samples per pixel: 1, 2, 4 or 8
  int threads = 0;                           // 0: one per core; at most 1024
  int max_anisotropy = 8;                    // 1 to 16
  MipFilter mip_filter = MipFilter::Linear;  // the most that samplers get
  TexelBits texels = TexelBits::Mixed;
  int environment_size = 1024;   // most texels along the environment's sharpest map: 64 to 1024, a power of two (the
                                 // studio never needs more than 128)
  int environment_samples = 24;  // of the narrowest lobe it is filtered with, wider ones take more: 6 to 768
  IrradianceMethod irradiance = IrradianceMethod::Convolution;
  TangentSource tangents = TangentSource::File;
  int tile_size = 32;  // 8, 16, 32 or 64: never changes the picture
  // Bytes that the frame may take with all that grows with the scene or the picture: the scene itself, posed copies,
  // lists of triangles, textures and what is decoded for them, the environment, the film. What needs more is refused
  // before it is allocated, with Error(OutOfMemory). 0: three quarters of what the machine, or the process's control
  // group, has.
  std::uint64_t memory_limit = 0;
  int scene = -1;      // -1: the default one
  int animation = -1;  // -1: rest pose
  double time = 0.0;   // seconds
  int variant = -1;    // -1: none
  CameraChoice camera = AutoCamera{};
  EnvironmentSettings environment;
  Background background = Background::Transparent;
  std::vector<PlaneKind> planes;  // that the film has besides colour, each once; colour is the same with and without
  // Left out although the scene has them: the picture is the one of the same scene built without them, bit for bit.
  FeatureSet without;
  // False: the frame does what the scene does not need as well, as far as that changes no bit of the picture, to show
  // just that (docs/explain.md says what). Slow, and of no other use.
  bool omit_unused = true;
  // Replaces the shading model of every material; null: the materials' own. Not owned.
  const FragmentShader* shader = nullptr;
  // The same for single materials, by index of Scene::materials; null, or beyond the end: `shader`. Not owned.
  std::vector<const FragmentShader*> material_shaders;
  // Whether some shader is a user's.
  bool HasShaders() const {
    const auto given = [](const FragmentShader* s) { return s != nullptr; };
    return given(shader) || std::any_of(material_shaders.begin(), material_shaders.end(), given);
  }
  // Called now and then from one of the worker threads with the share that is done, in [0, 1]. May be empty.
  std::function<void(double)> progress;
};

}  // namespace facet
