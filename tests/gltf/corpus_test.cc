// Real files: each loads with the warnings that it should have, and twins agree.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "gltf_files.h"

namespace facet {
namespace {

using testing::CorpusPath;

// The lines of the corpus' manifest: path and features.
std::map<std::string, std::string> Manifest() {
  std::map<std::string, std::string> features;
  std::ifstream file(CorpusPath() / "MANIFEST.tsv");
  std::string line;
  while (std::getline(file, line)) {
    std::vector<std::string> columns;
    std::stringstream stream(line);
    std::string column;
    while (std::getline(stream, column, '\t')) columns.push_back(column);
    if (columns.size() > 3) features[columns[0]] = columns[3];
  }
  return features;
}

const std::set<std::string>& Supported() {
  static const std::set<std::string> names = {"EXT_mesh_gpu_instancing",
                                              "EXT_meshopt_compression",
                                              "EXT_texture_webp",
                                              "KHR_draco_mesh_compression",
                                              "KHR_lights_punctual",
                                              "KHR_materials_emissive_strength",
                                              "KHR_materials_unlit",
                                              "KHR_materials_anisotropy",
                                              "KHR_materials_clearcoat",
                                              "KHR_materials_diffuse_transmission",
                                              "KHR_materials_dispersion",
                                              "KHR_materials_ior",
                                              "KHR_materials_iridescence",
                                              "KHR_materials_pbrSpecularGlossiness",
                                              "KHR_materials_sheen",
                                              "KHR_materials_specular",
                                              "KHR_materials_transmission",
                                              "KHR_materials_volume",
                                              "KHR_materials_variants",
                                              "KHR_mesh_quantization",
                                              "KHR_node_visibility",
                                              "KHR_texture_transform",
                                              "FB_ngon_encoding",
                                              "KHR_xmp"};
  return names;
}

void ExpectFinite(const Scene& scene, const std::string& path) {
  const auto finite = [](const auto& values) {
    return std::all_of(values.begin(), values.end(), [](const auto& v) {
      for (int c = 0; c < v.length(); ++c) {
        if (!std::isfinite(v[c])) return false;
      }
      return true;
    });
  };
  for (const Mesh& mesh : scene.meshes) {
    for (const Primitive& p : mesh.primitives) {
      EXPECT_FALSE(p.positions.empty()) << path;
      EXPECT_TRUE(finite(p.positions) && finite(p.normals) && finite(p.tangents) && finite(p.colors)) << path;
      for (const glm::vec3& n : p.normals) ASSERT_NEAR(glm::length(n), 1.0f, 1e-3f) << path;
    }
  }
}

TEST(Corpus, EveryModelLoadsWithItsWarningsOnly) {
  FACET_NEED_CORPUS();
  int count = 0;
  for (const auto& [path, features] : Manifest()) {
    if (path.rfind("models/", 0) != 0) continue;
    SCOPED_TRACE(path);
    std::set<std::string> expected;
    bool refused = false;
    const std::size_t at = features.find("ext=");
    if (at != std::string::npos) {
      std::stringstream stream(features.substr(at + 4, features.find(';', at) - at - 4));
      std::string name;
      while (std::getline(stream, name, ',')) {
        const bool required = name.back() == '!';
        if (required) name.pop_back();
        if (Supported().count(name)) continue;
        refused = refused || required;
        expected.insert(std::string(required ? "extensionsRequired" : "extensionsUsed") + ": ignored: " + name +
                        " is not supported");
      }
    }
    if (refused) {
      EXPECT_THROW(LoadGltf(CorpusPath() / path), Error);
    }
    LoadOptions options;
    options.ignore_required_extensions = refused;
    const LoadedScene loaded = LoadGltf(CorpusPath() / path, options);
    std::set<std::string> warnings(loaded.report.warnings.begin(), loaded.report.warnings.end());
    if (path.find("KTX2Quads") != std::string::npos) {
      std::erase_if(warnings,
                    [](const std::string& w) { return w.find("needs KHR_texture_basisu") != std::string::npos; });
    }
    EXPECT_EQ(warnings, expected);
    ExpectFinite(loaded.scene, path);
    ++count;
  }
  EXPECT_EQ(count, 78);
}

TEST(Corpus, EveryAssetGeneratorModelLoads) {
  FACET_NEED_CORPUS();
  int refused = 0, loaded_count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(CorpusPath() / "asset-generator")) {
    const std::string extension = entry.path().extension().string();
    if (extension != ".gltf" && extension != ".glb") continue;
    SCOPED_TRACE(entry.path().filename().string());
    try {
      const LoadedScene loaded = LoadGltf(entry.path());
      ++loaded_count;
      for (const std::string& warning : loaded.report.warnings) {
        EXPECT_EQ(warning, "asset.version: glTF 2.1 is read as 2.0");
      }
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::Unsupported) << error.what();
      ++refused;
    }
  }
  EXPECT_EQ(loaded_count, 156);
  EXPECT_EQ(refused, 2) << "one requires glTF 2.1, one an extension that does not exist";
}

// For each triangle of `a` the nearest one of `b`, by centre, must lie within `tolerance`, in world-free mesh space.
std::vector<glm::vec3> SortedCentres(const Primitive& p, glm::vec3 scale, glm::vec3 offset) {
  std::vector<glm::vec3> centres;
  for (std::size_t i = 0; i + 2 < p.indices.size(); i += 3) {
    glm::vec3 centre(0.0f);
    for (std::size_t k = 0; k < 3; ++k) centre += (p.positions[p.indices[i + k]] * scale + offset) / 3.0f;
    centres.push_back(centre);
  }
  return centres;
}

void ExpectSameSurface(const Primitive& a, const std::vector<glm::vec3>& centres_b, float tolerance) {
  const auto centres_a = SortedCentres(a, glm::vec3(1), glm::vec3(0));
  ASSERT_EQ(centres_a.size(), centres_b.size());
  for (const glm::vec3& centre : centres_a) {
    float nearest = 1e30f;
    for (const glm::vec3& other : centres_b) nearest = std::min(nearest, glm::length(centre - other));
    ASSERT_LT(nearest, tolerance);
  }
}

TEST(Corpus, DracoAgreesWithItsTwin) {
  FACET_NEED_CORPUS();
  const std::tuple<const char*, const char*, float> twins[] = {
      {"models/Box/Box.glb", "models/Box-Draco/Box.gltf", 1e-3f},
      {"models/Duck/Duck.glb", "models/Duck-Draco/Duck.gltf", 0.5f},  // a duck of 150 units
      {"models/RiggedFigure/RiggedFigure.glb", "models/RiggedFigure-Draco/RiggedFigure.gltf", 2e-3f}};
  for (const auto& [plain_path, packed_path, tolerance] : twins) {
    SCOPED_TRACE(packed_path);
    const LoadedScene plain = LoadGltf(CorpusPath() / plain_path), packed = LoadGltf(CorpusPath() / packed_path);
    const Primitive& a = plain.scene.meshes.at(0).primitives.at(0);
    const Primitive& b = packed.scene.meshes.at(0).primitives.at(0);
    ExpectSameSurface(a, SortedCentres(b, glm::vec3(1), glm::vec3(0)), tolerance);
    EXPECT_EQ(a.tex_coords.size(), b.tex_coords.size());
    EXPECT_EQ(a.joints.size(), b.joints.size());
    EXPECT_EQ(a.normals.empty(), b.normals.empty());
    if (a.joints.empty()) continue;
    // Joints are not quantised: each vertex of the twin has a vertex beside it with the same main joint.
    for (std::size_t v = 0; v < b.positions.size(); v += 7) {
      bool found = false;
      for (std::size_t w = 0; w < a.positions.size() && !found; ++w) {
        found = glm::length(a.positions[w] - b.positions[v]) < tolerance && a.joints[0][w][0] == b.joints[0][v][0];
      }
      EXPECT_TRUE(found) << "vertex " << v;
    }
  }
}

TEST(Corpus, QuantizedDuckAgreesWithTheDuck) {
  FACET_NEED_CORPUS();
  const LoadedScene plain = LoadGltf(CorpusPath() / "models/Duck/Duck.glb");
  const LoadedScene quantized = LoadGltf(CorpusPath() / "models/Duck-Quantized/Duck.gltf");
  const Primitive& a = plain.scene.meshes.at(0).primitives.at(0);
  const Primitive& b = quantized.scene.meshes.at(0).primitives.at(0);
  ASSERT_EQ(a.positions.size(), b.positions.size());
  // The quantisation is an affine map for each axis (undone by a node): the boxes give it.
  const auto box = [](const Primitive& p) {
    std::pair<glm::vec3, glm::vec3> bounds(p.positions[0], p.positions[0]);
    for (const glm::vec3& x : p.positions) bounds = {glm::min(bounds.first, x), glm::max(bounds.second, x)};
    return bounds;
  };
  const auto [low_a, high_a] = box(a);
  const auto [low_b, high_b] = box(b);
  const glm::vec3 scale = (high_a - low_a) / (high_b - low_b);
  ExpectSameSurface(a, SortedCentres(b, scale, low_a - low_b * scale), 0.05f);
  EXPECT_EQ(b.normals.size(), b.positions.size());
  EXPECT_EQ(b.tex_coords.size(), 1u);
}

TEST(Corpus, KnownContents) {
  FACET_NEED_CORPUS();
  const auto load = [](const char* path) { return LoadGltf(CorpusPath() / path).scene; };
  EXPECT_EQ(load("models/SimpleSparseAccessor/SimpleSparseAccessor.gltf").meshes[0].primitives[0].positions[8],
            glm::vec3(1, 2, 0));
  const Scene instancing = load("models/SimpleInstancing/SimpleInstancing.glb");
  EXPECT_EQ(instancing.nodes[0].instances.size(), 125u);
  const Scene variants = load("models/BlenderIO_18_variants/18_variants.gltf");
  EXPECT_FALSE(variants.variants.empty());
  const Scene lights = load("models/Lights/Lights.glb");
  EXPECT_EQ(lights.lights.size(), 4u);
  const Scene skin = load("models/QuadSkin-12Influences/quad_skin.glb");
  EXPECT_EQ(skin.meshes[0].primitives[0].joints.size(), 3u);
  const Scene morph = load("models/MorphStressTest/MorphStressTest.glb");
  EXPECT_EQ(morph.meshes[0].primitives[0].targets.size(), 8u);
  const Scene scenes = load("models/MultipleScenes/MultipleScenes.gltf");
  EXPECT_EQ(scenes.scenes.size(), 2u);
  const Scene pirate = load("models/Pirate-Meshopt/pirate.glb");
  EXPECT_EQ(pirate.meshes[0].primitives[0].indices.size(), 3u * 5010u);
  for (const char* path :
       {"models/Box With Spaces/Box With Spaces.gltf", "models/CubeImageUriSpaces/CubeImageUriMultipleSpaces.gltf",
        "models/BoxTextured/BoxTextured.glb"}) {
    for (const SceneImage& image : load(path).images) EXPECT_GT(image.source->Decode().width, 0) << path;
  }
}

}  // namespace
}  // namespace facet
