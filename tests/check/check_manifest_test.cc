// What a manifest may hold, and where it says what is wrong.
#include <gtest/gtest.h>

#include <functional>

#include "base/least_limit.h"
#include "check/manifest.h"
#include "cli/scratch.h"
#include "facet/error.h"

namespace facet::test {
namespace {

class ManifestFile : public Scratch {
 protected:
  // What the reading of a whole manifest complains of; without the folder.
  std::string Refusal(const std::string& text) const {
    try {
      ReadManifest(Write("goldens.json", text));
    } catch (const Error& error) {
      EXPECT_EQ(error.code() == ErrorCode::InvalidInput || error.code() == ErrorCode::InvalidUsage, true);
      return Local(error.what());
    }
    return "read";
  }

  // What is wrong with the only entry.
  std::string Problem(const std::string& entry) const {
    const facet::Manifest manifest = ReadManifest(Scratch::Manifest(entry));
    EXPECT_EQ(manifest.entries.size(), 1u);
    EXPECT_TRUE(manifest.problems.empty());
    return manifest.entries.at(0).problem ? Local(manifest.entries[0].problem->what()) : "none";
  }

  std::string Local(std::string text) const {
    const std::string folder = folder_.string() + "/";
    for (std::size_t at; (at = text.find(folder)) != std::string::npos;) text.erase(at, folder.size());
    EXPECT_EQ(text.find('\n'), std::string::npos) << text;
    return text;
  }
};

bool Begins(const std::string& text, const std::string& with) { return text.rfind(with, 0) == 0; }

TEST_F(ManifestFile, IsReadWithItsSettings) {
  const facet::Manifest manifest = ReadManifest(Write("goldens.json", R"({
    "version": 1,
    "settings": {"size": "64x32", "samples": 8, "exposure": -1.5},
    "entries": [
      {"name": "a", "scene": "x/a.glb"},
      {"name": "b", "scene": "b.glb", "settings": {"samples": "2", "environment": "sky.hdr"},
       "expect": {"picture": "golden/b.png", "max-flip": 0.5, "max-pixels": 12, "min-psnr": -3}}]})"));
  EXPECT_EQ(manifest.path, folder_ / "goldens.json");
  ASSERT_EQ(manifest.entries.size(), 2u);
  const ManifestEntry& a = manifest.entries[0];
  EXPECT_EQ(a.scene, "x/a.glb");
  EXPECT_EQ(a.request.settings.width, 64);
  EXPECT_EQ(a.request.settings.samples, 8);
  EXPECT_EQ(a.request.display.exposure_ev, -1.5);
  EXPECT_FALSE(a.expect.film || a.expect.picture || a.expect.has_thresholds);
  const ManifestEntry& b = manifest.entries[1];
  EXPECT_EQ(b.request.settings.height, 32);
  EXPECT_EQ(b.request.settings.samples, 2);
  EXPECT_EQ(b.expect.picture, "golden/b.png");
  EXPECT_EQ(b.expect.thresholds.max_flip, 0.5);
  EXPECT_EQ(b.expect.thresholds.max_pixels, 12u);
  EXPECT_EQ(b.expect.thresholds.min_psnr_db, -3.0);
  EXPECT_FALSE(b.expect.thresholds.max_rmse);
  EXPECT_EQ(SettingPointer(b, "environment"), "/entries/1/settings/environment");
  EXPECT_EQ(SettingPointer(b, "size"), "/settings/size");
}

TEST_F(ManifestFile, SyntaxErrorsHaveLineAndColumn) {
  EXPECT_TRUE(Begins(Refusal("{\n  \"version\": 1,\n  }"), "goldens.json:3:3: syntax error"));
  EXPECT_TRUE(Begins(Refusal("{ \"version\" 1 }"), "goldens.json:1:13: syntax error"));
  EXPECT_TRUE(Begins(Refusal("{\"version\": 1, \"entries\": [{\"name\": \"\xff\"}]}"), "goldens.json:1:38: "));
  EXPECT_EQ(Refusal("{\"version\": 1, \"version\": 1, \"entries\": []}"),
            "goldens.json: /version: the key is twice in one object");
  EXPECT_TRUE(Begins(Refusal("{\"version\": 1e999}"), "goldens.json:1:17: number overflow"));
}

TEST_F(ManifestFile, WhatIsNoManifestIsRefused) {
  EXPECT_EQ(Refusal("[]"), "goldens.json: is no manifest: a JSON object");
  EXPECT_TRUE(Begins(Refusal("{}"), "goldens.json: has no 'version'"));
  EXPECT_TRUE(Begins(Refusal(R"({"version": 2, "entries": []})"), "goldens.json: /version: "));
  EXPECT_EQ(Refusal(R"({"version": 1})"), "goldens.json: has no 'entries'");
  EXPECT_EQ(Refusal(R"({"version": 1, "entries": {}})"), "goldens.json: /entries: is no list");
  EXPECT_EQ(Refusal(R"({"version": 1, "entries": []})"),
            "goldens.json: /entries: is empty: there is nothing to check; list a scene at least");
  // What would overflow the stack, or take time that grows with a square.
  EXPECT_EQ(Refusal(R"({"version": 1, "entries": )" + std::string(20000, '[') + std::string(20000, ']') + "}"),
            "goldens.json: JSON is nested deeper than 128 levels");
  std::string keys;
  for (int i = 0; i < 60000; ++i) keys += R"(, "key )" + std::to_string(i) + R"(": 1)";
  EXPECT_EQ(Refusal(R"({"version": 1)" + keys + "}"), "goldens.json: has more than 1000 keys");
  EXPECT_EQ(Refusal(R"({"version": 1, "settings": 3, "entries": []})"), "goldens.json: /settings: is no object");
  EXPECT_TRUE(Begins(Refusal(R"({"version": 1, "settings": {"size": "big"}, "entries": []})"),
                     "goldens.json: /settings/size: 'big' is not a size; give WIDTHxHEIGHT"));
  EXPECT_TRUE(Begins(Refusal(R"({"version": 1, "settings": {"a/b~": 1}, "entries": []})"),
                     "goldens.json: /settings/a~1b~0: there is no setting 'a/b~'; use one of size, "));
}

// Of so many, work that grows with their square would take hours.
TEST_F(ManifestFile, OtherFilesAreCalledByTheirName) {
  EXPECT_EQ(Refusal(""), "goldens.json: not JSON, but empty; fetch the file again");
  EXPECT_EQ(Refusal("\x89PNG\r\n\x1a\n...."), "goldens.json: not JSON, but a PNG picture");
  EXPECT_TRUE(Begins(Refusal("version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 1\n"),
                     "goldens.json: not JSON, but a Git LFS pointer"));
  EXPECT_TRUE(Begins(Refusal("<!DOCTYPE html><html></html>"), "goldens.json: not JSON, but an HTML page"));
}

TEST_F(ManifestFile, AHundredThousandEntriesAreReadAndCharged) {
  constexpr std::size_t kCount = 100000;
  std::string entries;
  for (std::size_t i = 0; i < kCount; ++i) {
    const std::string number = std::to_string(i);
    entries += (i ? ",{\"name\":\"" : "{\"name\":\"") + number + "\",\"scene\":\"a.glb\",\"expect\":{\"picture\":\"" +
               number + ".png\"}}";
  }
  const std::filesystem::path path = Scratch::Manifest(entries);
  EXPECT_EQ(MemoryRefusalUnder(std::uint64_t{1} << 30,
                               [&] {
                                 const facet::Manifest manifest = ReadManifest(path);
                                 ASSERT_EQ(manifest.entries.size(), kCount);
                                 for (std::size_t i = 0; i < kCount; ++i) {
                                   ASSERT_FALSE(manifest.entries[i].problem) << i;
                                   ASSERT_EQ(manifest.entries[i].name, std::to_string(i));
                                 }
                                 EXPECT_EQ(manifest.entries.back().pointer, "/entries/99999");
                               }),
            "");
  // The JSON alone does not fit, then the entries that are made of it.
  EXPECT_NE(MemoryRefusalUnder(std::uint64_t{1} << 24, [&] { ReadManifest(path); }).find(" for JSON"),
            std::string::npos);
  const std::string refusal = MemoryRefusalUnder(std::uint64_t{320} << 20, [&] { ReadManifest(path); });
  EXPECT_NE(refusal.find(" for entries"), std::string::npos) << refusal;
}

TEST_F(ManifestFile, AnUnknownKeyBesideTheEntriesLeavesThemAlone) {
  const facet::Manifest manifest =
      ReadManifest(Write("goldens.json", R"({"version": 1, "scenes": [], "entries": [{"name": "a", "scene": "b"}]})"));
  ASSERT_EQ(manifest.problems.size(), 1u);
  EXPECT_EQ(Local(manifest.problems[0].what()),
            "goldens.json: /scenes: unknown key; use one of version, settings, entries");
  ASSERT_EQ(manifest.entries.size(), 1u);
  EXPECT_FALSE(manifest.entries[0].problem);
}

TEST_F(ManifestFile, EachErrorOfAnEntryHasItsPointer) {
  EXPECT_EQ(Problem(R"({"name": "a", "scene": "b"})"), "none");
  EXPECT_EQ(Problem("3"), "goldens.json: /entries/0: is no object");
  EXPECT_EQ(Problem(R"({"scene": "b"})"), "goldens.json: /entries/0: has no 'name'");
  EXPECT_EQ(Problem(R"({"name": "a"})"), "goldens.json: /entries/0: has no 'scene'");
  EXPECT_EQ(Problem(R"({"name": "a", "scene": 3})"), "goldens.json: /entries/0/scene: is no string");
  EXPECT_EQ(Problem(R"({"name": "a", "scene": "b", "camera": 0})"),
            "goldens.json: /entries/0/camera: unknown key; use one of name, scene, settings, expect");
  for (const char* name : {"", "../a", "a/b", "a\\\\b", ".a", "a\\u0007"}) {
    EXPECT_TRUE(Begins(Problem("{\"name\": \"" + std::string(name) + "\", \"scene\": \"b\"}"),
                       "goldens.json: /entries/0/name: "))
        << name;
  }
}

TEST_F(ManifestFile, EachErrorOfASettingHasItsPointer) {
  const auto problem = [&](const std::string& settings) {
    return Problem(R"({"name": "a", "scene": "b", "settings": {)" + settings + "}}");
  };
  EXPECT_TRUE(Begins(problem(R"("size": "0x3")"), "goldens.json: /entries/0/settings/size: '0x3' is not a size; "));
  EXPECT_TRUE(Begins(problem(R"("samples": 3)"), "goldens.json: /entries/0/settings/samples: '3' is no choice; "));
  EXPECT_TRUE(Begins(problem(R"("bits": 8.5)"), "goldens.json: /entries/0/settings/bits: '8.5' is no choice; "));
  EXPECT_EQ(problem(R"("fov": true)"), "goldens.json: /entries/0/settings/fov: is no string or number");
  EXPECT_TRUE(Begins(problem(R"("threads": 3)"), "goldens.json: /entries/0/settings/threads: there is no setting "));
}

TEST_F(ManifestFile, EachErrorOfAnExpectationHasItsPointer) {
  const auto problem = [&](const std::string& expect) {
    return Problem(R"({"name": "a", "scene": "b", "expect": {)" + expect + "}}");
  };
  EXPECT_TRUE(Begins(problem(R"("film": "12")"), "goldens.json: /entries/0/expect/film: '12' is no SHA-256; "));
  EXPECT_EQ(problem(R"("film": null)"), "goldens.json: /entries/0/expect/film: is no string");
  EXPECT_TRUE(Begins(problem(R"("inputs": {"geometry": "x"})"), "goldens.json: /entries/0/expect/inputs/geometry: "));
  EXPECT_EQ(problem(R"("inputs": {"light": "x"})"),
            "goldens.json: /entries/0/expect/inputs/light: unknown key; use one of description, geometry, textures, "
            "environment");
  EXPECT_TRUE(Begins(problem(R"("picture": "a.jpg")"), "goldens.json: /entries/0/expect/picture: is no .png; "));
  EXPECT_TRUE(Begins(problem(R"("max-flip": 0.1)"), "goldens.json: /entries/0/expect: thresholds need a picture"));
  EXPECT_TRUE(Begins(problem(R"("max-flop": 0.1)"),
                     "goldens.json: /entries/0/expect/max-flop: unknown key; use one of "
                     "film, inputs, picture, max-flip, max-rmse, max-difference, "
                     "max-pixels, min-psnr, min-ssim"));
  const std::string picture = R"("picture": "a.png", )";
  for (const char* key : {"max-flip", "max-rmse", "max-difference", "min-psnr", "min-ssim"}) {
    EXPECT_EQ(problem(picture + "\"" + key + "\": 0.5"), "none");
    EXPECT_EQ(problem(picture + "\"" + key + "\": \"0.5\""),
              "goldens.json: /entries/0/expect/" + std::string(key) + ": is no number");
    EXPECT_TRUE(Begins(problem(picture + "\"" + key + "\": -1e300"),
                       "goldens.json: /entries/0/expect/" + std::string(key) + ": "));
  }
  for (const char* bad : {"-1", "0.5", "true"}) {
    EXPECT_EQ(problem(picture + R"("max-pixels": )" + bad),
              "goldens.json: /entries/0/expect/max-pixels: is no whole number of pixels");
  }
}

TEST_F(ManifestFile, NamesAreUnique) {
  const facet::Manifest manifest = ReadManifest(
      Scratch::Manifest(R"({"name": "a", "scene": "x"}, {"name": "b", "scene": "x"}, {"name": "a", "scene": "y"})"));
  EXPECT_FALSE(manifest.entries[0].problem);
  EXPECT_FALSE(manifest.entries[1].problem);
  ASSERT_TRUE(manifest.entries[2].problem);
  EXPECT_EQ(Local(manifest.entries[2].problem->what()),
            "goldens.json: /entries/2/name: 'a' is the name of /entries/0 too");
}

TEST_F(ManifestFile, APictureBelongsToOneEntry) {
  const facet::Manifest manifest = ReadManifest(Scratch::Manifest(
      R"({"name": "a", "scene": "x", "expect": {"picture": "p.png"}},
         {"name": "b", "scene": "x", "expect": {"picture": "q/../p.png"}})"));
  EXPECT_FALSE(manifest.entries[0].problem);
  ASSERT_TRUE(manifest.entries[1].problem);
  EXPECT_EQ(Local(manifest.entries[1].problem->what()),
            "goldens.json: /entries/1/expect/picture: is the picture of /entries/0 too");
}

TEST_F(ManifestFile, RewritingChangesNothingElse) {
  const std::string text = R"({
  "version": 1,
  "settings": {
    "size": "64x32",
    "exposure": 0.1
  },
  "entries": [
    {
      "scene": "é.glb",
      "name": "a",
      "expect": {
        "max-flip": 0.02,
        "film": "FILM",
        "picture": "a.png"
      }
    },
    {
      "name": "b",
      "scene": "b.glb"
    }
  ]
}
)";
  const std::string old_film(64, '1'), new_film(64, '2');
  std::string before = text, after = text;
  before.replace(before.find("FILM"), 4, old_film);
  after.replace(after.find("FILM"), 4, new_film);
  const std::string inputs = R"(,
        "inputs": {
          "geometry": ")" + old_film +
                             "\"\n        }";
  after.insert(after.find("\"a.png\"") + 7, inputs);
  const facet::Manifest manifest = ReadManifest(Write("goldens.json", before));
  EXPECT_EQ(Rewritten(manifest, {}), before);
  const NewExpectation expectation{0, *ParseDigest(new_film), {{}, ParseDigest(old_film), {}, {}}};
  EXPECT_EQ(Rewritten(manifest, {expectation}), after);
}

}  // namespace
}  // namespace facet::test
