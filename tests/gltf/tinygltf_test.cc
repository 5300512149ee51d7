// Another reader's opinion: what tinygltf says of real files, and what facet says, are the same numbers. tinygltf hands
// out a file as it stands, so that this test states for itself what the elements of an accessor are, and nothing of
// facet's reader helps it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <glm/gtc/type_ptr.hpp>
#include <optional>
#include <set>

#include "gltf_files.h"
#include "tinygltf_values.h"

namespace facet {
namespace {

using testing::CorpusPath;
using testing::IsPlain;
using testing::ReadWithTinygltf;
using testing::Table;
using testing::ValuesOf;

// Floats of a list that glTF leaves out where it has the default.
template <class T>
std::vector<double> Or(const std::vector<double>& numbers, const T& otherwise) {
  return numbers.empty() ? std::vector<double>(otherwise) : numbers;
}

float Clamped(double number) { return static_cast<float>(std::min(std::max(number, 0.0), 1.0)); }

void ExpectSameNodes(const tinygltf::Model& model, const Scene& scene) {
  ASSERT_EQ(scene.nodes.size(), model.nodes.size());
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    SCOPED_TRACE("node " + std::to_string(i));
    const Node& node = scene.nodes[i];
    const tinygltf::Node& other = model.nodes[i];
    EXPECT_EQ(node.name, other.name);
    EXPECT_EQ(node.children, other.children);
    EXPECT_EQ(node.mesh, other.mesh);
    EXPECT_EQ(node.skin, other.skin);
    EXPECT_EQ(node.camera, other.camera);
    EXPECT_EQ(node.weights, std::vector<float>(other.weights.begin(), other.weights.end()));
    ASSERT_EQ(node.matrix.has_value(), !other.matrix.empty());
    if (node.matrix) {
      EXPECT_EQ(*node.matrix, glm::make_mat4(other.matrix.data()));
      continue;
    }
    const std::vector<double> t = Or(other.translation, std::vector<double>{0, 0, 0});
    const std::vector<double> s = Or(other.scale, std::vector<double>{1, 1, 1});
    const std::vector<double> r = Or(other.rotation, std::vector<double>{0, 0, 0, 1});
    EXPECT_EQ(node.transform.translation, glm::dvec3(t[0], t[1], t[2]));
    EXPECT_EQ(node.transform.scale, glm::dvec3(s[0], s[1], s[2]));
    const double length = std::hypot(std::hypot(r[0], r[1]), std::hypot(r[2], r[3]));
    const glm::dquat& q = node.transform.rotation;
    const double rotation[] = {q.x, q.y, q.z, q.w};
    for (std::size_t c = 0; c < 4; ++c) EXPECT_NEAR(rotation[c], r[c] / length, 1e-15) << "component " << c;
  }
  ASSERT_EQ(scene.scenes.size(), model.scenes.size());
  EXPECT_EQ(scene.default_scene, model.defaultScene);
  for (std::size_t i = 0; i < scene.scenes.size(); ++i) {
    EXPECT_EQ(scene.scenes[i].name, model.scenes[i].name);
    EXPECT_EQ(scene.scenes[i].nodes, model.scenes[i].nodes);
  }
}

// Elements of facet's arrays are those of the file from `first` on, each number within `tolerance`.
template <class T>
void ExpectSame(const std::vector<T>& ours, const Table& theirs, std::size_t first, double tolerance,
                const char* what) {
  ASSERT_LE(first + ours.size(), theirs.count) << what;
  const auto width = std::min(theirs.width, static_cast<std::size_t>(T::length()));
  for (std::size_t i = 0; i < ours.size(); ++i) {
    for (std::size_t c = 0; c < width; ++c) {
      const double expected = theirs.At(first + i, c), got = static_cast<double>(ours[i][static_cast<int>(c)]);
      ASSERT_LE(std::fabs(got - expected), tolerance) << what << ' ' << i << ", component " << c << ": " << expected;
    }
  }
}

// What makes no whole triangle or line is left out.
std::size_t Whole(int mode, std::size_t corners) {
  if (mode == TINYGLTF_MODE_TRIANGLES) return corners - corners % 3;
  return mode == TINYGLTF_MODE_LINE ? corners - corners % 2 : corners;
}

Topology TopologyOf(int mode) {
  constexpr Topology kModes[] = {Topology::Points,     Topology::Lines,     Topology::LineLoop,
                                 Topology::LineStrip,  Topology::Triangles, Topology::TriangleStrip,
                                 Topology::TriangleFan};
  return kModes[mode < 0 ? TINYGLTF_MODE_TRIANGLES : mode];
}

class PrimitiveComparison {
 public:
  PrimitiveComparison(const tinygltf::Model& model, const tinygltf::Primitive& theirs, const Primitive& ours)
      : model_(model), theirs_(theirs), ours_(ours) {}

  void Run() {
    EXPECT_EQ(ours_.topology, TopologyOf(theirs_.mode));
    EXPECT_EQ(ours_.material, theirs_.material);
    ExpectSameCorners();
    constexpr double kExact = 0.0, kRounding = 1e-7;
    constexpr double kUnit = 1e-3;  // of directions, which stay as they are where they are unit but for so much
    Compare(ours_.positions, "POSITION", kExact);
    Compare(ours_.normals, "NORMAL", kUnit);
    Compare(ours_.tangents, "TANGENT", kUnit);
    Compare(ours_.colors, "COLOR_0", kRounding);
    for (std::size_t set = 0; set < ours_.tex_coords.size(); ++set) {
      Compare(ours_.tex_coords[set], "TEXCOORD_" + std::to_string(set), kRounding);
    }
    for (std::size_t set = 0; set < ours_.joints.size(); ++set) {
      Compare(ours_.weights[set], "WEIGHTS_" + std::to_string(set), kRounding);
      CompareJoints(set);
    }
    ASSERT_EQ(ours_.targets.size(), theirs_.targets.size());
    for (std::size_t t = 0; t < ours_.targets.size(); ++t) {
      CompareTarget(ours_.targets[t].positions, t, "POSITION");
      CompareTarget(ours_.targets[t].normals, t, "NORMAL");
      CompareTarget(ours_.targets[t].tangents, t, "TANGENT");
    }
  }

 private:
  void ExpectSameCorners() {
    const Table positions = ValuesOf(model_, theirs_.attributes.at("POSITION"));
    if (theirs_.indices < 0) {
      EXPECT_TRUE(ours_.indices.empty());
      EXPECT_EQ(ours_.positions.size(), positions.count);
      return;
    }
    const Table corners = ValuesOf(model_, theirs_.indices);
    ASSERT_EQ(ours_.indices.size(), Whole(theirs_.mode < 0 ? TINYGLTF_MODE_TRIANGLES : theirs_.mode, corners.count));
    // Of vertices that many primitives share, each has those between its first and its last.
    if (ours_.positions.size() != positions.count) {
      first_ = static_cast<std::size_t>(*std::min_element(corners.numbers.begin(), corners.numbers.end()));
    }
    for (std::size_t i = 0; i < ours_.indices.size(); ++i) {
      ASSERT_EQ(double(ours_.indices[i] + first_), corners.At(i, 0)) << "corner " << i;
    }
  }

  template <class T>
  void Compare(const std::vector<T>& ours, const std::string& semantic, double tolerance) {
    const auto accessor = theirs_.attributes.find(semantic);
    if (accessor == theirs_.attributes.end()) {
      EXPECT_TRUE(ours.empty()) << semantic;
      return;
    }
    // Tangents without normals have no meaning.
    if (semantic == "TANGENT" && !theirs_.attributes.contains("NORMAL")) return;
    EXPECT_EQ(ours.size(), ours_.positions.size()) << semantic;
    Table theirs = ValuesOf(model_, accessor->second);
    if (semantic == "NORMAL" || semantic == "TANGENT") MakeUnit(theirs);
    ExpectSame(ours, theirs, first_, tolerance, semantic.c_str());
  }

  // Quantised directions are not unit; their first three numbers say where they point.
  static void MakeUnit(Table& directions) {
    for (std::size_t i = 0; i < directions.count; ++i) {
      double* const d = directions.numbers.data() + i * directions.width;
      const double length = std::hypot(d[0], d[1], d[2]);
      for (std::size_t c = 0; c < 3 && length > 0.0; ++c) d[c] /= length;
    }
  }

  // A joint that no vertex follows may be any.
  void CompareJoints(std::size_t set) {
    const auto joints = theirs_.attributes.find("JOINTS_" + std::to_string(set));
    ASSERT_TRUE(joints != theirs_.attributes.end());
    const Table expected = ValuesOf(model_, joints->second);
    ASSERT_EQ(ours_.joints[set].size(), ours_.positions.size());
    for (std::size_t v = 0; v < ours_.positions.size(); ++v) {
      for (int c = 0; c < 4; ++c) {
        if (ours_.weights[set][v][c] == 0.0f) continue;
        ASSERT_EQ(double(ours_.joints[set][v][c]), expected.At(first_ + v, std::size_t(c))) << "vertex " << v;
      }
    }
  }

  void CompareTarget(const std::vector<glm::vec3>& ours, std::size_t target, const char* semantic) {
    const auto accessor = theirs_.targets[target].find(semantic);
    const bool has_base = theirs_.attributes.contains(semantic);
    if (accessor == theirs_.targets[target].end() || !has_base) {
      EXPECT_TRUE(ours.empty()) << semantic << " of target " << target;
      return;
    }
    EXPECT_EQ(ours.size(), ours_.positions.size()) << semantic << " of target " << target;
    ExpectSame(ours, ValuesOf(model_, accessor->second), first_, 1e-7, semantic);
  }

  const tinygltf::Model& model_;
  const tinygltf::Primitive& theirs_;
  const Primitive& ours_;
  std::size_t first_ = 0;  // the vertex of the file that is facet's first
};

// Returns how many primitives were compared: not those whose numbers are packed.
int ExpectSameMeshes(const tinygltf::Model& model, const Scene& scene) {
  int compared = 0;
  EXPECT_EQ(scene.meshes.size(), model.meshes.size());
  for (std::size_t m = 0; m < std::min(scene.meshes.size(), model.meshes.size()); ++m) {
    const Mesh& mesh = scene.meshes[m];
    EXPECT_EQ(mesh.name, model.meshes[m].name);
    std::vector<tinygltf::Primitive> primitives = model.meshes[m].primitives;
    std::erase_if(primitives, [](const tinygltf::Primitive& p) { return !p.attributes.contains("POSITION"); });
    EXPECT_EQ(mesh.primitives.size(), primitives.size()) << "mesh " << m;
    for (std::size_t p = 0; p < std::min(mesh.primitives.size(), primitives.size()); ++p) {
      SCOPED_TRACE("mesh " + std::to_string(m) + ", primitive " + std::to_string(p));
      if (!IsPlain(model, primitives[p])) continue;
      PrimitiveComparison(model, primitives[p], mesh.primitives[p]).Run();
      ++compared;
    }
  }
  return compared;
}

template <class Info>
void ExpectSameTexture(const TextureRef& ours, const Info& theirs, const char* what) {
  EXPECT_EQ(ours.texture, theirs.index) << what;
  const auto transform = theirs.extensions.find("KHR_texture_transform");
  if (transform == theirs.extensions.end()) {
    if (theirs.index >= 0) {
      EXPECT_EQ(ours.tex_coord, theirs.texCoord) << what;
    }
    EXPECT_EQ(ours.offset, glm::vec2(0.0f)) << what;
    EXPECT_EQ(ours.scale, glm::vec2(1.0f)) << what;
    EXPECT_EQ(ours.rotation, 0.0f) << what;
    return;
  }
  const tinygltf::Value& value = transform->second;
  const auto pair = [&](const char* key, double otherwise) {
    glm::vec2 numbers(static_cast<float>(otherwise));
    for (int c = 0; value.Has(key) && c < 2; ++c) {
      numbers[c] = static_cast<float>(value.Get(key).Get(c).GetNumberAsDouble());
    }
    return numbers;
  };
  EXPECT_EQ(ours.tex_coord, value.Has("texCoord") ? value.Get("texCoord").GetNumberAsInt() : theirs.texCoord) << what;
  EXPECT_EQ(ours.offset, pair("offset", 0.0)) << what;
  EXPECT_EQ(ours.scale, pair("scale", 1.0)) << what;
  EXPECT_EQ(ours.rotation, value.Has("rotation") ? static_cast<float>(value.Get("rotation").GetNumberAsDouble()) : 0.0f)
      << what;
}

void ExpectSameMaterials(const tinygltf::Model& model, const Scene& scene) {
  ASSERT_EQ(scene.materials.size(), model.materials.size());
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    SCOPED_TRACE("material " + std::to_string(i));
    const Material& ours = scene.materials[i];
    const tinygltf::Material& theirs = model.materials[i];
    const tinygltf::PbrMetallicRoughness& pbr = theirs.pbrMetallicRoughness;
    EXPECT_EQ(ours.name, theirs.name);
    const auto older = theirs.extensions.find("KHR_materials_pbrSpecularGlossiness");
    EXPECT_EQ(ours.model == ShadingModel::SpecularGlossiness, older != theirs.extensions.end());
    if (older != theirs.extensions.end()) {
      const tinygltf::Value& said = older->second;
      for (int c = 0; c < 4; ++c) {
        const double factor = said.Has("diffuseFactor") ? said.Get("diffuseFactor").Get(c).GetNumberAsDouble() : 1.0;
        EXPECT_EQ(ours.base_color_factor[c], Clamped(factor)) << "diffuse colour, component " << c;
      }
      const tinygltf::Value* texture = said.Has("diffuseTexture") ? &said.Get("diffuseTexture") : nullptr;
      EXPECT_EQ(ours.base_color_texture.texture, texture ? texture->Get("index").GetNumberAsInt() : -1);
    } else {
      for (std::size_t c = 0; c < 4; ++c) {
        const double factor = c < pbr.baseColorFactor.size() ? pbr.baseColorFactor[c] : 1.0;
        EXPECT_EQ(ours.base_color_factor[int(c)], Clamped(factor)) << "base colour, component " << c;
      }
      EXPECT_EQ(ours.metallic_factor, Clamped(pbr.metallicFactor));
      EXPECT_EQ(ours.roughness_factor, Clamped(pbr.roughnessFactor));
      ExpectSameTexture(ours.base_color_texture, pbr.baseColorTexture, "base colour");
      ExpectSameTexture(ours.metallic_roughness_texture, pbr.metallicRoughnessTexture, "metallic-roughness");
    }
    for (std::size_t c = 0; c < 3; ++c) {
      const double factor = c < theirs.emissiveFactor.size() ? theirs.emissiveFactor[c] : 0.0;
      EXPECT_EQ(ours.emissive_factor[int(c)], static_cast<float>(factor)) << "emissive, component " << c;
    }
    EXPECT_EQ(ours.alpha_mode, theirs.alphaMode == "MASK"    ? AlphaMode::Mask
                               : theirs.alphaMode == "BLEND" ? AlphaMode::Blend
                                                             : AlphaMode::Opaque);
    EXPECT_EQ(ours.alpha_cutoff, static_cast<float>(theirs.alphaCutoff));
    EXPECT_EQ(ours.double_sided, theirs.doubleSided);
    EXPECT_EQ(ours.normal_scale, static_cast<float>(theirs.normalTexture.scale));
    EXPECT_EQ(ours.occlusion_strength, Clamped(theirs.occlusionTexture.strength));
    EXPECT_EQ(ours.model == ShadingModel::Unlit, theirs.extensions.contains("KHR_materials_unlit"));
    ExpectSameTexture(ours.normal_texture, theirs.normalTexture, "normal");
    ExpectSameTexture(ours.occlusion_texture, theirs.occlusionTexture, "occlusion");
    ExpectSameTexture(ours.emissive_texture, theirs.emissiveTexture, "emissive");
  }
}

void ExpectSameTextures(const tinygltf::Model& model, const Scene& scene) {
  EXPECT_EQ(scene.images.size(), model.images.size());
  ASSERT_EQ(scene.textures.size(), model.textures.size());
  for (std::size_t i = 0; i < scene.images.size(); ++i) EXPECT_EQ(scene.images[i].name, model.images[i].name);
  const auto wrap = [](int value) {
    return value == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE     ? Wrap::ClampToEdge
           : value == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ? Wrap::MirroredRepeat
                                                            : Wrap::Repeat;
  };
  for (std::size_t i = 0; i < scene.textures.size(); ++i) {
    SCOPED_TRACE("texture " + std::to_string(i));
    const Texture& ours = scene.textures[i];
    const tinygltf::Texture& theirs = model.textures[i];
    EXPECT_EQ(ours.name, theirs.name);
    if (theirs.extensions.empty()) {  // else another format's image may stand in
      EXPECT_EQ(ours.image, theirs.source);
    }
    if (theirs.sampler < 0) continue;
    const tinygltf::Sampler& sampler = model.samplers.at(std::size_t(theirs.sampler));
    EXPECT_EQ(ours.sampler.wrap_u, wrap(sampler.wrapS));
    EXPECT_EQ(ours.sampler.wrap_v, wrap(sampler.wrapT));
    EXPECT_EQ(ours.sampler.magnification == Filter::Nearest, sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST);
    const int min = sampler.minFilter;
    EXPECT_EQ(ours.sampler.minification == Filter::Nearest, min == TINYGLTF_TEXTURE_FILTER_NEAREST ||
                                                                min == TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_NEAREST ||
                                                                min == TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_LINEAR);
    EXPECT_EQ(ours.sampler.mip == MipFilter::None,
              min == TINYGLTF_TEXTURE_FILTER_NEAREST || min == TINYGLTF_TEXTURE_FILTER_LINEAR);
  }
}

void ExpectSameCameras(const tinygltf::Model& model, const Scene& scene) {
  ASSERT_EQ(scene.cameras.size(), model.cameras.size());
  const auto far = [](double zfar) { return zfar > 0.0 ? zfar : std::numeric_limits<double>::infinity(); };
  for (std::size_t i = 0; i < scene.cameras.size(); ++i) {
    SCOPED_TRACE("camera " + std::to_string(i));
    const Camera& ours = scene.cameras[i];
    const tinygltf::Camera& theirs = model.cameras[i];
    EXPECT_EQ(ours.name, theirs.name);
    ASSERT_EQ(ours.orthographic, theirs.type == "orthographic");
    if (ours.orthographic) {
      EXPECT_EQ(ours.xmag, std::fabs(theirs.orthographic.xmag));
      EXPECT_EQ(ours.ymag, std::fabs(theirs.orthographic.ymag));
      EXPECT_EQ(ours.znear, theirs.orthographic.znear);
      EXPECT_EQ(ours.zfar, far(theirs.orthographic.zfar));
    } else {
      EXPECT_EQ(ours.yfov, theirs.perspective.yfov);
      EXPECT_EQ(ours.aspect.value_or(0.0), theirs.perspective.aspectRatio);
      EXPECT_EQ(ours.znear, theirs.perspective.znear);
      EXPECT_EQ(ours.zfar, far(theirs.perspective.zfar));
    }
  }
}

void ExpectSameSkins(const tinygltf::Model& model, const Scene& scene) {
  ASSERT_EQ(scene.skins.size(), model.skins.size());
  for (std::size_t i = 0; i < scene.skins.size(); ++i) {
    SCOPED_TRACE("skin " + std::to_string(i));
    EXPECT_EQ(scene.skins[i].name, model.skins[i].name);
    EXPECT_EQ(scene.skins[i].joints, model.skins[i].joints);
    const int accessor = model.skins[i].inverseBindMatrices;
    ASSERT_EQ(scene.skins[i].inverse_bind.empty(), accessor < 0);
    if (accessor < 0 || !IsPlain(model, accessor)) continue;
    const Table theirs = ValuesOf(model, accessor);
    for (std::size_t j = 0; j < scene.skins[i].inverse_bind.size(); ++j) {
      for (int c = 0; c < 16; ++c) {
        ASSERT_EQ(double(scene.skins[i].inverse_bind[j][c / 4][c % 4]), theirs.At(j, std::size_t(c))) << "joint " << j;
      }
    }
  }
}

void ExpectSameAnimations(const tinygltf::Model& model, const Scene& scene) {
  ASSERT_EQ(scene.animations.size(), model.animations.size());
  for (std::size_t a = 0; a < scene.animations.size(); ++a) {
    SCOPED_TRACE("animation " + std::to_string(a));
    EXPECT_EQ(scene.animations[a].name, model.animations[a].name);
    std::vector<tinygltf::AnimationChannel> channels = model.animations[a].channels;
    std::erase_if(channels, [](const tinygltf::AnimationChannel& channel) { return channel.target_node < 0; });
    ASSERT_EQ(scene.animations[a].channels.size(), channels.size());
    for (std::size_t c = 0; c < channels.size(); ++c) {
      SCOPED_TRACE("channel " + std::to_string(c));
      const AnimationChannel& ours = scene.animations[a].channels[c];
      const auto& sampler = model.animations[a].samplers.at(std::size_t(channels[c].sampler));
      EXPECT_EQ(ours.node, channels[c].target_node);
      constexpr const char* kPaths[] = {"translation", "rotation", "scale", "weights"};
      constexpr const char* kInterpolations[] = {"LINEAR", "STEP", "CUBICSPLINE"};
      EXPECT_EQ(kPaths[int(ours.path)], channels[c].target_path);
      EXPECT_EQ(kInterpolations[int(ours.interpolation)],
                sampler.interpolation.empty() ? "LINEAR" : sampler.interpolation);
      if (!IsPlain(model, sampler.input) || !IsPlain(model, sampler.output)) continue;
      const Table times = ValuesOf(model, sampler.input), values = ValuesOf(model, sampler.output);
      ASSERT_EQ(ours.times.size(), times.count);
      ASSERT_EQ(ours.values.size(), values.numbers.size());
      for (std::size_t k = 0; k < times.count; ++k) ASSERT_EQ(double(ours.times[k]), times.At(k, 0)) << "key " << k;
      for (std::size_t k = 0; k < values.numbers.size(); ++k) {
        ASSERT_NEAR(double(ours.values[k]), values.numbers[k], 1e-7) << "number " << k;
      }
    }
  }
}

struct Tally {
  int files = 0, unread = 0, primitives = 0;
};

void Compare(const std::filesystem::path& path, Tally& tally) {
  SCOPED_TRACE(path.string());
  const std::optional<tinygltf::Model> model = ReadWithTinygltf(path);
  if (!model) {
    ++tally.unread;
    return;
  }
  Scene scene;
  LoadOptions options;
  options.ignore_required_extensions = true;
  try {
    scene = LoadGltf(path, options).scene;
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::Unsupported) << error.what();
    ++tally.unread;
    return;
  }
  ++tally.files;
  ExpectSameNodes(*model, scene);
  tally.primitives += ExpectSameMeshes(*model, scene);
  ExpectSameMaterials(*model, scene);
  ExpectSameTextures(*model, scene);
  ExpectSameCameras(*model, scene);
  ExpectSameSkins(*model, scene);
  ExpectSameAnimations(*model, scene);
}

Tally CompareAll(const std::filesystem::path& folder) {
  std::set<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    const std::string extension = entry.path().extension().string();
    if (extension == ".gltf" || extension == ".glb") paths.insert(entry.path());
  }
  Tally tally;
  for (const auto& path : paths) Compare(path, tally);
  return tally;
}

TEST(Tinygltf, SaysTheSameOfTheBundledScenes) {
  const Tally tally = CompareAll(std::filesystem::path(FACET_SOURCE_DIR) / "assets/scenes");
  EXPECT_EQ(tally.files, 6);
  EXPECT_EQ(tally.unread, 0);
  EXPECT_GE(tally.primitives, 4);
}

TEST(Tinygltf, SaysTheSameOfTheModelsOfTheCorpus) {
  FACET_NEED_CORPUS();
  const Tally tally = CompareAll(CorpusPath() / "models");
  EXPECT_GE(tally.files, 70) << "a comparison of few files says little";
  EXPECT_GE(tally.primitives, 200);
}

TEST(Tinygltf, SaysTheSameOfTheAssetGeneratorsModels) {
  FACET_NEED_CORPUS();
  const Tally tally = CompareAll(CorpusPath() / "asset-generator");
  EXPECT_GE(tally.files, 150);
  EXPECT_GE(tally.primitives, 150);
}

}  // namespace
}  // namespace facet
