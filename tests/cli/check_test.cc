// `facet check`, as a continuous integration runs it.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "cli/program.h"
#include "cli/tiny_scene.h"

namespace facet::test {
namespace {

using Json = nlohmann::json;

class FacetCheck : public testing::Test {
 protected:
  FacetCheck() {
    WriteText(folder_ / "tiny.gltf", TinyScene());
    Manifest(R"({"name": "red", "scene": "tiny.gltf"}, {"name": "blue", "scene": "tiny.gltf",
      "settings": {"variant": "Blue"}, "expect": {"picture": "blue.png", "max-pixels": 0}})");
  }
  void Manifest(const std::string& entries) const {
    WriteText(manifest_, R"({"version": 1, "settings": {"size": "24x16"}, "entries": [)" + entries + "]}");
  }
  Outcome Check(std::vector<std::string> options = {}) const {
    options.insert(options.begin(), {"check", manifest_});
    return RunFacet(options);
  }
  // With another colour in the scene.
  void Recolour() const {
    std::string text = ReadText(folder_ / "tiny.gltf");
    const std::string blue = "[0, 0, 1, 1]";
    text.replace(text.find(blue), blue.size(), "[0, 1, 0, 1]");
    WriteText(folder_ / "tiny.gltf", text);
  }

  Folder folder_;
  const std::string manifest_ = folder_ / "goldens.json";
};

TEST_F(FacetCheck, GoesFromUpdateToPassedToFailed) {
  Outcome run = Check({"--update"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(run.err, "");
  EXPECT_NE(run.out.find("red   updated"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("blue  updated"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("recorded, picture written\n"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("\n2 entries: 2 updated; "), std::string::npos) << run.out;

  run = Check();
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(run.err, "");
  EXPECT_NE(run.out.find("\n2 entries: 2 passed; "), std::string::npos) << run.out;

  Recolour();
  run = Check();
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_EQ(run.err, "");
  EXPECT_NE(run.out.find("red   passed"), std::string::npos) << run.out;  // does not use it
  EXPECT_NE(run.out.find("blue  failed"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("inputs differ: description"), std::string::npos) << run.out;
  EXPECT_EQ(Check({"--only", "red"}).exit_code, 0);
}

TEST_F(FacetCheck, WritesReportsAndPicturesOfFailures) {
  Check({"--update"});
  Recolour();
  const std::string html = folder_ / "report.html", junit = folder_ / "report.xml", out = folder_ / "deep/out";
  const Outcome run = Check({"--html", html, "--junit", junit, "--output", out, "--json", "--threads", "2"});
  EXPECT_EQ(run.exit_code, 1) << run.err;
  const Json json = Json::parse(run.out);
  EXPECT_EQ(json["counts"]["passed"], 1);
  EXPECT_EQ(json["counts"]["failed"], 1);
  EXPECT_EQ(json["entries"][0]["film"], json["entries"][0]["expected_film"]);
  EXPECT_EQ(json["entries"][1]["verdict"], "failed");
  EXPECT_EQ(json["entries"][1]["place"], manifest_ + ": /entries/1");
  EXPECT_GT(json["entries"][1]["difference"]["differing_pixels"], 0);
  EXPECT_NE(ReadText(html).find("data:image/png;base64,"), std::string::npos);
  EXPECT_NE(ReadText(junit).find("<failure "), std::string::npos);
  std::vector<std::string> pictures;
  for (const auto& entry : std::filesystem::directory_iterator(out)) {
    pictures.push_back(entry.path().filename().string());
    EXPECT_EQ(ReadText(entry.path()).substr(1, 3), "PNG");
  }
  std::sort(pictures.begin(), pictures.end());
  EXPECT_EQ(pictures, (std::vector<std::string>{"blue.actual.png", "blue.difference.png"}));
}

TEST_F(FacetCheck, ErrorsAreLinesWithTheirPlaceAndTheRestStillRuns) {
  Manifest(R"({"name": "a", "scene": "tiny.gltf"}, {"name": "b", "scene": "nope.gltf"},
              {"name": "c", "scene": "tiny.gltf", "settings": {"size": "big"}})");
  const Outcome run = Check({"--update"});
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_NE(run.out.find("a  updated"), std::string::npos) << run.out;
  EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 2) << run.err;
  EXPECT_NE(run.err.find("facet: " + manifest_ + ": /entries/1/scene: "), std::string::npos) << run.err;
  EXPECT_NE(run.err.find("facet: " + manifest_ + ": /entries/2/settings/size: 'big' is not a size"), std::string::npos)
      << run.err;
}

TEST_F(FacetCheck, WhatCannotRunAtAllIsOneLineAndExitCodeTwo) {
  const auto expect_refused = [&](const std::vector<std::string>& options, const std::string& says) {
    const Outcome run = Check(options);
    EXPECT_EQ(run.exit_code, 2) << run.err;
    EXPECT_EQ(run.out, "");
    EXPECT_TRUE(IsOneErrorLine(run.err)) << run.err;
    EXPECT_NE(run.err.find(says), std::string::npos) << run.err;
  };
  expect_refused({"--only", "green"}, "no entry");
  expect_refused({"--html", folder_ / "no/folder/report.html"}, "folder");
  WriteText(manifest_, "{\n\"version\": 1,,\n}");
  expect_refused({}, manifest_ + ":2:14: ");
  std::filesystem::remove(manifest_);
  expect_refused({}, "no such file");
}

}  // namespace
}  // namespace facet::test
