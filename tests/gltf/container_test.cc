// GLB and JSON: told apart by content, cut short at every byte, nested too deep, of the wrong version.
#include <gtest/gtest.h>

#include "gltf_files.h"

namespace facet {
namespace {

using testing::FileMaker;
using testing::Glb;
using testing::LoadBytes;
using testing::LoadError;
using testing::TempFolder;
using testing::U32;

const std::string kEmpty = R"({"asset":{"version":"2.0"}})";

std::string SmallGlb() {
  FileMaker file;
  file.Attribute("POSITION", file.Triangle());
  return file.AsGlb();
}

TEST(Container, ContentDecidesNotTheName) {
  const TempFolder folder;
  EXPECT_EQ(LoadGltf(folder.Write("a.gltf", SmallGlb())).scene.meshes.size(), 1u);
  EXPECT_EQ(LoadGltf(folder.Write("b.glb", kEmpty)).scene.meshes.size(), 0u);
  EXPECT_EQ(LoadGltf(folder.Write("c.gltf", "\xEF\xBB\xBF" + kEmpty)).report.version, "2.0") << "byte order mark";
}

TEST(Container, EveryTruncationIsAnError) {
  const std::string whole = SmallGlb();
  const TempFolder folder;
  for (std::size_t length = 0; length < whole.size(); ++length) {
    const auto path = folder.Write("cut.glb", whole.substr(0, length));
    EXPECT_THROW(LoadGltf(path), Error) << length;
  }
  EXPECT_NO_THROW(LoadGltf(folder.Write("whole.glb", whole)));
}

TEST(Container, TruncatedChunksInsideAConsistentHeaderAreErrors) {
  const std::string whole = SmallGlb();
  const TempFolder folder;
  std::uint32_t json_size = 0;
  std::memcpy(&json_size, whole.data() + 12, sizeof json_size);
  for (std::size_t length = 12; length < whole.size(); ++length) {
    std::string cut = whole.substr(0, length);
    cut.replace(8, 4, U32(length));
    const auto path = folder.Write("cut.glb", cut);
    const bool at_chunk = length == 20 + json_size;  // a GLB without a BIN chunk, whose buffer has no data
    if (at_chunk) {
      EXPECT_FALSE(LoadGltf(path).report.warnings.empty());
    } else {
      EXPECT_THROW(LoadGltf(path), Error) << length;
    }
  }
}

TEST(Container, GarbageAndFlippedBytesNeverCrash) {
  const std::string whole = SmallGlb();
  const TempFolder folder;
  std::uint32_t state = 12345;
  for (int round = 0; round < 2000; ++round) {
    std::string bytes = whole;
    for (int flips = 0; flips < 3; ++flips) {
      state = state * 1664525u + 1013904223u;
      bytes[(state >> 8) % bytes.size()] = static_cast<char>(state >> 24);
    }
    try {
      LoadGltf(folder.Write("bad.glb", bytes));
    } catch (const Error& error) {
      EXPECT_NE(error.code(), ErrorCode::Internal) << error.what();
    }
  }
}

// A triangle whose JSON ends `padding` bytes before its chunk does.
struct Parts {
  std::string json, bin;
};

Parts PartsOf(std::size_t padding) {
  FileMaker file;
  file.Attribute("POSITION", file.Triangle());
  std::string json = file.Json();
  json.insert(json.end() - 1, (4 - json.size() % 4) % 4, ' ');
  return {json + std::string(padding, ' '), file.Bin()};
}

std::string GlbOf(const Parts& parts, std::size_t json_length, std::size_t bin_length, std::size_t length,
                  const std::string& tail = {}) {
  return "glTF" + U32(2) + U32(length) + U32(json_length) + "JSON" + parts.json + U32(bin_length) +
         std::string("BIN\0", 4) + parts.bin + tail;
}

bool IsWhole(const LoadedScene& loaded) {
  const auto& meshes = loaded.scene.meshes;
  return meshes.size() == 1 && meshes[0].primitives.at(0).positions.at(2) == glm::vec3(0, 1, 0);
}

TEST(Container, WrongLengthsAreWarningsThatNameThem) {
  for (const std::size_t padding : {0u, 1u, 2u, 3u, 4u}) {
    const Parts parts = PartsOf(padding);
    const std::size_t json = parts.json.size(), bin = parts.bin.size(), all = 28 + json + bin;
    const auto expect = [&](const std::string& glb, std::size_t number, const std::string& what) {
      SCOPED_TRACE(what + " " + std::to_string(number) + ", padding " + std::to_string(padding));
      LoadedScene loaded;
      ASSERT_NO_THROW(loaded = LoadBytes(glb));
      EXPECT_TRUE(IsWhole(loaded));
      ASSERT_FALSE(loaded.report.warnings.empty());
      EXPECT_NE(loaded.report.warnings[0].find(std::to_string(number)), std::string::npos) << loaded.report.warnings[0];
    };
    EXPECT_TRUE(LoadBytes(GlbOf(parts, json, bin, all)).report.warnings.empty());
    for (const std::size_t off : {1u, 2u, 3u, 4u, 5u, 7u, 8u, 16u}) {
      expect(GlbOf(parts, json, bin, all + off), all + off, "header");
      expect(GlbOf(parts, json, bin, all - off), all - off, "header");
      expect(GlbOf(parts, json - off, bin, all), json - off, "JSON chunk");
      expect(GlbOf(parts, json + off, bin, all), json + off, "JSON chunk");
      expect(GlbOf(parts, json, bin + off, all), bin + off, "BIN chunk");
      expect(GlbOf(parts, json, bin - off, all), off, "bytes after the BIN chunk");
      expect(GlbOf(parts, json, bin, all, std::string(off, 'x')), off, "bytes after the end");
      expect(GlbOf(parts, json, bin, all + off, std::string(off, 'x')), off, "bytes after the last chunk");
    }
    expect(GlbOf(parts, json, bin, 0), 0, "header");
    expect(GlbOf(parts, json, bin, 20 + json), 20 + json, "header that forgets the BIN chunk");
    expect(GlbOf(parts, json, bin, 0xFFFFFFFF), 0xFFFFFFFF, "header");
  }
}

TEST(Container, WhatIsCutOffOfNeededBytesIsAnErrorThatSaysWhatIsThere) {
  const std::string glb = SmallGlb();
  const std::string message = LoadError(glb.substr(0, glb.size() - 4), ErrorCode::InvalidInput);
  EXPECT_NE(message.find("buffers[0] has 32 bytes and declares 36"), std::string::npos) << message;
  EXPECT_NE(
      LoadError("glTF" + U32(2) + U32(99), ErrorCode::InvalidInput).find("ends after 12 bytes, within its headers"),
      std::string::npos);
}

TEST(Container, ChunkRules) {
  EXPECT_NE(LoadError("glTF" + U32(1) + U32(20) + U32(0) + "JSON", ErrorCode::Unsupported).find("version 1"),
            std::string::npos);
  LoadError("glTF" + U32(2) + U32(20) + U32(0) + std::string("BIN\0", 4), ErrorCode::InvalidInput);
  LoadError("glTF" + U32(2) + U32(20) + U32(0xFFFFFFFF) + "JSON", ErrorCode::InvalidInput);
  // An unknown chunk after JSON is skipped.
  std::string json = kEmpty;
  while (json.size() % 4) json += ' ';
  const std::string chunks = U32(json.size()) + "JSON" + json + U32(4) + "ABCD" + "....";
  EXPECT_TRUE(LoadBytes("glTF" + U32(2) + U32(12 + chunks.size()) + chunks).report.warnings.empty());
  // So is one of a type that is no word, where the chunks fill the file.
  const std::string odd = U32(json.size()) + "JSON" + json + U32(4) + U32(0x01020304) + "....";
  EXPECT_TRUE(LoadBytes("glTF" + U32(2) + U32(12 + odd.size()) + odd).report.warnings.empty());
  // Bytes after the declared end are ignored, and said to be.
  EXPECT_EQ(LoadBytes(Glb(kEmpty) + "tail").report.warnings.size(), 1u);
}

TEST(Container, NestingIsBounded) {
  for (const std::size_t depth : {std::size_t(200), std::size_t(1000000)}) {
    const std::string bomb =
        R"({"asset":{"version":"2.0"},"extras":)" + std::string(depth, '[') + std::string(depth, ']') + "}";
    EXPECT_NE(LoadError(bomb, ErrorCode::InvalidInput).find("nested"), std::string::npos);
  }
  // Brackets in strings do not count.
  EXPECT_NO_THROW(LoadBytes(R"({"asset":{"version":"2.0","generator":"\")" + std::string(1000, '[') + R"("}})"));
}

TEST(Container, NotGltfAtAll) {
  LoadError("", ErrorCode::InvalidInput);
  LoadError("PNG", ErrorCode::InvalidInput);
  LoadError("[]", ErrorCode::InvalidInput);
  LoadError("{}", ErrorCode::InvalidInput);
  LoadError(R"({"asset":{"version":"\xff"}})", ErrorCode::InvalidInput);
  for (const char* first : {R"({"asset":{"version":"1.0"}})", R"({"asset":{"version":1.0}})", R"({"meshes":{"a":{}}})",
                            R"({"asset":{"version":"1.0.1"}})", R"({"asset":{},"meshes":{"a":{}}})"}) {
    EXPECT_NE(LoadError(first, ErrorCode::Unsupported).find("glTF 1.0 is not supported; convert it to glTF 2.0"),
              std::string::npos);
  }
  LoadError(R"({"asset":{"version":"2.1","minVersion":"2.1"}})", ErrorCode::Unsupported);
  EXPECT_THROW(LoadGltf("/nonexistent/file.glb"), Error);
  const TempFolder folder;
  try {
    LoadGltf(folder.Path());
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::NotFound);
  }
}

TEST(Container, HalvesOfCharactersAreReplaced) {
  const std::pair<const char*, const char*> names[] = {{R"(a\ud800b)", "a\xEF\xBF\xBD" "b"},
                                                       {R"(\uDFFF)", "\xEF\xBF\xBD"},
                                                       {R"(\ud83d\ude00 \uD83D)", "\xF0\x9F\x98\x80 \xEF\xBF\xBD"},
                                                       {R"(\\ud800 \udc00)", "\\ud800 \xEF\xBF\xBD"}};
  for (const auto& [text, expected] : names) {
    const LoadedScene loaded =
        LoadBytes(R"({"asset":{"version":"2.0"},"nodes":[{"name":")" + std::string(text) + "\"}]}");
    EXPECT_EQ(loaded.scene.nodes.at(0).name, expected) << text;
    EXPECT_EQ(loaded.report.warnings,
              std::vector<std::string>{"nodes[0].name: has half of a character; it became U+FFFD"});
  }
}

TEST(Container, ReportSaysWhatTheAssetSays) {
  const LoadedScene loaded = LoadBytes(
      R"({"asset":{"version":"2.0","generator":"g","copyright":"c"},
          "extensionsUsed":["KHR_b","KHR_materials_unlit","A_c"],
          "extras":{"deep":[1,2]}})");
  EXPECT_EQ(loaded.report.generator, "g");
  EXPECT_EQ(loaded.report.copyright, "c");
  ASSERT_EQ(loaded.report.extensions.size(), 3u);
  EXPECT_EQ(loaded.report.extensions[0].name, "A_c");
  EXPECT_FALSE(loaded.report.extensions[1].supported);
  EXPECT_TRUE(loaded.report.extensions[2].supported);
  EXPECT_EQ(loaded.report.warnings, (std::vector<std::string>{"extensionsUsed: ignored: A_c is not supported",
                                                              "extensionsUsed: ignored: KHR_b is not supported"}));
}

TEST(Container, RequiredExtensionsAreRefusedByName) {
  const std::string json = R"({"asset":{"version":"2.0"},"extensionsUsed":["KHR_x","EXT_y","KHR_texture_transform"],
                               "extensionsRequired":["KHR_x","EXT_y","KHR_texture_transform"]})";
  const std::string message = LoadError(json, ErrorCode::Unsupported);
  EXPECT_NE(message.find("requires EXT_y, KHR_x,"), std::string::npos) << message;
  LoadOptions options;
  options.ignore_required_extensions = true;
  EXPECT_EQ(LoadBytes(json, options).report.warnings.size(), 2u);
}

// The tables of models and parameters name extensions, and beside them objects of glTF's own.
TEST(Container, OnlyExtensionsAreSupportedExtensions) {
  const auto file = [](const std::string& list, const std::string& name) {
    return R"({"asset":{"version":"2.0"},")" + list + R"(":[")" + name + R"("]})";
  };
  for (const std::string name : {"pbrMetallicRoughness", "normalTexture", "occlusionTexture"}) {
    const std::string message = LoadError(file("extensionsRequired", name), ErrorCode::Unsupported);
    EXPECT_NE(message.find("requires " + name + ","), std::string::npos) << message;
    const LoadReport used = LoadBytes(file("extensionsUsed", name)).report;
    ASSERT_EQ(used.extensions.size(), 1u);
    EXPECT_FALSE(used.extensions[0].supported) << name;
    EXPECT_EQ(used.warnings, std::vector<std::string>{"extensionsUsed: ignored: " + name + " is not supported"});
  }
  const std::string unnamed = LoadError(file("extensionsRequired", ""), ErrorCode::Unsupported);
  EXPECT_NE(unnamed.find(R"(requires "",)"), std::string::npos) << unnamed;
  for (const std::string name : {"KHR_materials_unlit", "KHR_materials_emissive_strength", "KHR_texture_transform"}) {
    const LoadReport required = LoadBytes(file("extensionsRequired", name)).report;
    ASSERT_EQ(required.extensions.size(), 1u);
    EXPECT_TRUE(required.extensions[0].supported) << name;
    EXPECT_TRUE(required.warnings.empty()) << name;
  }
}

}  // namespace
}  // namespace facet
