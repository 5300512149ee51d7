// A scene as a file states it: plain values, glTF 2.0's terms and defaults. Lengths are metres, angles radians,
// time seconds; right-handed, +Y up; colours linear Rec. 709. An index of -1 means "none".
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "facet/digest.h"
#include "facet/image.h"

namespace facet {

// --- Textures ------------------------------------------------------------------------------------------------------

enum class Wrap : std::uint8_t { Repeat, MirroredRepeat, ClampToEdge };
enum class Filter : std::uint8_t { Nearest, Linear };
enum class MipFilter : std::uint8_t { None, Nearest, Linear };

// How a texture is read between texels and between mip levels. The defaults are what glTF leaves to the renderer.
struct Sampler {
  Wrap wrap_u = Wrap::Repeat;
  Wrap wrap_v = Wrap::Repeat;
  Filter magnification = Filter::Linear;
  Filter minification = Filter::Linear;
  MipFilter mip = MipFilter::Linear;
};

struct SceneImage {
  std::string name;
  std::shared_ptr<const ImageSource> source;  // never null
};

struct Texture {
  std::string name;
  int image = -1;  // -1: no image that facet can read; sampled as opaque white
  Sampler sampler;
};

// A use of a texture. uv' = offset + R(rotation) * (scale * uv), KHR_texture_transform.
struct TextureRef {
  int texture = -1;
  int tex_coord = 0;  // the UV set: TEXCOORD_n
  glm::vec2 offset{0.0f};
  glm::vec2 scale{1.0f};
  float rotation = 0.0f;  // radians, counter-clockwise in UV space with v down, as the extension defines it
  explicit operator bool() const { return texture >= 0; }
  bool operator==(const TextureRef&) const = default;
};

// --- Materials -----------------------------------------------------------------------------------------------------

enum class AlphaMode : std::uint8_t { Opaque, Mask, Blend };

// How a material turns its parameters into reflection. SpecularGlossiness (KHR_materials_pbrSpecularGlossiness) states
// diffuse and specular colours instead of metalness. Unlit (KHR_materials_unlit) shows its base colour as it is. The
// others have parameters of their own (facet/models.h).
enum class ShadingModel : std::uint8_t { MetallicRoughness, SpecularGlossiness, Unlit, Lecture, Filament, Enterprise };

struct ModelParameters;  // facet/models.h

struct Material {
  std::string name;
  glm::vec4 base_color_factor{1.0f};  // linear, straight alpha, [0, 1]
  TextureRef base_color_texture;      // sRGB
  float metallic_factor = 1.0f;       // [0, 1]
  float roughness_factor = 1.0f;      // perceptual roughness, [0, 1]
  TextureRef metallic_roughness_texture;  // G roughness, B metalness
  TextureRef normal_texture;              // tangent space, +Y up
  float normal_scale = 1.0f;              // of any sign
  TextureRef occlusion_texture;  // R
  float occlusion_strength = 1.0f;  // [0, 1]
  glm::vec3 emissive_factor{0.0f};  // linear, 0 or more
  TextureRef emissive_texture;      // sRGB
  float emissive_strength = 1.0f;   // KHR_materials_emissive_strength, 0 or more
  AlphaMode alpha_mode = AlphaMode::Opaque;
  float alpha_cutoff = 0.5f;  // 0 or more
  bool double_sided = false;
  ShadingModel model = ShadingModel::MetallicRoughness;

  // KHR_materials_clearcoat: a clear layer over everything else. It has its own normal, by default the interpolated
  // one.
  float clearcoat_factor = 0.0f;            // [0, 1]
  TextureRef clearcoat_texture;             // R
  float clearcoat_roughness_factor = 0.0f;  // perceptual, [0, 1]
  TextureRef clearcoat_roughness_texture;   // G
  TextureRef clearcoat_normal_texture;      // tangent space, +Y up
  float clearcoat_normal_scale = 1.0f;      // of any sign
  // KHR_materials_sheen: fibres over the base.
  glm::vec3 sheen_color_factor{0.0f};   // linear, [0, 1]
  TextureRef sheen_color_texture;       // sRGB
  float sheen_roughness_factor = 0.0f;  // perceptual, [0, 1]
  TextureRef sheen_roughness_texture;   // A
  // KHR_materials_specular: the reflection of the dielectric part.
  float specular_factor = 1.0f;           // [0, 1]
  TextureRef specular_texture;            // A
  glm::vec3 specular_color_factor{1.0f};  // linear, 0 or more; times F0 it is clamped to 1
  TextureRef specular_color_texture;      // sRGB
  float ior = 1.5f;                       // KHR_materials_ior: 1 or more, or 0 for a Fresnel term of 1
  // KHR_materials_transmission: light that passes through the surface.
  float transmission_factor = 0.0f;  // [0, 1]
  TextureRef transmission_texture;   // R
  // KHR_materials_volume: what is behind the surface. A thickness of 0 means a thin wall.
  float thickness_factor = 0.0f;  // of the volume, in units of the mesh, 0 or more
  TextureRef thickness_texture;   // G
  float attenuation_distance = std::numeric_limits<float>::infinity();  // metres, above 0
  glm::vec3 attenuation_color{1.0f};  // of white light after that distance, linear, [0, 1]
  float dispersion = 0.0f;            // KHR_materials_dispersion: 20 divided by the Abbe number, 0 or more
  // KHR_materials_diffuse_transmission: light from behind, scattered.
  float diffuse_transmission_factor = 0.0f;           // [0, 1]
  TextureRef diffuse_transmission_texture;            // A
  glm::vec3 diffuse_transmission_color_factor{1.0f};  // linear, [0, 1]
  TextureRef diffuse_transmission_color_texture;      // sRGB
  // KHR_materials_iridescence: a thin film on the base.
  float iridescence_factor = 0.0f;               // [0, 1]
  TextureRef iridescence_texture;                // R
  float iridescence_ior = 1.3f;                  // of the film, 1 or more
  float iridescence_thickness_minimum = 100.0f;  // nanometres, 0 or more: where the texture is 0
  float iridescence_thickness_maximum = 400.0f;  // likewise, where it is 1, or where there is none
  TextureRef iridescence_thickness_texture;      // G
  // KHR_materials_anisotropy: a base whose highlights are stretched.
  float anisotropy_strength = 0.0f;  // [0, 1]
  float anisotropy_rotation = 0.0f;  // radians from the tangent, counter-clockwise in tangent space
  TextureRef anisotropy_texture;     // RG direction, B strength
  // KHR_materials_pbrSpecularGlossiness. Its diffuse colour is the base colour above.
  glm::vec3 specular_glossiness_specular_factor{1.0f};  // linear, [0, 1]
  float glossiness_factor = 1.0f;                       // 1 - perceptual roughness, [0, 1]
  TextureRef specular_glossiness_texture;               // RGB specular, sRGB; A glossiness

  // Of the models that are not glTF's: those of `model`, and then all of the above but the name, the alpha mode, the
  // cutoff and double-sidedness is ignored. Null for glTF's models.
  std::shared_ptr<const ModelParameters> parameters;
};

// --- Geometry ------------------------------------------------------------------------------------------------------

enum class Topology : std::uint8_t { Points, Lines, LineLoop, LineStrip, Triangles, TriangleStrip, TriangleFan };

// Displacements of a morph target; an empty array means none. Sizes equal the primitive's.
struct MorphTarget {
  std::vector<glm::vec3> positions, normals, tangents;
  std::vector<std::vector<glm::vec2>> tex_coords;
  std::vector<glm::vec4> colors;
};

// Geometry with one material. Every non-empty attribute array has positions.size() entries. Attributes may have any
// value: vectors that are not finite or have no direction are replaced or ignored, see docs/conventions.md.
struct Primitive {
  Topology topology = Topology::Triangles;
  std::vector<glm::vec3> positions;  // mesh space
  std::vector<glm::vec3> normals;    // unit; empty: flat shading
  std::vector<glm::vec4> tangents;   // xyz unit, w = +-1 handedness; empty: generated if a normal map needs them
  std::vector<std::vector<glm::vec2>> tex_coords;
  std::vector<glm::vec4> colors;                   // linear RGBA, straight alpha
  std::vector<std::vector<glm::u16vec4>> joints;   // JOINTS_n: indices into Skin::joints
  std::vector<std::vector<glm::vec4>> weights;     // WEIGHTS_n
  // Each index is less than positions.size(); their number is a multiple of 3 for Triangles, of 2 for Lines. Empty: not
  // indexed, so vertices 0, 1, 2 ... are used, as far as they make whole triangles or lines.
  std::vector<std::uint32_t> indices;
  std::vector<MorphTarget> targets;
  int material = -1;                   // -1: glTF's default material
  std::vector<int> variant_materials;  // by index of Scene::variants; empty or -1: unchanged
};

struct Mesh {
  std::string name;
  std::vector<Primitive> primitives;
  std::vector<float> weights;  // default morph weights
};

struct Skin {
  std::string name;
  std::vector<int> joints;                   // nodes
  std::vector<glm::mat4> inverse_bind;       // empty: identities; otherwise joints.size()
};

// --- Nodes, cameras, lights -----------------------------------------------------------------------------------------

struct Camera {
  std::string name;
  bool orthographic = false;
  double yfov = 0.8;                       // perspective: vertical field of view, (0, pi)
  std::optional<double> aspect;            // perspective: width / height; none: the image's
  double xmag = 1.0, ymag = 1.0;           // orthographic: half extents
  double znear = 0.01;
  double zfar = std::numeric_limits<double>::infinity();
};

enum class LightType : std::uint8_t { Directional, Point, Spot };

// KHR_lights_punctual. Shines along the node's -Z.
struct Light {
  std::string name;
  LightType type = LightType::Point;
  glm::vec3 color{1.0f};                                 // linear, 0 or more
  float intensity = 1.0f;                                // lux for directional, candela for point and spot; 0 or more
  float range = std::numeric_limits<float>::infinity();  // positive; infinity: unlimited
  float inner_cone_angle = 0.0f;                         // from the axis, 0 to the outer one
  float outer_cone_angle = 0.7853981634f;                // 0 to pi
};

struct Transform {
  glm::dvec3 translation{0.0};
  glm::dquat rotation{1.0, 0.0, 0.0, 0.0};  // w, x, y, z; of any length but 0
  glm::dvec3 scale{1.0};
};

struct Node {
  std::string name;
  std::vector<int> children;
  Transform transform;
  std::optional<glm::dmat4> matrix;  // instead of `transform`, when the file gives one; affine
  int mesh = -1, skin = -1, camera = -1, light = -1;
  std::vector<float> weights;        // morph weights; empty: the mesh's
  bool visible = true;               // KHR_node_visibility; inherited; cameras are never hidden
  std::vector<Transform> instances;  // EXT_mesh_gpu_instancing; empty: the mesh once
};

// --- Animation ------------------------------------------------------------------------------------------------------

enum class AnimationPath : std::uint8_t { Translation, Rotation, Scale, Weights };
enum class Interpolation : std::uint8_t { Linear, Step, CubicSpline };

struct AnimationChannel {
  int node = -1;
  AnimationPath path = AnimationPath::Translation;
  Interpolation interpolation = Interpolation::Linear;
  // Seconds, never decreasing. Several keys at one time make a jump: the first of them ends the interval before, the
  // last begins the interval after.
  std::vector<float> times;
  // times.size() * width values, or three times as many for CubicSpline (in-tangent, value, out-tangent per key); width
  // is 3, 4 (x, y, z, w) or the number of morph targets.
  std::vector<float> values;
};

struct Animation {
  std::string name;
  std::vector<AnimationChannel> channels;
};

// --- The whole ------------------------------------------------------------------------------------------------------

struct SceneRoots {
  std::string name;
  std::vector<int> nodes;  // drawn with all descendants; their parents are ignored
};

// Every index is valid or -1, every parameter is finite and in the range given beside it, and the node hierarchy is a
// forest. Loaders guarantee this; ValidateScene() checks it.
struct Scene {
  std::vector<SceneImage> images;
  std::vector<Texture> textures;
  std::vector<Material> materials;
  std::vector<Mesh> meshes;
  std::vector<Skin> skins;
  std::vector<Camera> cameras;
  std::vector<Light> lights;
  std::vector<Node> nodes;
  std::vector<Animation> animations;
  std::vector<SceneRoots> scenes;
  int default_scene = -1;  // -1: scene 0 if there is one, else every node without a parent
  std::vector<std::string> variants;  // KHR_materials_variants
};

// Throws Error(InvalidInput) that names the first index, size, value or cycle that breaks the rules above. Render() and
// all other functions that draw or measure a scene call it.
void ValidateScene(const Scene& scene);

// Digests of the renderer's inputs. Where the images of two machines differ, they tell whether a decoder or the
// renderer is the cause. Names of objects do not count, since they do not change the image.
struct SceneDigests {
  Digest description;  // nodes, materials, samplers, cameras, lights, skins, animations, variants
  Digest geometry;     // attributes, indices and morph targets, as decoded
  Digest textures;     // the images, as decoded; one that cannot be decoded counts as an empty one
};

// Decodes every image of the scene, in parallel.
SceneDigests HashScene(const Scene& scene);

}  // namespace facet
