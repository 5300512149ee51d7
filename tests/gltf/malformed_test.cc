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
  EXPECT_GT(errors, 80);
}

TEST(Malformed, WhatIsWrongIsNamed) {
  FACET_NEED_CORPUS();
  const std::pair<const char*, const char*> expected[] = {
      {"assimp/IndexOutOfRange.gltf", "meshes[0].primitives[0].indices: index 255 is not one of 24"},
      {"assimp/RecursiveNodes.gltf", "is its own ancestor"},
      {"assimp/MissingBin/MissingBin.gltf", "BoxTextured0.bin"},
      {"jgltf/Box-version1.glb", "version 1"},
      {"jgltf/Box-version1.gltf", "glTF 1.0"},
      {"f3d/lfs-pointer.gltf", "not a glTF file"},
      {"tinygltf/invalid-buffer-index.gltf", "bufferViews[1].buffer"},
      {"validator/base/node/node_loop.gltf", "is its own ancestor"},
      {"validator/base/mesh_data/index_buffer_oob.gltf", "meshes[0].primitives[0].indices"}};
  for (const auto& [path, text] : expected) {
    try {
      LoadGltf(CorpusPath() / "malformed" / path);
      ADD_FAILURE() << path << " loads";
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(text), std::string::npos) << error.what();
    }
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
