// facet report, and what facet render takes from one.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/input_file.h"
#include "cli/program.h"
#include "cli/tiny_scene.h"
#include "image/codec.h"

namespace facet::test {
namespace {

const std::string kScene = std::string(FACET_SOURCE_DIR) + "/assets/scenes/material_grid.glb";

class FacetReport : public testing::Test {
 protected:
  // A small report in stored_.
  void Measure(std::vector<std::string> more = {}) const {
    more.insert(more.begin(), {"report", kScene, "-o", stored_, "-q", "--size", "24x24", "--budget", "1s"});
    const Outcome run = RunFacet(more);
    ASSERT_EQ(run.exit_code, 0) << run.err;
  }
  Outcome Draw(std::vector<std::string> more) const {
    more.insert(more.begin(), {"render", kScene, "-o", picture_, "--size", "24x24"});
    return RunFacet(more);
  }
  nlohmann::json Taken() const {
    return nlohmann::json::parse(ReadImageText(ReadFile(picture_).Span(), "picture").at("facet:settings"));
  }

  const Folder folder_;
  const std::string stored_ = folder_ / "report.json", picture_ = folder_ / "picture.png";
};

TEST_F(FacetReport, WritesEachFormat) {
  const std::string html = folder_ / "report.html", csv = folder_ / "report.csv";
  Measure({"-o", html, "-o", csv});
  EXPECT_NE(ReadText(html).find("<svg"), std::string::npos);
  const std::string table = ReadText(csv);
  const nlohmann::json json = nlohmann::json::parse(ReadText(stored_));
  EXPECT_EQ(std::size_t(std::count(table.begin(), table.end(), '\n')), json["points"].size() + 1);
}

// What there is in any budget: how much more depends on the machine.
TEST_F(FacetReport, HasPointsInTheSmallestBudget) {
  const Outcome run = RunFacet({"report", kScene, "-o", stored_, "--size", "640x480", "--budget", "1s"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const nlohmann::json json = nlohmann::json::parse(ReadText(stored_));
  ASSERT_GE(json["points"].size(), 1u);
  EXPECT_TRUE(json["points"][0]["changed"].empty());
  EXPECT_EQ(json["settings"]["size"], "640x480");
  EXPECT_EQ(json["reference"]["batches"], 2);
  EXPECT_GT(json["reference"]["pixels"], 0);
  EXPECT_LE(json["reference"]["pixels"], 640 * 480);
  for (const nlohmann::json& point : json["points"]) {
    EXPECT_GT(point["seconds"], 0.0);
    EXPECT_GT(point["error"]["relative_rmse"], 0.0);
    EXPECT_LT(point["error"]["relative_rmse"], 1.0) << "the renderer draws what the reference draws";
  }
  const bool whole = json["reference"]["pixels"] == 640 * 480;
  EXPECT_EQ(run.err.find("of the picture's pixels") == std::string::npos, whole) << run.err;
  EXPECT_EQ(run.err.find("the budget ended after") == std::string::npos, json["complete"].get<bool>()) << run.err;
}

TEST_F(FacetReport, RenderTakesThePointThatKeepsTheBound) {
  Measure();
  nlohmann::json json = nlohmann::json::parse(ReadText(stored_));
  // Times of our own, and a second point however many there was time for.
  nlohmann::json& points = json["points"];
  points.get_ref<nlohmann::json::array_t&>().resize(1);
  points.push_back(points[0]);
  points[0]["seconds"] = 0.2;
  points[0]["error"]["relative_rmse"] = 0.01;
  points[1]["changed"] = {{"samples", "2"}};
  points[1]["seconds"] = 0.1;
  points[1]["error"]["relative_rmse"] = 0.02;
  json["complete"] = true;
  WriteText(stored_, json.dump());
  const auto drawn = [&](std::vector<std::string> bound) {
    bound.insert(bound.end(), {"--report", stored_});
    const Outcome run = Draw(bound);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return run.err;
  };
  EXPECT_EQ(drawn({"--max-error", "10"}),
            "facet: note: takes samples=2: relative RMSE 0.02 is within 10, and its 100 ms are the least of 2 such "
            "points\n");
  EXPECT_EQ(Taken()["samples"], "2");
  EXPECT_EQ(
      drawn({"--max-error", "0.015"}),
      "facet: note: takes the settings asked for: relative RMSE 0.01 is within 0.015; it is the only such point\n");
  EXPECT_EQ(Taken()["samples"], "4");
  EXPECT_EQ(drawn({"--max-time", "50ms"}),
            "facet: warning: none of 2 points keeps 50 ms; takes the nearest, samples=2: 100 ms\n");
  EXPECT_EQ(Taken()["samples"], "2");
}

// Without a report, for bounds that no machine keeps.
TEST_F(FacetReport, RenderSaysWhatIsOutOfReach) {
  const Outcome exact = Draw({"--max-error", "1e-6", "--budget", "2s"});
  EXPECT_EQ(exact.exit_code, 0) << exact.err;
  EXPECT_EQ(exact.err.rfind("facet: warning: none of 3 points keeps relative RMSE 1e-06; takes the nearest, ", 0), 0u)
      << exact.err;
  EXPECT_NE(exact.err.find("; not even the most exact settings come near it\n") == std::string::npos,
            exact.err.find("; in this budget the reference would be less exact than that; ") == std::string::npos)
      << exact.err;
  const Outcome fast = Draw({"--max-time", "0.1ms", "--budget", "2s"});
  EXPECT_EQ(fast.exit_code, 0) << fast.err;
  EXPECT_NE(fast.err.find("; not even the cheapest settings come near it\n"), std::string::npos) << fast.err;
}

TEST_F(FacetReport, StrictMakesWarningsFailures) {
  const std::string scene = folder_ / "scene.gltf";
  WriteText(scene,
            TinyScene("\"extensionsUsed\": [\"ABC_unknown\", \"KHR_materials_unlit\", \"KHR_materials_variants\"],"));
  const std::vector<std::string> arguments = {"report", scene, "-o", stored_, "-q", "--size", "8x8", "--budget", "1s"};
  std::vector<std::string> strict = arguments;
  strict.push_back("--strict");
  const Outcome refused = RunFacet(strict);
  EXPECT_EQ(refused.exit_code, 4) << refused.err;
  EXPECT_NE(refused.err.find("there is a warning"), std::string::npos) << refused.err;
  EXPECT_EQ(folder_.Files(), (std::vector<std::string>{"scene.gltf"}));
  EXPECT_EQ(RunFacet(arguments).exit_code, 0);
}

// The reference's film is larger than the picture's: 96 bytes a pixel.
TEST_F(FacetReport, TheMemoryLimitHoldsForTheReference) {
  const Outcome run = RunFacet(
      {"report", kScene, "-o", stored_, "-q", "--size", "2048x2048", "--budget", "1s", "--memory-limit", "512MiB"});
  EXPECT_EQ(run.exit_code, 7) << run.err;
  EXPECT_TRUE(IsOneErrorLine(run.err)) << run.err;
  EXPECT_NE(run.err.find("384.0 MiB for the reference"), std::string::npos) << run.err;
  Measure({"--memory-limit", "64MiB"});
}

TEST_F(FacetReport, RefusesReportsOfOtherPictures) {
  Measure({"--orbit", "30,60"});
  for (const std::vector<std::string>& options : std::vector<std::vector<std::string>>{
           {}, {"--orbit", "30,61"}, {"--orbit", "30,60", "--fov", "20"}, {"--orbit", "30,60", "--samples", "8"}}) {
    std::vector<std::string> arguments = {"--max-error", "10", "--report", stored_};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const Outcome run = Draw(arguments);
    EXPECT_EQ(run.exit_code, 2) << testing::PrintToString(options);
    EXPECT_TRUE(IsOneErrorLine(run.err)) << run.err;
  }
  EXPECT_EQ(Draw({"--max-error", "10", "--report", stored_, "--orbit", "30,60"}).exit_code, 0);
}

TEST_F(FacetReport, RefusesWhatCannotBeKept) {
  for (const std::vector<std::string>& options :
       std::vector<std::vector<std::string>>{{"--max-error", "0"},
                                             {"--max-error", "-1"},
                                             {"--max-error", "nan"},
                                             {"--max-time", "0"},
                                             {"--max-time", "-2s"},
                                             {"--max-time", "inf"},
                                             {"--report", "x.json"},
                                             {"--budget", "5s"},
                                             {"--max-error", "1", "--budget", "0"}}) {
    const Outcome run = Draw(options);
    EXPECT_EQ(run.exit_code, 2) << testing::PrintToString(options);
    EXPECT_TRUE(IsOneErrorLine(run.err)) << run.err;
  }
  for (const char* budget : {"0", "-1s", "nan", "1e9s", "0.5s"}) {
    const Outcome run = RunFacet({"report", kScene, "-o", stored_, "--budget", budget});
    EXPECT_EQ(run.exit_code, 2) << budget;
    EXPECT_NE(run.err.find("1 to 86400"), std::string::npos) << run.err;
  }
  WriteText(stored_, "{}");
  EXPECT_EQ(Draw({"--max-error", "1", "--report", stored_}).exit_code, 4);
  EXPECT_EQ(RunFacet({"report", kScene, "-o", folder_ / "report.pdf"}).exit_code, 2);
}

}  // namespace
}  // namespace facet::test
