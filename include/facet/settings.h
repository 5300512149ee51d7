// What an image is rendered with: camera, light, approximations, and disabled features.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string_view>
#include <variant>
#include <vector>

#include "facet/image.h"
#include "facet/planes.h"
#include "facet/scene.h"

namespace facet {

class FragmentShader;     // facet/shader.h
class EnvironmentSource;  // OpenEnvironment() of facet/load.h makes one

// --- Camera ---------------------------------------------------------------------------------------------------------

// Frames the scene's bounds from the front, a little above.
struct AutoCamera {
  std::optional<double> yfov;  // radians; 45 degrees if none
};

// eye = target + radius * (sin phi * sin theta, cos phi, sin phi * cos theta), +Y up.
struct OrbitCamera {
  double theta = 0.0, phi = 1.5707963267948966;  // radians
  // None, or not positive: a distance from which the whole scene is visible from every side and at every moment of the
  // animation, so that the size of things does not change during a turntable.
  std::optional<double> radius;
  std::optional<glm::dvec3> target;  // none: the centre of the bounds (if there is no radius, over the whole animation)
  std::optional<double> yfov;        // radians; 45 degrees if none
};

// A camera of the scene, by index into Scene::cameras, placed by the first node of the scene that holds it.
struct SceneCamera {
  int camera = 0;
};

// Any other camera, by its pose and lens.
struct FreeCamera {
  glm::dmat4 world_from_camera{1.0};  // a rigid transform; the camera looks along -Z, +Y is up
  Camera lens;
};

using CameraChoice = std::variant<AutoCamera, OrbitCamera, SceneCamera, FreeCamera>;

// --- Light ----------------------------------------------------------------------------------------------------------

// Image-based lighting. The image is equirectangular: its centre column lies towards +X, and +Z is a quarter of the
// width to the right of it (docs/conventions.md).
struct EnvironmentSettings {
  enum class Kind : std::uint8_t { Studio, None, Image };
  Kind kind = Kind::Studio;
  std::shared_ptr<const Image> image;  // Kind::Image: of any type, at most 32768 pixels a side and 2^28 in all
  std::shared_ptr<const EnvironmentSource> source;  // Kind::Image, used if `image` is null: a file
  double rotation = 0.0;                            // radians about +Y, counter-clockwise seen from above
  double intensity = 1.0;
};

enum class Background : std::uint8_t { Transparent, Environment };

// --- Approximations -------------------------------------------------------------------------------------------------

// Precision of stored textures. Mixed: colours have 16 bits of linear light per channel, other data the 8 (or 16) bits
// of the file.
enum class TexelBits : std::uint8_t { Mixed, Eight, Sixteen };

// How the diffuse irradiance of the environment is computed. Convolution: an integral for each direction.
// SphericalHarmonics: nine coefficients (Ramamoorthi and Hanrahan, 2001, An Efficient Representation for Irradiance
// Environment Maps).
enum class IrradianceMethod : std::uint8_t { Convolution, SphericalHarmonics };

// Which tangents normal maps use. File: those of the file where it has some, else generated ones. Generated: always
// those that MikkTSpace generates.
enum class TangentSource : std::uint8_t { File, Generated };

// --- Features -------------------------------------------------------------------------------------------------------

// Features of a scene that can be disabled. Bits of a mask.
enum class Feature : std::uint32_t {
  BaseColorTexture = 1u << 0,
  MetallicRoughnessTexture = 1u << 1,
  NormalTexture = 1u << 2,
  Occlusion = 1u << 3,  // the texture
  Emission = 1u << 4,   // factor and texture
  VertexColors = 1u << 5,
  EnvironmentLight = 1u << 6,  // not the background
  PunctualLights = 1u << 7,
  AlphaTest = 1u << 8,  // disabled: MASK is drawn as OPAQUE
  Blending = 1u << 9,   // disabled: BLEND is drawn as OPAQUE
  Skins = 1u << 10,     // disabled: meshes are placed by their nodes
  MorphTargets = 1u << 11,
  // Layers and lobes of materials, with their textures.
  Clearcoat = 1u << 12,
  Sheen = 1u << 13,
  Specular = 1u << 14,  // the factor and colour of KHR_materials_specular
  Ior = 1u << 15,       // disabled: an index of refraction of 1.5
  Transmission = 1u << 16,
  Volume = 1u << 17,  // disabled: walls are thin
  Dispersion = 1u << 18,
  DiffuseTransmission = 1u << 19,
  Iridescence = 1u << 20,
  Anisotropy = 1u << 21,
  SpecularGlossinessTexture = 1u << 22,
};

// The words for features in the option "without" and in the output of `facet explain`, in the order of the bits.
struct FeatureWord {
  Feature feature;
  std::string_view word;
};
inline constexpr auto kFeatureWords = std::to_array<FeatureWord>({
    {Feature::BaseColorTexture, "base-color-texture"},
    {Feature::MetallicRoughnessTexture, "metallic-roughness-texture"},
    {Feature::NormalTexture, "normal-texture"},
    {Feature::Occlusion, "occlusion"},
    {Feature::Emission, "emission"},
    {Feature::VertexColors, "vertex-colors"},
    {Feature::EnvironmentLight, "environment-light"},
    {Feature::PunctualLights, "punctual-lights"},
    {Feature::AlphaTest, "alpha-test"},
    {Feature::Blending, "blending"},
    {Feature::Skins, "skins"},
    {Feature::MorphTargets, "morph-targets"},
    {Feature::Clearcoat, "clearcoat"},
    {Feature::Sheen, "sheen"},
    {Feature::Specular, "specular"},
    {Feature::Ior, "ior"},
    {Feature::Transmission, "transmission"},
    {Feature::Volume, "volume"},
    {Feature::Dispersion, "dispersion"},
    {Feature::DiffuseTransmission, "diffuse-transmission"},
    {Feature::Iridescence, "iridescence"},
    {Feature::Anisotropy, "anisotropy"},
    {Feature::SpecularGlossinessTexture, "specular-glossiness-texture"},
});
inline constexpr int kFeatureCount = kFeatureWords.size();
static_assert(std::ranges::all_of(kFeatureWords,
                                  [](const FeatureWord& known) {
                                    return known.feature == Feature{1u << (&known - kFeatureWords.data())};
                                  }),
              "a row for each bit, in their order");

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

// --- Settings -------------------------------------------------------------------------------------------------------

struct RenderSettings {
  int width = 1024;                          // 1 to 16384
  int height = 1024;                         // 1 to 16384
  int samples = 4;                           // coverage samples per pixel: 1, 2, 4 or 8
  int threads = 0;                           // 0: one per core; at most 1024
  int max_anisotropy = 8;                    // 1 to 16
  MipFilter mip_filter = MipFilter::Linear;  // the best that samplers may use
  TexelBits texels = TexelBits::Mixed;
  int environment_size = 1024;   // largest side of the environment's sharpest map, in texels: a power of two, 64 to
                                 // 1024 (the studio never needs more than 128)
  int environment_samples = 24;  // samples of the narrowest lobe that it is prefiltered with (wider lobes take more): 6
                                 // to 768
  IrradianceMethod irradiance = IrradianceMethod::Convolution;
  TangentSource tangents = TangentSource::File;
  // Whether specular lobes are widened where the normal turns within a pixel, so that small mirrors do not alias.
  bool specular_antialiasing = true;
  int tile_size = 32;  // pixels: 8, 16, 32 or 64; does not change the image
  // Limit, in bytes, of all memory that grows with the scene or the image: the scene itself, posed copies, lists of
  // triangles, textures and the images they are decoded from, the environment, the film. A frame that needs more is
  // refused with Error(OutOfMemory) before the memory is allocated. 0: three quarters of the memory of the machine, or
  // of the process's control group.
  std::uint64_t memory_limit = 0;
  int scene = -1;      // -1: the default one
  int animation = -1;  // -1: rest pose
  double time = 0.0;   // seconds
  int variant = -1;    // -1: none
  CameraChoice camera = AutoCamera{};
  EnvironmentSettings environment;
  Background background = Background::Transparent;
  std::vector<PlaneKind> planes;  // that the film has besides colour, each once; they do not change colour
  // Features that are disabled although the scene has them: the image equals, bit for bit, that of the same scene built
  // without them.
  FeatureSet without;
  // False: features that the scene does not need are computed as well, where that must not change the image, in order
  // to show that it does not (docs/explain.md lists them). Slow, and of no other use.
  bool omit_unused = true;
  // Replaces the shading model of every material; null: the materials' own. Not owned.
  const FragmentShader* shader = nullptr;
  // The same for single materials, by index of Scene::materials; null, or beyond the end: `shader`. Not owned.
  std::vector<const FragmentShader*> material_shaders;
  // Whether a user's shader is set.
  bool HasShaders() const {
    const auto given = [](const FragmentShader* s) { return s != nullptr; };
    return given(shader) || std::any_of(material_shaders.begin(), material_shaders.end(), given);
  }
  // Called now and then from one of the worker threads with the share of the work that is done, in [0, 1]. May be
  // empty.
  std::function<void(double)> progress;
};

}  // namespace facet
