// Broken files: an Error or a Scene, never a crash, a hang or much memory.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <fstream>
#include <sstream>

#include "gltf_files.h"

namespace facet {
namespace {

using testing::CorpusPath;

std::vector<std::pair<std::string, std::string>> MalformedFiles() {
  std::vector<std::pair<std::string, std::string>> files;  // path and note
  std::ifstream manifest(CorpusPath() / "MANIFEST.tsv");
  std::string line;
  while (std::getline(manifest, line)) {
    if (line.rfind("malformed/", 0) != 0) continue;
    files.emplace_back(line.substr(0, line.find('\t')), line.substr(line.rfind('\t') + 1));
  }
  return files;
}

std::string ReadFile(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::stringstream stream;
  stream << file.rdbuf();
  return stream.str();
}

TEST(Malformed, EveryFileGivesAnErrorOrAScene) {
  FACET_NEED_CORPUS();
  int valid = 0, errors = 0, scenes = 0;
  for (const auto& [path, note] : MalformedFiles()) {
    SCOPED_TRACE(path + ": " + note);
    const bool is_valid = note.rfind("valid", 0) == 0;
    valid += is_valid;
    try {
      LoadGltf(CorpusPath() / path);
      ++scenes;
    } catch (const Error& error) {
      ++errors;
      EXPECT_NE(error.code(), ErrorCode::Internal) << error.what();
      EXPECT_NE(error.code(), ErrorCode::OutOfMemory) << error.what();
      EXPECT_FALSE(error.where().empty());
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
      EXPECT_LT(std::string(error.what()).size(), 1000u);
      if (is_valid) {
        EXPECT_EQ(error.code(), ErrorCode::Unsupported) << error.what();
      }
    }
  }
  EXPECT_EQ(scenes + errors, 373);
  EXPECT_EQ(valid, 76);
  EXPECT_EQ(errors, 38 + 2) << "those that show what is broken, or are no glTF 2.0 files; two that need glTF 2.1";
}

TEST(Malformed, WhatIsWrongIsNamed) {
  FACET_NEED_CORPUS();
  const std::pair<const char*, const char*> expected[] = {
      {"assimp/IndexOutOfRange.gltf", "meshes[0].primitives[0].indices: index 255 is not one of 24"},
      {"assimp/RecursiveNodes.gltf", "is its own ancestor"},
      {"assimp/MissingBin/MissingBin.gltf", "BoxTextured0.bin"},
      {"jgltf/Box-version1.glb", "version 1"},
      {"jgltf/Box-version1.gltf", "glTF 1.0"},
      {"f3d/lfs-pointer.gltf", "not a glTF file, but a Git LFS pointer"},
      {"tinygltf/integer-out-of-bounds.gltf", "bufferViews[0].byteLength"},
      {"validator/base/node/node_loop.gltf", "is its own ancestor"},
      {"validator/base/node/unresolved_mesh.gltf", "nodes[0].mesh: 0 is not one of the 0 meshes"}};
  for (const auto& [path, text] : expected) {
    try {
      LoadGltf(CorpusPath() / "malformed" / path);
      ADD_FAILURE() << path << " loads";
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(text), std::string::npos) << error.what();
    }
  }
}

// What the picture does not need, and what can be guessed: the validator calls each of these an error.
TEST(Malformed, WhatIsRepairedIsNamed) {
  FACET_NEED_CORPUS();
  const std::pair<const char*, const char*> expected[] = {
      {"assimp/NoScene.gltf", "scene: ignored (0 is not one of the 0 scenes)"},
      {"assimp/badExtension.gltf", "baseColorTexture.extensions.KHR_texture_transform: ignored (is not an object)"},
      {"assimp/badObject.gltf", "materials[0].pbrMetallicRoughness: ignored (is not an object)"},
      {"assimp/badString.gltf", "scenes[0].name: ignored (is not a string)"},
      {"tinygltf/invalid-buffer-index.gltf", "(bufferViews[1].buffer: 1 is not one of the 1 buffers)"},
      {"validator/EXT_texture_webp/texture/unresolved_source.gltf", "EXT_texture_webp.source: ignored"},
      {"validator/KHR_lights_punctual/node/empty_object.gltf", "KHR_lights_punctual: \"light\" is missing"},
      {"validator/KHR_materials_variants/primitive/unresolved_references.gltf", "mappings[0].material: ignored"},
      {"validator/KHR_materials_variants/variant/invalid_name.gltf", "variants[0].name: ignored"},
      {"validator/base/accessor/empty_object.gltf", "accessors[0]: nothing reads it"},
      {"validator/base/animation/empty_objects.gltf", "animations[2].channels[0]: ignored"},
      {"validator/base/animation/sampler_input_format_invalid.gltf", "times are not floats"},
      {"validator/base/animation/unresolved_sampler_output.gltf", "animations[0].channels[0]: ignored"},
      {"validator/base/buffer/invalid_object.gltf", "buffers[0]: is not an object"},
      {"validator/base/buffer/invalid_uri_data.glb", "is a malformed data URI, and nothing reads it"},
      {"validator/base/buffer/not_found.gltf", "not_found.bin\" is not there"},
      {"validator/base/buffer_view/invalid_length.gltf", "reach past the 4 of buffers[0]"},
      {"validator/base/buffer_view/invalid_stride_multiple.gltf", "5 is not a multiple of 4 up to 252"},
      {"validator/base/buffer_view/unresolved_buffer.gltf", "bufferViews[0]: nothing reads it"},
      {"validator/base/camera/empty_objects.gltf", "cameras[0]: cannot be used"},
      {"validator/base/camera/infinite_znear.gltf", "cameras[0].perspective.znear: is beyond the range of numbers"},
      {"validator/base/camera/orthographic_xy.gltf", "xmag or ymag is zero"},
      {"validator/base/camera/perspective_yfov.gltf", "yfov: is not between 0 and pi"},
      {"validator/base/camera/perspective_z.gltf", "zfar: is not beyond znear; none is used"},
      {"validator/base/glb/chunk_too_big.glb", "the header's length is 13 bytes, and the file has 48"},
      {"validator/base/glb/length_mismatch.glb", "the header's length is 49 bytes, and the file has 48"},
      {"validator/base/image/invalid_object.gltf", "images[0]: is not an object"},
      {"validator/base/material/unresolved_normal.gltf", "normalTexture.index: ignored"},
      {"validator/base/mesh/accessor_unequal_count.gltf", "COLOR_0: has 4 elements, and the primitive 3 vertices"},
      {"validator/base/mesh/empty_object.gltf", "meshes[0]: ignored (\"primitives\" is missing)"},
      {"validator/base/mesh/position_accessor_invalid_format.gltf", "has 4 components; the first 3 are read"},
      {"validator/base/mesh/unresolved_indices.gltf", "indices: 1 is not one of the 1 accessors"},
      {"validator/base/mesh/unresolved_material.gltf", "material: ignored (0 is not one of the 0 materials)"},
      {"validator/base/mesh_data/index_buffer_oob.gltf", "index 5 is not one of 4 vertices"},
      {"validator/base/node/unresolved_camera.gltf", "nodes[0].camera: ignored"},
      {"validator/base/root/invalid_array_elements.gltf", "materials[0]: is not an object"},
      {"validator/base/scene/non_root_node.gltf", "nodes[1] is not a root node"},
      {"validator/base/skin/ibm_invalid_count.gltf", "has 2 matrices for 3 joints"},
      {"validator/base/skin/unresolved_skeleton.gltf", "skins[0].skeleton: ignored"},
      {"validator/base/texture/unresolved_sampler.gltf", "textures[0].sampler: ignored"}};
  for (const auto& [path, text] : expected) {
    SCOPED_TRACE(path);
    LoadedScene loaded;
    ASSERT_NO_THROW(loaded = LoadGltf(CorpusPath() / "malformed" / path));
    bool said = false;
    for (const std::string& line : loaded.report.warnings) said = said || line.find(text) != std::string::npos;
    EXPECT_TRUE(said) << text;
  }
}

// Real files with bytes changed: what the checks guard is mostly reached from here.
TEST(Malformed, ChangedBytesOfRealFiles) {
  FACET_NEED_CORPUS();
  const testing::TempFolder folder;
  std::uint32_t state = 1;
  const auto random = [&] {
    state = state * 1664525u + 1013904223u;
    return state >> 8;
  };
  for (const char* name :
       {"models/Pirate-Meshopt/pirate.glb", "models/SparseMorphTarget/singleBlendshapeCube_sparse.glb",
        "models/RiggedSimple/RiggedSimple.glb", "models/SimpleInstancing/SimpleInstancing.glb",
        "models/QuadSkin-12Influences/quad_skin.glb", "models/Lights/Lights.glb"}) {
    const std::string whole = ReadFile(CorpusPath() / name);
    for (int round = 0; round < 150; ++round) {
      std::string bytes = whole;
      // Half of the rounds change digits of the JSON, so that it stays JSON.
      const bool digits = round % 2 == 0;
      for (int changes = 0; changes < 4; ++changes) {
        const std::size_t at = random() % bytes.size();
        if (!digits) {
          bytes[at] = static_cast<char>(random());
        } else {
          const std::size_t digit = bytes.find_first_of("0123456789", 20 + random() % 2000);
          if (digit != std::string::npos) bytes[digit] = static_cast<char>('0' + random() % 10);
        }
      }
      try {
        LoadGltf(folder.Write("changed.glb", bytes));
      } catch (const Error& error) {
        EXPECT_NE(error.code(), ErrorCode::Internal) << error.what();
      }
    }
    for (std::size_t length = 0; length < whole.size(); length += 1 + whole.size() / 100) {
      // Where what is missing is nothing that the picture shows at rest, a warning says so.
      try {
        const LoadedScene loaded = LoadGltf(folder.Write("cut.glb", whole.substr(0, length)));
        ASSERT_FALSE(loaded.report.warnings.empty());
        EXPECT_EQ(loaded.report.warnings[0].rfind("GLB: the BIN chunk's length is ", 0), 0u)
            << loaded.report.warnings[0];
      } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::InvalidInput) << error.what();
      }
    }
  }
}

TEST(Malformed, ChangedDracoData) {
  FACET_NEED_CORPUS();
  const testing::TempFolder folder;
  const auto source = CorpusPath() / "models/Box-Draco";
  std::string bin_name;
  for (const auto& entry : std::filesystem::directory_iterator(source)) {
    if (entry.path().extension() == ".bin") bin_name = entry.path().filename().string();
  }
  const std::string json = ReadFile(source / "Box.gltf"), whole = ReadFile(source / bin_name);
  ASSERT_FALSE(whole.empty());
  const auto path = folder.Write("Box.gltf", json);
  std::uint32_t state = 7;
  for (int round = 0; round < 300; ++round) {
    std::string bytes = whole;
    for (int changes = 0; changes < 2; ++changes) {
      state = state * 1664525u + 1013904223u;
      bytes[(state >> 8) % bytes.size()] = static_cast<char>(state >> 24);
    }
    folder.Write(bin_name, bytes);
    try {
      LoadGltf(path);
    } catch (const Error& error) {
      EXPECT_NE(error.code(), ErrorCode::Internal) << error.what();
    }
  }
}

TEST(Malformed, MemoryStaysBounded) {
  // Of the whole process, all tests before included.
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  EXPECT_LT(usage.ru_maxrss, 1024 * 1024) << "kilobytes";
#endif
}

}  // namespace
}  // namespace facet
