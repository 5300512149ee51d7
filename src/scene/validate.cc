#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <sstream>
#include <string>
#include <type_traits>

#include "facet/error.h"
#include "facet/scene.h"
#include "material/model_parameters.h"
#include "material/models/models.h"
#include "material/parameters.h"

namespace facet {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::string At(const char* list, std::size_t index) { return std::string(list) + " " + std::to_string(index); }

// A thing of a list, and what it is a part of; text only when something is wrong with it.
struct Where {
  const char* list;
  std::size_t index;
  const Where* whole = nullptr;

  std::string Text() const { return (whole != nullptr ? whole->Text() + ", " : "") + At(list, index); }
};

[[noreturn]] void Fail(const std::string& where, const std::string& what) {
  throw Error(ErrorCode::InvalidInput, what, where);
}
[[noreturn]] void Fail(const Where& where, const std::string& what) { Fail(where.Text(), what); }

std::string Text(double number) {
  std::ostringstream text;
  text << number;
  return text.str();
}

// --- Numbers --------------------------------------------------------------------------------------------------------

// Passes without branches: there may be millions.
bool AllFinite(const float* numbers, std::size_t count) {
  constexpr std::uint32_t kExponent = 0x7F800000u;
  std::uint32_t broken = 0;
  for (std::size_t i = 0; i < count; ++i) {
    broken |= std::uint32_t{(std::bit_cast<std::uint32_t>(numbers[i]) & kExponent) == kExponent};
  }
  return broken == 0;
}
bool AllFinite(const double* numbers, std::size_t count) {
  double zero = 0.0;
  for (std::size_t i = 0; i < count; ++i) zero += numbers[i] * 0.0;
  return zero == 0.0;
}

template <class Number>
void CheckFinite(const Number* numbers, std::size_t count, const Where& where, const char* what) {
  if (!AllFinite(numbers, count)) Fail(where, std::string(what) + " is not finite");
}
template <int kLength, class Number>
void CheckFinite(const glm::vec<kLength, Number>& vector, const Where& where, const char* what) {
  CheckFinite(&vector[0], kLength, where, what);
}

// NaN is in no range. The ends may be infinite, and are not within then.
void CheckRange(double number, double low, double high, const Where& where, const char* what) {
  if (number >= low && number <= high && std::isfinite(number)) return;
  Fail(where, std::string(what) + " " + Text(number) +
                  (high < kInfinity   ? " is not in [" + Text(low) + ", " + Text(high) + "]"
                   : low > -kInfinity ? " is not a finite number of " + Text(low) + " or more"
                                      : " is not finite"));
}
template <int kLength>
void CheckRange(const glm::vec<kLength, float>& vector, double low, double high, const Where& where, const char* what) {
  for (int i = 0; i < kLength; ++i) CheckRange(vector[i], low, high, where, what);
}

// One of an enumeration's values; `last` is the largest.
template <class Enum>
void CheckEnum(Enum value, Enum last, const Where& where, const char* what) {
  if (value > last) Fail(where, std::string(what) + " " + std::to_string(int(value)) + " is unknown");
}

// --- Indices and sizes ----------------------------------------------------------------------------------------------

// `index` names one of `count` things, or none where that is allowed.
void CheckIndex(int index, std::size_t count, bool none_allowed, const Where& where, const char* what) {
  if (index == -1 && none_allowed) return;
  if (index < 0 || std::size_t(index) >= count) {
    Fail(where, std::string(what) + " " + std::to_string(index) + " is not one of " + std::to_string(count));
  }
}

void CheckSize(std::size_t size, std::size_t expected, bool empty_allowed, const Where& where, const char* what) {
  if (size == expected || (empty_allowed && size == 0)) return;
  Fail(where, std::string(what) + " has " + std::to_string(size) + " entries instead of " + std::to_string(expected));
}

// --- The parts of a scene -------------------------------------------------------------------------------------------

void CheckTexture(const Texture& texture, const Scene& scene, const Where& where) {
  CheckIndex(texture.image, scene.images.size(), true, where, "image");
  CheckEnum(texture.sampler.wrap_u, Wrap::ClampToEdge, where, "wrap_u");
  CheckEnum(texture.sampler.wrap_v, Wrap::ClampToEdge, where, "wrap_v");
  CheckEnum(texture.sampler.magnification, Filter::Linear, where, "the magnification filter");
  CheckEnum(texture.sampler.minification, Filter::Linear, where, "the minification filter");
  CheckEnum(texture.sampler.mip, MipFilter::Linear, where, "the mip filter");
}

void CheckTextureRef(const TextureRef& ref, const Scene& scene, const Where& where, const char* what) {
  CheckIndex(ref.texture, scene.textures.size(), true, where, what);
  if (ref.tex_coord < 0) Fail(where, std::string(what) + " uses UV set " + std::to_string(ref.tex_coord));
  if (!AllFinite(&ref.offset.x, 2) || !AllFinite(&ref.scale.x, 2) || !std::isfinite(ref.rotation)) {
    Fail(where, std::string(what) + " has a transform that is not finite");
  }
}

template <class Value>
void CheckParameter(const Value& value, const Parameter<Value>& parameter, const Scene& scene, const Where& where) {
  if constexpr (std::is_same_v<Value, TextureRef>) {
    CheckTextureRef(value, scene, where, parameter.name);
  } else if constexpr (std::is_same_v<Value, AlphaMode>) {
    CheckEnum(value, AlphaMode::Blend, where, parameter.name);
  } else if constexpr (std::is_same_v<Value, ShadingModel>) {
    CheckEnum(value, kModels.back().model, where, parameter.name);
  } else if constexpr (!std::is_same_v<Value, bool>) {
    if constexpr (std::is_same_v<Value, float>) {
      if (value == parameter.range.exception) return;
    }
    CheckRange(value, parameter.range.low, parameter.range.high, where, parameter.name);
  }
}

template <class Value>
void CheckModelParameter(const Value& value, const RowOptions& options, const char* name, const Scene& scene,
                         const Where& where) {
  if constexpr (requires { value.texture; }) {
    CheckTextureRef(value.texture, scene, where, name);
    CheckModelParameter(value.value, options, name, scene, where);
    if constexpr (requires { value.scale; }) CheckRange(value.scale, kAnyNumber.low, kAnyNumber.high, where, name);
    if constexpr (requires { value.channel; }) {
      if (value.channel < 0 || value.channel > 3) Fail(where, std::string(name) + " names no channel");
    }
  } else if constexpr (std::is_enum_v<Value>) {
    if (std::size_t(value) >= options.words.size()) Fail(where, std::string(name) + " is no value of its enumeration");
  } else if constexpr (!std::is_same_v<Value, bool>) {
    if (value == Value(options.range.exception)) return;
    CheckRange(value, options.range.low, options.range.high, where, name);
  }
}

void CheckMaterial(const Material& material, const Scene& scene, const Where& where) {
  CheckEnum(material.model, kModels.back().model, where, "shading model");
  const bool has_own = HasParameters(material.model);
  if (has_own != (material.parameters != nullptr) || (has_own && material.model != ModelOf(*material.parameters))) {
    Fail(where, "its parameters are not those of its shading model");
  }
  if (has_own) {
    // Defaults are valid, infinite ones too.
    ForEachStatedParameter(*material.parameters, [&](const auto& parameter, const auto& value) {
      CheckModelParameter(value, parameter, parameter.name, scene, where);
    });
  }
  ForEachParameter([&](const auto& parameter) {
    if (!parameter.alternative) CheckParameter(material.*parameter.member, parameter, scene, where);
  });
}

void CheckTarget(const MorphTarget& target, std::size_t count, const Where& where) {
  CheckSize(target.positions.size(), count, true, where, "positions");
  CheckSize(target.normals.size(), count, true, where, "normals");
  CheckSize(target.tangents.size(), count, true, where, "tangents");
  for (const auto& set : target.tex_coords) CheckSize(set.size(), count, true, where, "a UV set");
  CheckSize(target.colors.size(), count, true, where, "colours");
}

void CheckIndices(const Primitive& primitive, const Where& where) {
  const std::size_t count = primitive.indices.size();
  std::uint32_t largest = 0;  // one pass without branches: there are millions
  for (const std::uint32_t index : primitive.indices) largest = index > largest ? index : largest;
  if (count != 0 && largest >= primitive.positions.size()) {
    Fail(where, "index " + std::to_string(largest) + " is not one of " + std::to_string(primitive.positions.size()) +
                    " vertices");
  }
  const std::size_t each = primitive.topology == Topology::Triangles ? 3
                           : primitive.topology == Topology::Lines   ? 2
                                                                     : 1;
  if (count % each != 0) {
    Fail(where, std::to_string(count) + " indices are no multiple of " + std::to_string(each));
  }
}

void CheckPrimitive(const Primitive& primitive, const Scene& scene, const Where& where) {
  CheckEnum(primitive.topology, Topology::TriangleFan, where, "topology");
  const std::size_t count = primitive.positions.size();
  constexpr std::size_t kMost = std::numeric_limits<std::uint32_t>::max();
  if (count > kMost || primitive.indices.size() > kMost) {
    Fail(where, "more than " + std::to_string(kMost) + " vertices or indices");
  }
  CheckSize(primitive.normals.size(), count, true, where, "normals");
  CheckSize(primitive.tangents.size(), count, true, where, "tangents");
  for (const auto& set : primitive.tex_coords) CheckSize(set.size(), count, true, where, "a UV set");
  CheckSize(primitive.colors.size(), count, true, where, "colours");
  CheckSize(primitive.weights.size(), primitive.joints.size(), false, where, "the list of weight sets");
  for (const auto& set : primitive.joints) CheckSize(set.size(), count, false, where, "a set of joints");
  for (const auto& set : primitive.weights) CheckSize(set.size(), count, false, where, "a set of weights");
  CheckIndices(primitive, where);
  for (std::size_t i = 0; i < primitive.targets.size(); ++i)
    CheckTarget(primitive.targets[i], count, {"target", i, &where});
  CheckIndex(primitive.material, scene.materials.size(), true, where, "material");
  CheckSize(primitive.variant_materials.size(), scene.variants.size(), true, where, "the variants' materials");
  for (const int material : primitive.variant_materials) {
    CheckIndex(material, scene.materials.size(), true, where, "variant material");
  }
}

void CheckMesh(const Mesh& mesh, const Scene& scene, const Where& where) {
  for (std::size_t i = 0; i < mesh.primitives.size(); ++i) {
    CheckPrimitive(mesh.primitives[i], scene, {"primitive", i, &where});
  }
  CheckFinite(mesh.weights.data(), mesh.weights.size(), where, "a morph weight");
}

void CheckSkin(const Skin& skin, const Scene& scene, const Where& where) {
  for (const int joint : skin.joints) CheckIndex(joint, scene.nodes.size(), false, where, "joint");
  CheckSize(skin.inverse_bind.size(), skin.joints.size(), true, where, "the list of inverse bind matrices");
  for (const glm::mat4& matrix : skin.inverse_bind) CheckFinite(&matrix[0][0], 16, where, "an inverse bind matrix");
}

void CheckCamera(const Camera& camera, const Where& where) {
  if (camera.orthographic) {
    const bool fine = std::isfinite(camera.xmag) && std::isfinite(camera.ymag) && camera.xmag != 0 && camera.ymag != 0;
    if (!fine) Fail(where, "xmag and ymag must be finite and not zero");
    if (!(camera.znear >= 0)) Fail(where, "znear must not be negative");
  } else {
    if (!(camera.yfov > 0 && camera.yfov < 3.14159265358979)) Fail(where, "yfov must lie between 0 and pi");
    if (camera.aspect && !(*camera.aspect > 0 && std::isfinite(*camera.aspect))) {
      Fail(where, "the aspect ratio must be positive");
    }
    if (!(camera.znear > 0)) Fail(where, "znear must be positive");
  }
  if (!(camera.zfar > camera.znear)) Fail(where, "zfar must be larger than znear");
}

void CheckLight(const Light& light, const Where& where) {
  constexpr double kPi = 3.14159274f;  // the float next to it
  CheckEnum(light.type, LightType::Spot, where, "type");
  CheckRange(light.color, 0.0, kInfinity, where, "colour");
  CheckRange(light.intensity, 0.0, kInfinity, where, "intensity");
  if (!(light.range > 0.0f)) Fail(where, "range " + Text(light.range) + " is not positive");
  CheckRange(light.outer_cone_angle, 0.0, kPi, where, "outer cone angle");
  CheckRange(light.inner_cone_angle, 0.0, light.outer_cone_angle, where, "inner cone angle");
}

void CheckTransform(const Transform& transform, const Where& where) {
  CheckFinite(transform.translation, where, "the translation");
  CheckFinite(transform.scale, where, "the scale");
  const double squared = glm::dot(transform.rotation, transform.rotation);
  if (!(squared > 0.0 && squared < kInfinity)) Fail(where, "the rotation has no direction");
}

void CheckMatrix(const glm::dmat4& matrix, const Where& where) {
  CheckFinite(&matrix[0][0], 16, where, "the matrix");
  constexpr double kTolerance = 1e-6;  // an inverse that was computed may be as far off
  for (int c = 0; c < 4; ++c) {
    if (std::fabs(matrix[c][3] - (c == 3 ? 1.0 : 0.0)) > kTolerance) {
      Fail(where, "the matrix is not affine: its last row is not 0, 0, 0, 1");
    }
  }
}

void CheckNode(const Node& node, const Scene& scene, const Where& where) {
  CheckIndex(node.mesh, scene.meshes.size(), true, where, "mesh");
  CheckIndex(node.skin, scene.skins.size(), true, where, "skin");
  CheckIndex(node.camera, scene.cameras.size(), true, where, "camera");
  CheckIndex(node.light, scene.lights.size(), true, where, "light");
  CheckTransform(node.transform, where);
  if (node.matrix) CheckMatrix(*node.matrix, where);
  CheckFinite(node.weights.data(), node.weights.size(), where, "a morph weight");
  for (std::size_t i = 0; i < node.instances.size(); ++i) CheckTransform(node.instances[i], {"instance", i, &where});
}

void CheckNodes(const Scene& scene) {
  const std::size_t count = scene.nodes.size();
  std::vector<int> parents(count, -1);
  for (std::size_t i = 0; i < count; ++i) {
    const Where where{"node", i};
    CheckNode(scene.nodes[i], scene, where);
    for (const int child : scene.nodes[i].children) {
      CheckIndex(child, count, false, where, "child");
      if (parents[std::size_t(child)] >= 0) {
        Fail(where, "node " + std::to_string(child) + " is already a child of node " +
                        std::to_string(parents[std::size_t(child)]));
      }
      parents[std::size_t(child)] = int(i);
    }
  }
  // With one parent at most, whatever a walk from the roots does not reach lies on a cycle or hangs from one.
  std::vector<int> open;
  std::vector<bool> reached(count, false);
  for (std::size_t i = 0; i < count; ++i) {
    if (parents[i] < 0) open.push_back(int(i));
  }
  while (!open.empty()) {
    const std::size_t node = std::size_t(open.back());
    open.pop_back();
    reached[node] = true;
    for (const int child : scene.nodes[node].children) open.push_back(child);
  }
  for (std::size_t i = 0; i < count; ++i) {
    if (!reached[i]) Fail(Where{"node", i}, "the node is its own ancestor, or descends from one that is");
  }
}

void CheckChannel(const AnimationChannel& channel, const Scene& scene, const Where& where) {
  CheckIndex(channel.node, scene.nodes.size(), true, where, "node");
  for (std::size_t i = 0; i < channel.times.size(); ++i) {
    if (!std::isfinite(channel.times[i])) Fail(where, At("time", i) + " is not finite");
    if (i > 0 && !(channel.times[i] >= channel.times[i - 1])) Fail(where, At("time", i) + " decreases");
  }
  const std::size_t keys = channel.times.size() * (channel.interpolation == Interpolation::CubicSpline ? 3 : 1);
  if (channel.path == AnimationPath::Weights) {
    const bool fits = keys == 0 ? channel.values.empty() : channel.values.size() % keys == 0;
    if (!fits) Fail(where, std::to_string(channel.values.size()) + " weights do not divide by the number of keys");
  } else {
    CheckSize(channel.values.size(), keys * (channel.path == AnimationPath::Rotation ? 4 : 3), false, where, "values");
  }
  CheckFinite(channel.values.data(), channel.values.size(), where, "a value");
  CheckEnum(channel.path, AnimationPath::Weights, where, "path");
  CheckEnum(channel.interpolation, Interpolation::CubicSpline, where, "interpolation");
}

}  // namespace

void ValidateScene(const Scene& scene) {
  for (std::size_t i = 0; i < scene.images.size(); ++i) {
    if (scene.images[i].source == nullptr) Fail(Where{"image", i}, "it has no source");
  }
  for (std::size_t i = 0; i < scene.textures.size(); ++i) CheckTexture(scene.textures[i], scene, {"texture", i});
  for (std::size_t i = 0; i < scene.materials.size(); ++i) CheckMaterial(scene.materials[i], scene, {"material", i});
  for (std::size_t i = 0; i < scene.meshes.size(); ++i) CheckMesh(scene.meshes[i], scene, {"mesh", i});
  for (std::size_t i = 0; i < scene.skins.size(); ++i) CheckSkin(scene.skins[i], scene, {"skin", i});
  for (std::size_t i = 0; i < scene.cameras.size(); ++i) CheckCamera(scene.cameras[i], {"camera", i});
  for (std::size_t i = 0; i < scene.lights.size(); ++i) CheckLight(scene.lights[i], {"light", i});
  CheckNodes(scene);
  for (std::size_t i = 0; i < scene.animations.size(); ++i) {
    const Where where{"animation", i};
    for (std::size_t j = 0; j < scene.animations[i].channels.size(); ++j) {
      CheckChannel(scene.animations[i].channels[j], scene, {"channel", j, &where});
    }
  }
  for (std::size_t i = 0; i < scene.scenes.size(); ++i) {
    for (const int node : scene.scenes[i].nodes) {
      CheckIndex(node, scene.nodes.size(), false, Where{"scene", i}, "node");
    }
  }
  const int last = int(scene.scenes.size()) - 1;
  if (scene.default_scene < -1 || scene.default_scene > last) {
    Fail("the scene", "default scene " + std::to_string(scene.default_scene) + " is not one of " +
                          std::to_string(scene.scenes.size()));
  }
}

}  // namespace facet
