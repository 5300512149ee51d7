// facet diff: what it prints and how it ends.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/program.h"
#include "facet/film.h"
#include "facet/load.h"

namespace facet::test {
namespace {

Image Grey(int width, int height, std::uint8_t code) {
  Image image;
  image.width = width;
  image.height = height;
  image.channels = 3;
  image.bytes.assign(image.PixelCount() * 3, static_cast<std::byte>(code));
  return image;
}

class FacetDiff : public ::testing::Test {
 protected:
  FacetDiff() {
    Image grey = Grey(24, 16, 128);
    WriteImage(a_, grey);
    grey.As<std::uint8_t>()[(5 * 24 + 7) * 3] = 138;
    WriteImage(b_, grey);
    WriteImage(wide_, Grey(25, 16, 128));
  }

  const Folder folder_;
  const std::string a_ = folder_ / "a.png", b_ = folder_ / "b.png", wide_ = folder_ / "wide.png";
};

TEST_F(FacetDiff, EqualPicturesEndWithZero) {
  const Outcome run = RunFacet({"diff", a_, a_});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(run.err, "");
  EXPECT_NE(run.out.find("24x16, equal"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("inf dB"), std::string::npos) << run.out;
}

TEST_F(FacetDiff, OtherPicturesEndWithOne) {
  const Outcome run = RunFacet({"diff", a_, b_});
  EXPECT_EQ(run.exit_code, 1) << run.err;
  EXPECT_EQ(run.err, "");
  EXPECT_NE(run.out.find("24x16, different"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("0.0392157 at 7,5"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("1 of 384"), std::string::npos) << run.out;
}

TEST_F(FacetDiff, AllThresholdsMustBeKept) {
  struct Case {
    std::vector<std::string> thresholds;
    int exit_code;
  };
  // One channel of one pixel by 10 / 255: RMSE 10 / 255 / sqrt(1152) = 0.00115541, PSNR 58.745 dB.
  const std::vector<Case> cases = {
      {{"--max-difference", "0.0393"}, 0},
      {{"--max-difference", "0.0392"}, 1},
      {{"--max-pixels", "1"}, 0},
      {{"--max-pixels", "0"}, 1},
      {{"--max-rmse", "0.001156"}, 0},
      {{"--max-rmse", "0.001155"}, 1},
      {{"--min-psnr", "58.7"}, 0},
      {{"--min-psnr", "58.8"}, 1},
      {{"--min-ssim", "0.5"}, 0},
      {{"--min-ssim", "1"}, 1},
      {{"--max-flip", "0.5"}, 0},
      {{"--max-flip", "0"}, 1},
      {{"--max-pixels", "1", "--max-difference", "0.1", "--max-flip", "0.5"}, 0},
      {{"--max-pixels", "1", "--max-difference", "0.01", "--max-flip", "0.5"}, 1},
  };
  for (const Case& c : cases) {
    std::vector<std::string> arguments = {"diff", a_, b_};
    arguments.insert(arguments.end(), c.thresholds.begin(), c.thresholds.end());
    const Outcome run = RunFacet(arguments);
    EXPECT_EQ(run.exit_code, c.exit_code) << c.thresholds[0] << " " << c.thresholds[1] << run.err;
    EXPECT_EQ(run.out.find("verdict") != std::string::npos, c.exit_code == 1) << run.out;
  }
}

TEST_F(FacetDiff, JsonHasStableKeys) {
  const nlohmann::json other = nlohmann::json::parse(RunFacet({"diff", a_, b_, "--json", "--max-pixels", "0"}).out);
  EXPECT_EQ(other["a"], a_);
  EXPECT_EQ(other["b"], b_);
  EXPECT_EQ(other["width"], 24);
  EXPECT_EQ(other["height"], 16);
  EXPECT_EQ(other["compared"], "encoded");
  EXPECT_EQ(other["equal"], false);
  EXPECT_EQ(other["within"], false);
  EXPECT_EQ(other["beyond"], nlohmann::json{"the number of differing pixels 1 is above 0"});
  EXPECT_NEAR(other["max_difference"].get<double>(), 10.0 / 255.0, 1e-12);
  EXPECT_EQ(other["max_difference_at"], (nlohmann::json{7, 5}));
  EXPECT_EQ(other["differing_pixels"], 1);
  EXPECT_EQ(other["non_finite_pixels"], (nlohmann::json{0, 0}));
  EXPECT_GT(other["rmse"].get<double>(), 0.0);
  EXPECT_NEAR(other["psnr_db"].get<double>(), 58.745, 1e-3);
  EXPECT_LT(other["ssim"].get<double>(), 1.0);
  EXPECT_EQ(other["flip"]["kind"], "LDR");
  EXPECT_GT(other["flip"]["max"].get<double>(), other["flip"]["mean"].get<double>());
  EXPECT_NEAR(other["flip"]["pixels_per_degree"].get<double>(), 67.02, 0.01);

  const nlohmann::json same = nlohmann::json::parse(RunFacet({"diff", a_, a_, "--json"}).out);
  EXPECT_EQ(same["equal"], true);
  EXPECT_EQ(same["within"], true);
  EXPECT_TRUE(same["beyond"].empty());
  EXPECT_TRUE(same["psnr_db"].is_null());
  EXPECT_TRUE(same["max_difference_at"].is_null());
}

TEST_F(FacetDiff, PixelsPerDegreeChangeFlip) {
  const auto flip = [&](const std::string& pixels_per_degree) {
    const Outcome run = RunFacet({"diff", a_, b_, "--json", "--pixels-per-degree", pixels_per_degree});
    return nlohmann::json::parse(run.out)["flip"]["max"].get<double>();
  };
  EXPECT_GT(flip("5"), 2.0 * flip("100"));
}

TEST_F(FacetDiff, HeatMapShowsWhere) {
  const std::string heat = folder_ / "heat.png", spot = folder_ / "spot.png";
  Image spotted = Grey(24, 16, 128);
  for (int i = 0; i < 3; ++i) spotted.As<std::uint8_t>()[(5 * 24 + 7) * 3 + i] = 255;
  WriteImage(spot, spotted);
  EXPECT_EQ(RunFacet({"diff", a_, spot, "-o", heat}).exit_code, 1);
  const Image map = LoadImage(heat);
  ASSERT_EQ(map.width, 24);
  ASSERT_EQ(map.height, 16);
  ASSERT_EQ(map.channels, 3);
  const std::uint8_t* rgb = map.As<std::uint8_t>();
  EXPECT_EQ(rgb[(15 * 24 + 23) * 3], 0);
  EXPECT_EQ(rgb[(15 * 24 + 23) * 3 + 2], 4);
  EXPECT_GT(rgb[(5 * 24 + 7) * 3], 60);

  EXPECT_EQ(RunFacet({"diff", a_, a_, "-o", heat}).exit_code, 0);
  const Image black = LoadImage(heat);
  for (std::size_t i = 0; i < black.bytes.size(); ++i) ASSERT_EQ(black.As<std::uint8_t>()[i], i % 3 == 2 ? 4 : 0);
}

TEST_F(FacetDiff, ErrorsEndWithTwoAndOneLine) {
  const std::string corrupt = folder_ / "corrupt.png", text = folder_ / "text.png", out = folder_ / "out.png";
  WriteText(corrupt, ReadText(a_).substr(0, 60));
  WriteText(text, "no picture");
  struct Case {
    std::vector<std::string> arguments;
    std::string says;
  };
  const std::vector<Case> cases = {
      {{a_, folder_ / "none.png"}, "none.png"},
      {{folder_ / "none.png", b_}, "none.png"},
      {{a_, corrupt}, "corrupt.png"},
      {{text, b_}, "text.png"},
      {{a_, wide_}, "24x16 and 25x16"},
      {{a_, wide_, "--max-pixels", "100000"}, "wide.png"},
      {{a_, b_, "-o", folder_ / "nowhere/out.png"}, "does not exist"},
      {{a_, b_, "-o", folder_ / "out.xyz"}, "'.xyz'"},
      {{a_, b_, "-o", folder_ / "out.exr"}, "write .png"},
      {{a_}, ""},
      {{}, ""},
      {{a_, b_, a_}, "unexpected argument"},
      {{a_, b_, "--max-flp", "1"}, "did you mean '--max-flip'"},
      {{a_, b_, "--max-flip", "much"}, "--max-flip"},
      {{a_, b_, "--max-flip", "nan"}, "--max-flip"},
      {{a_, b_, "--max-difference", "-1"}, "--max-difference"},
      {{a_, b_, "--max-pixels", "1.5"}, "--max-pixels"},
      {{a_, b_, "--pixels-per-degree", "0"}, "1 to 1000"},
  };
  const std::vector<std::string> before = folder_.Files();
  for (const Case& c : cases) {
    std::vector<std::string> arguments = c.arguments;
    arguments.insert(arguments.begin(), "diff");
    std::string line;
    for (const std::string& argument : arguments) line += " " + argument;
    const Outcome run = RunFacet(arguments);
    EXPECT_EQ(run.exit_code, 2) << line << "\n" << run.err;
    EXPECT_TRUE(IsOneErrorLine(run.err)) << line << "\n" << run.err;
    EXPECT_NE(run.err.find(c.says), std::string::npos) << line << "\n" << run.err;
    EXPECT_EQ(run.out, "") << line;
  }
  EXPECT_EQ(folder_.Files(), before);
}

TEST_F(FacetDiff, FullOutputIsAnError) {
  // Nobody may take a table that was cut off for a comparison.
  EXPECT_EQ(RunFacet({"diff", a_, a_}, {.max_file_bytes = 10}).exit_code, 2);
}

}  // namespace
}  // namespace facet::test
