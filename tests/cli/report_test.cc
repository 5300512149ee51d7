// facet report, and what facet render takes from one.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "base/input_file.h"
#include "cli/program.h"
#include "image/codec.h"

namespace facet::test {
namespace {

const std::string kScene = std::string(FACET_SOURCE_DIR) + "/assets/scenes/material_grid.glb";

class FacetReport : public testing::Test {
 protected:
  // A small report in stored_.
  void Measure(std::vector<std::string> more = {}) const {
    more.insert(more.begin(), {"report", kScene, "-o", stored_, "-q", "--size", "24x24", "--budget", "3s"});
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

TEST_F(FacetReport, MeasuresWhatItSays) {
  Measure();
  const nlohmann::json json = nlohmann::json::parse(ReadText(stored_));
  ASSERT_GE(json["points"].size(), 2u);
  EXPECT_TRUE(json["points"][0]["changed"].empty());
  EXPECT_EQ(json["settings"]["size"], "24x24");
  EXPECT_GT(json["reference"]["batches"], 1);
  std::set<std::string> settings;
  for (const nlohmann::json& point : json["points"]) {
    EXPECT_TRUE(settings.insert(point["changed"].dump()).second) << "measured twice";
    EXPECT_GT(point["seconds"], 0.0);
    EXPECT_LE(point["seconds_low"], point["seconds"]);
    EXPECT_GE(point["seconds_high"], point["seconds"]);
    const double error = point["error"]["relative_rmse"];
    EXPECT_GT(error, 0.0);
    EXPECT_LT(error, 1.0) << "the renderer draws what the reference draws";
    bool dominated = false;
    for (const nlohmann::json& other : json["points"]) {
      dominated |=
          other["error"]["relative_rmse"] < point["error"]["relative_rmse"] && other["seconds"] < point["seconds"];
    }
    EXPECT_FALSE(dominated && point["pareto"]);
  }
  // Fewer coverage samples leave more error; the material grid has no textures, whose approximations are left out.
  for (const nlohmann::json& cost : json["costs"]) {
    EXPECT_NE(cost["option"], "max-anisotropy");
    EXPECT_NE(cost["option"], "texels");
    if (cost["option"] == "samples") {
      EXPECT_GT(cost["error_cheapest"], cost["error_most_exact"]);
    }
  }
  const double rounding = json["rounding"]["relative_rmse"];
  EXPECT_GT(rounding, 0.0);
  EXPECT_LT(rounding, 1e-4);
}

TEST_F(FacetReport, RenderTakesThePointThatKeepsTheBound) {
  Measure();
  const nlohmann::json json = nlohmann::json::parse(ReadText(stored_));
  const nlohmann::json* fastest = &json["points"][0];
  for (const nlohmann::json& point : json["points"]) {
    if (point["seconds"] < (*fastest)["seconds"]) fastest = &point;
  }
  const Outcome run = Draw({"--max-error", "10", "--report", stored_});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(run.err.rfind("facet: note: takes ", 0), 0u) << run.err;
  const nlohmann::json taken = Taken();
  for (const auto& [option, value] : (*fastest)["changed"].items()) EXPECT_EQ(taken[option], value);

  const Outcome impossible = Draw({"--max-time", "0.1ms", "--report", stored_});
  EXPECT_EQ(impossible.exit_code, 0);
  EXPECT_EQ(impossible.err.rfind("facet: warning: none of ", 0), 0u) << impossible.err;
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
