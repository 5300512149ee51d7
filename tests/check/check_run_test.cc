// Verdicts: what passes, what does not, what an update writes.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <vector>

#include "base/input_file.h"
#include "cli/scratch.h"
#include "facet/check.h"
#include "facet/error.h"
#include "facet/film.h"
#include "facet/load.h"
#include "facet/render.h"
#include "image/codec.h"
#include "settings/provenance.h"

namespace facet::test {
namespace {

using Json = nlohmann::ordered_json;

const std::string kWrongHash(64, '0');

class CheckFile : public Scratch {
 protected:
  // One entry of the manifest; `more` follows the scene.
  static std::string Entry(const std::string& name, const std::string& more = "",
                           const std::string& scene = "tiny.gltf") {
    return "{\"name\": \"" + name + "\", \"scene\": \"" + scene + "\"" + (more.empty() ? "" : ", " + more) + "}";
  }
  CheckedEntry Only(const CheckOptions& options = {}) const {
    const CheckReport report = CheckManifest(folder_ / "goldens.json", options);
    EXPECT_EQ(report.entries.size(), 1u);
    return report.entries.at(0);
  }
  CheckedEntry Update() const {
    CheckOptions options;
    options.update = true;
    return Only(options);
  }
  Json ReadJson() const { return Json::parse(Read("goldens.json")); }
  void WriteJson(const Json& json) const { Write("goldens.json", json.dump(2) + "\n"); }
  std::vector<std::string> Files() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_)) {
      if (entry.is_regular_file()) names.push_back(entry.path().lexically_relative(folder_).string());
    }
    std::sort(names.begin(), names.end());
    return names;
  }
  // The golden picture with one channel of one pixel moved by `steps` of 255.
  void Disturb(const std::string& picture, int steps) const {
    Image image = LoadImage(folder_ / picture);
    std::uint8_t& value = image.As<std::uint8_t>()[0];
    value = static_cast<std::uint8_t>(value < 128 ? value + steps : value - steps);
    WriteImage(folder_ / picture, image);
  }
};

TEST_F(CheckFile, WithoutExpectationFailsUntilUpdated) {
  Manifest(Entry("a"));
  const CheckedEntry before = Only();
  EXPECT_EQ(before.verdict, Verdict::Failed);
  EXPECT_EQ(before.message, "has no expectation; run with --update");
  EXPECT_EQ(Update().verdict, Verdict::Updated);
  const CheckedEntry after = Only();
  EXPECT_EQ(after.verdict, Verdict::Passed);
  EXPECT_EQ(after.message, "");
  EXPECT_EQ(after.film, after.expected_film);
  EXPECT_EQ(after.film, before.film);
}

// The hash is the film's, and the film is what Render() gives.
TEST_F(CheckFile, TheHashIsThatOfTheFilm) {
  Manifest(Entry("a", R"("settings": {"samples": 8})"));
  RenderSettings settings;
  settings.width = 48;
  settings.height = 32;
  settings.samples = 8;
  EXPECT_EQ(Only().film, HashFilm(Render(LoadGltf(folder_ / "tiny.gltf").scene, settings)));
}

TEST_F(CheckFile, EqualFilmsAreDecidedWithoutAnyPicture) {
  Manifest(Entry("a"));
  Update();
  const std::vector<std::string> files = Files();
  CheckOptions options;
  options.pictures = true;
  const CheckedEntry entry = Only(options);
  EXPECT_EQ(entry.verdict, Verdict::Passed);
  EXPECT_TRUE(entry.expected.empty() && entry.actual.empty() && entry.heat_map.empty() && !entry.difference);
  EXPECT_EQ(Files(), files);
}

// The film does not know of exposure, tone curve and background: the picture does.
TEST_F(CheckFile, EqualFilmsAreEncodedAsTheirPictureWas) {
  Manifest(Entry("a", R"("settings": {"exposure": 1}, "expect": {"picture": "a.png"})"));
  Update();
  EXPECT_EQ(Only().verdict, Verdict::Passed);
  Json json = ReadJson();
  json["entries"][0]["settings"]["exposure"] = -1;
  WriteJson(json);
  const CheckedEntry entry = Only();
  EXPECT_EQ(entry.verdict, Verdict::Failed);
  EXPECT_EQ(entry.film, entry.expected_film);
  EXPECT_EQ(entry.message.rfind("the film is equal, the encoded image is not: ", 0), 0u) << entry.message;
  json["entries"][0]["expect"]["max-flip"] = 1;
  WriteJson(json);
  EXPECT_EQ(Only().verdict, Verdict::Passed);
}

TEST_F(CheckFile, AMissingOrBrokenPictureIsAnErrorThoughTheFilmIsEqual) {
  Manifest(Entry("a", R"("expect": {"picture": "a.png"})"));
  Update();
  Write("a.png", "no picture");
  CheckedEntry entry = Only();
  EXPECT_EQ(entry.verdict, Verdict::Error);
  EXPECT_NE(entry.place.find("/entries/0/expect/picture"), std::string::npos) << entry.place;
  std::filesystem::remove(folder_ / "a.png");
  EXPECT_EQ(Only().verdict, Verdict::Error);
  EXPECT_EQ(Update().verdict, Verdict::Updated);
  EXPECT_EQ(Only().verdict, Verdict::Passed);
}

TEST_F(CheckFile, AnotherFilmFailsThoughThePictureIsEqual) {
  Manifest(Entry("a", R"("expect": {"picture": "a.png"})"));
  Update();
  Json json = ReadJson();
  json["entries"][0]["expect"]["film"] = kWrongHash;
  WriteJson(json);
  CheckOptions options;
  options.pictures = true;
  const CheckedEntry entry = Only(options);
  EXPECT_EQ(entry.verdict, Verdict::Failed);
  ASSERT_TRUE(entry.difference);
  EXPECT_TRUE(entry.difference->equal);
  EXPECT_EQ(entry.difference->flip_map.bytes.size(), 0u);
  EXPECT_EQ(entry.message,
            "the film differs; the picture is equal; the inputs are the same: the settings or the "
            "renderer differ");
  EXPECT_FALSE(entry.expected.empty() || entry.actual.empty() || entry.heat_map.empty());
  options.pictures = false;
  EXPECT_TRUE(Only(options).actual.empty());
}

TEST_F(CheckFile, ThresholdsLetAnotherFilmPass) {
  Manifest(Entry("a", R"("expect": {"picture": "a.png", "max-difference": 0.05})"));
  Update();
  Disturb("a.png", 10);
  EXPECT_EQ(Only().verdict, Verdict::Passed);  // by its hash
  Json json = ReadJson();
  json["entries"][0]["expect"]["film"] = kWrongHash;
  WriteJson(json);
  const CheckedEntry within = Only();
  EXPECT_EQ(within.verdict, Verdict::Within);
  EXPECT_EQ(within.message.rfind("the film differs; within thresholds: ", 0), 0u) << within.message;
  ASSERT_TRUE(within.difference);
  EXPECT_EQ(within.difference->differing_pixels, 1u);
  EXPECT_NEAR(within.difference->max_difference, 10.0 / 255.0, 1e-9);
  Disturb("a.png", 10);
  const CheckedEntry beyond = Only();
  EXPECT_EQ(beyond.verdict, Verdict::Failed);
  EXPECT_NE(beyond.message.find("0.0784314 is above 0.05"), std::string::npos) << beyond.message;
}

TEST_F(CheckFile, APictureAloneMustBeEqualOrWithin) {
  Manifest(Entry("a", R"("expect": {"picture": "a.png"})"));
  Update();
  Json json = ReadJson();
  json["entries"][0]["expect"].erase("film");
  WriteJson(json);
  EXPECT_EQ(Only().verdict, Verdict::Passed);
  Disturb("a.png", 1);
  EXPECT_EQ(Only().verdict, Verdict::Failed);
  json["entries"][0]["expect"]["max-pixels"] = 1;
  WriteJson(json);
  EXPECT_EQ(Only().verdict, Verdict::Within);
  json["entries"][0]["expect"]["max-pixels"] = 0;
  WriteJson(json);
  EXPECT_EQ(Only().verdict, Verdict::Failed);
}

TEST_F(CheckFile, SaysWhichInputDiffers) {
  Manifest(Entry("a", R"("settings": {"environment": "sky.png"})"));
  const auto write_sky = [&](std::uint8_t grey) {
    WriteImage(folder_ / "sky.png",
               Image{4, 2, 3, ChannelType::U8, Encoding::Srgb, std::vector<std::byte>(24, std::byte(grey))});
  };
  write_sky(100);
  Json json = Json::parse(Read("goldens.json"));
  json["entries"][0]["settings"]["scene"] = "Lit";
  WriteJson(json);
  Update();
  EXPECT_EQ(Only().verdict, Verdict::Passed);
  write_sky(101);
  EXPECT_EQ(Only().message,
            "the film differs; the inputs differ: environment (another file, or another version of its decoder?)");
  write_sky(100);
  std::string scene = Read("tiny.gltf");
  scene.replace(scene.find("\"metallicFactor\": 0"), 19, "\"metallicFactor\": 1");
  Write("tiny.gltf", scene);
  EXPECT_NE(Only().message.find("the inputs differ: description ("), std::string::npos) << Only().message;
  Write("tiny.gltf", TinyScene());
  json = ReadJson();
  json["entries"][0]["settings"]["samples"] = 1;
  WriteJson(json);
  EXPECT_NE(Only().message.find("the inputs are the same"), std::string::npos) << Only().message;
}

TEST_F(CheckFile, AnUpdateIsMinimalAndTheNextOneChangesNothing) {
  Manifest(Entry("a", R"("expect": {"picture": "deep/a.png"})") + "," + Entry("b") + "," +
           Entry("c", R"("settings": {"samples": 1})"));
  CheckOptions options;
  options.update = true;
  EXPECT_EQ(CheckManifest(folder_ / "goldens.json", options).Count(Verdict::Updated), 3u);
  const std::string manifest = Read("goldens.json"), picture = Read("deep/a.png");
  EXPECT_EQ(CheckManifest(folder_ / "goldens.json", options).Count(Verdict::Passed), 3u);
  EXPECT_EQ(Read("goldens.json"), manifest);
  EXPECT_EQ(Read("deep/a.png"), picture);
  EXPECT_EQ(Files(), (std::vector<std::string>{"deep/a.png", "goldens.json", "tiny.gltf"}));

  // One setting changes: lines of that entry change, and no others.
  std::string edited = manifest;
  edited.replace(edited.find("\"samples\": 1"), 12, "\"samples\": 4");
  Write("goldens.json", edited);
  const CheckReport report = CheckManifest(folder_ / "goldens.json", options);
  EXPECT_EQ(report.entries[2].verdict, Verdict::Updated);
  EXPECT_EQ(report.Count(Verdict::Passed), 2u);
  Json before = Json::parse(edited), after = ReadJson();
  EXPECT_NE(before["entries"][2]["expect"]["film"], after["entries"][2]["expect"]["film"]);
  after["entries"][2]["expect"]["film"] = before["entries"][2]["expect"]["film"];
  EXPECT_EQ(after.dump(2) + "\n", edited);
}

TEST_F(CheckFile, AnUpdateRewritesPicturesThatAreMissingBrokenOrStale) {
  Manifest(Entry("a", R"("expect": {"picture": "a.png"})"));
  Update();
  const std::string picture = Read("a.png"), manifest = Read("goldens.json");
  const auto expect_rewritten = [&] {
    const CheckedEntry entry = Update();
    EXPECT_EQ(entry.verdict, Verdict::Updated);
    EXPECT_EQ(entry.message, "picture written");
    EXPECT_EQ(Read("a.png"), picture);
    EXPECT_EQ(Read("goldens.json"), manifest);
  };
  std::filesystem::remove(folder_ / "a.png");
  expect_rewritten();
  Write("a.png", picture.substr(0, picture.size() / 2));
  expect_rewritten();
  Disturb("a.png", 1);
  expect_rewritten();
  const Provenance provenance = ReadProvenance(ReadFile(folder_ / "a.png").Span(), "a.png");  // it can be verified
  EXPECT_EQ(provenance.film, Only().film);
  EXPECT_EQ(provenance.settings.at("size"), "48x32");
}

TEST_F(CheckFile, OneErrorStopsNoOtherEntryAndNoUpdate) {
  Write("broken.gltf", "{");
  Write("broken.png", "\x89PNG\r\n\x1a\n and nothing else");
  WriteImage(folder_ / "small.png", Image{2, 2, 3, ChannelType::U8, Encoding::Srgb, std::vector<std::byte>(12)});
  const std::string picture = R"("expect": {"picture": "NAME.png"})";
  const auto expecting = [&](const std::string& name) {
    return std::string(picture).replace(picture.find("NAME"), 4, name);
  };
  Manifest(Entry("fine") + "," + Entry("missing scene", "", "nope.gltf") + "," +
           Entry("broken scene", "", "broken.gltf") + "," + Entry("bad", R"("settings": {"sise": 3})") + "," +
           Entry("no camera", R"("settings": {"camera": "Back"})") + "," +
           Entry("no sky", R"("settings": {"environment": "sky.hdr"})") + "," +
           Entry("missing picture", expecting("nope")) + "," + Entry("broken picture", expecting("broken")) + "," +
           Entry("small picture", expecting("small")) + "," + Entry("fine too"));
  const CheckReport report = CheckManifest(folder_ / "goldens.json");
  const std::array<std::pair<std::size_t, std::string>, 7> expected = {{{1, "/entries/1/scene"},
                                                                        {2, "/entries/2/scene"},
                                                                        {3, "/entries/3/settings/sise"},
                                                                        {4, "/entries/4/settings/camera"},
                                                                        {5, "/entries/5/settings/environment"},
                                                                        {6, "/entries/6/expect/picture"},
                                                                        {7, "/entries/7/expect/picture"}}};
  for (const auto& [index, pointer] : expected) {
    const CheckedEntry& entry = report.entries.at(index);
    EXPECT_EQ(entry.verdict, Verdict::Error) << entry.name;
    EXPECT_EQ(entry.place, (folder_ / "goldens.json").string() + ": " + pointer) << entry.message;
    EXPECT_FALSE(entry.message.empty());
    EXPECT_EQ(entry.message.find('\n'), std::string::npos);
  }
  EXPECT_EQ(report.entries[8].verdict, Verdict::Failed);  // both pictures can be shown
  EXPECT_NE(report.entries[8].message.find("is 2x2, the rendering 48x32"), std::string::npos);
  EXPECT_EQ(report.entries[0].verdict, Verdict::Failed);
  EXPECT_EQ(report.entries[9].verdict, Verdict::Failed);

  // Pictures can be written anew; what cannot be rendered stays as it is.
  const Json before = ReadJson();
  CheckOptions options;
  options.update = true;
  const CheckReport updated = CheckManifest(folder_ / "goldens.json", options);
  EXPECT_EQ(updated.Count(Verdict::Updated), 5u);
  EXPECT_EQ(updated.Count(Verdict::Error), 5u);
  const Json after = ReadJson();
  for (std::size_t i = 1; i <= 5; ++i) EXPECT_EQ(after["entries"][i], before["entries"][i]);
  EXPECT_EQ(CheckManifest(folder_ / "goldens.json").Count(Verdict::Passed), 5u);
}

TEST_F(CheckFile, AFailedWriteLeavesTheEntryAsItWas) {
  Manifest(Entry("a", R"("expect": {"picture": "tiny.gltf/a.png"})") + "," + Entry("b"));  // a file is no folder
  const Json before = ReadJson();
  CheckOptions options;
  options.update = true;
  const CheckReport report = CheckManifest(folder_ / "goldens.json", options);
  EXPECT_EQ(report.entries[0].verdict, Verdict::Error);
  EXPECT_EQ(report.entries[1].verdict, Verdict::Updated);
  EXPECT_EQ(ReadJson()["entries"][0], before["entries"][0]);
}

// The old picture and the new one are shown, and their sizes said.
TEST_F(CheckFile, AnotherSizeIsAFailureThatShowsBothPictures) {
  Manifest(Entry("a", R"("expect": {"picture": "a.png"})"));
  ASSERT_EQ(Update().verdict, Verdict::Updated);
  Json json = ReadJson();
  json["settings"]["size"] = "24x32";
  WriteJson(json);
  CheckOptions options;
  options.pictures = true;
  const CheckedEntry entry = Only(options);
  EXPECT_EQ(entry.verdict, Verdict::Failed);
  EXPECT_NE(entry.message.find("the golden picture is 48x32, the rendering 24x32"), std::string::npos) << entry.message;
  EXPECT_EQ(DecodeImage(entry.expected, "expected").width, 48);
  EXPECT_EQ(DecodeImage(entry.actual, "actual").width, 24);
  EXPECT_EQ(Update().verdict, Verdict::Updated);
  EXPECT_EQ(Only().verdict, Verdict::Passed);
}

// A texture that is not there does not fail by itself; it is told, and with `strict` it does.
TEST_F(CheckFile, WarningsAreToldAndStrictMakesThemFailures) {
  std::string scene = TinyScene(R"("images": [{"uri": "none.png"}], "textures": [{"source": 0}],)");
  const std::string red = R"("baseColorFactor": [1, 0, 0, 1])";
  Write("tiny.gltf", scene.insert(scene.find(red), R"("baseColorTexture": {"index": 0}, )"));
  Manifest(Entry("a"));
  ASSERT_EQ(Update().verdict, Verdict::Updated);
  CheckedEntry entry = Only();
  EXPECT_EQ(entry.verdict, Verdict::Passed);
  ASSERT_FALSE(entry.warnings.empty());
  EXPECT_NE(entry.warnings[0].find("none.png"), std::string::npos);
  const CheckReport report = CheckManifest(folder_ / "goldens.json");
  EXPECT_NE(CheckHtml(report).find("none.png"), std::string::npos);
  EXPECT_NE(JUnitXml(report).find("<system-out>warning: "), std::string::npos);
  EXPECT_NE(JUnitXml(report).find("none.png"), std::string::npos);
  CheckOptions options;
  options.strict = true;
  entry = Only(options);
  EXPECT_EQ(entry.verdict, Verdict::Failed);
  EXPECT_NE(entry.message.find("none.png"), std::string::npos) << entry.message;
}

// Two entries that do not fit beside one another fit after one another.
TEST_F(CheckFile, EntriesShareTheMemoryAndWhatDoesNotFitRunsAlone) {
  Manifest(Entry("a", R"("settings": {"size": 512})") + "," + Entry("b", R"("settings": {"size": 512})"));
  CheckOptions options;
  options.update = true;
  options.threads = 2;
  options.load.memory_limit = std::uint64_t{6} << 20;  // a film has 4 MiB
  CheckReport report = CheckManifest(folder_ / "goldens.json", options);
  EXPECT_EQ(report.Count(Verdict::Updated), 2u) << report.entries[0].message;
  options.load.memory_limit = std::uint64_t{3} << 20;
  report = CheckManifest(folder_ / "goldens.json", options);
  EXPECT_EQ(report.Count(Verdict::Error), 2u);
  EXPECT_NE(report.entries[1].message.find("4.0 MiB for a film of 512 x 512 pixels, and the memory limit is 3.0 MiB"),
            std::string::npos)
      << report.entries[1].message;
}

TEST_F(CheckFile, OnlySelectsByRegularExpression) {
  Manifest(Entry("helmet") + "," + Entry("helmet back") + "," + Entry("car"));
  const auto names = [&](const std::string& only) {
    CheckOptions options;
    options.only = only;
    std::string joined;
    for (const CheckedEntry& entry : CheckManifest(folder_ / "goldens.json", options).entries)
      joined += entry.name + ";";
    return joined;
  };
  EXPECT_EQ(names(""), "helmet;helmet back;car;");
  EXPECT_EQ(names("helmet"), "helmet;helmet back;");
  EXPECT_EQ(names("^helmet$"), "helmet;");
  EXPECT_EQ(names("back|car"), "helmet back;car;");
  EXPECT_THROW(names("boat"), Error);
  EXPECT_THROW(names("("), Error);
}

TEST_F(CheckFile, TheReportDoesNotDependOnThreads) {
  Write("broken.gltf", "{");
  Manifest(Entry("a", R"("expect": {"picture": "a.png", "max-flip": 0.5})") + "," + Entry("b", "", "broken.gltf") +
           "," + Entry("c", R"("settings": {"scene": "Lit"})") + "," + Entry("d", R"("settings": {"samples": 1})") +
           "," + Entry("e"));
  CheckOptions options;
  options.update = true;
  CheckManifest(folder_ / "goldens.json", options);
  Json json = ReadJson();
  json["entries"][0]["settings"]["variant"] = "Blue";
  json["entries"][3]["settings"]["samples"] = 2;
  WriteJson(json);
  options.update = false;
  options.pictures = true;
  std::vector<std::string> reports;
  for (const int threads : {1, 2, 3, 8, 0}) {
    options.threads = threads;
    CheckReport report = CheckManifest(folder_ / "goldens.json", options);
    EXPECT_EQ(report.Count(Verdict::Passed), 2u);
    report.seconds = 0.0;
    for (CheckedEntry& entry : report.entries) entry.seconds = 0.0;
    reports.push_back(CheckHtml(report) + JUnitXml(report));
  }
  for (const std::string& report : reports) EXPECT_EQ(report, reports[0]);
}

}  // namespace
}  // namespace facet::test
