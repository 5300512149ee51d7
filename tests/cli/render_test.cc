// What `facet render` draws and writes, option by option, against closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <nlohmann/json.hpp>
#include <set>

#include "cli/program.h"
#include "cli/tiny_scene.h"
#include "facet/film.h"
#include "facet/load.h"

namespace facet::test {
namespace {

using Pixel = std::array<int, 4>;

Pixel At(const Image& image, int x, int y) {
  Pixel pixel = {0, 0, 0, 255};
  const std::size_t at = (std::size_t(y) * std::size_t(image.width) + std::size_t(x)) * std::size_t(image.channels);
  for (int c = 0; c < image.channels; ++c) {
    const std::size_t i = at + std::size_t(c);
    pixel[std::size_t(c)] = image.type == ChannelType::U8 ? image.As<std::uint8_t>()[i] : image.As<std::uint16_t>()[i];
  }
  return pixel;
}

int Covered(const Image& image) {
  int count = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) count += At(image, x, y)[3] > 0 ? 1 : 0;
  }
  return count;
}

class FacetRender : public testing::Test {
 protected:
  FacetRender() { WriteText(in_, TinyScene()); }

  // Renders the tiny scene in 64 x 64 pixels without tone curve, and nothing may be said about it but `warning`.
  Image Draw(std::vector<std::string> options, const std::string& warning = {}) {
    options.insert(options.begin(), {"render", in_, "-o", out_, "--size", "64x64", "--tonemap", "none"});
    const Outcome run = RunFacet(options);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_TRUE(warning.empty() ? run.err.empty() : run.err.find(warning) != std::string::npos) << run.err;
    EXPECT_EQ(run.out, "");
    return run.exit_code == 0 ? LoadImage(out_)
                              : Image{64, 64, 4, ChannelType::U8, Encoding::Srgb, std::vector<std::byte>(64 * 64 * 4)};
  }

  Folder folder_;
  const std::string in_ = folder_ / "tiny scene é.gltf", out_ = folder_ / "out.png";
};

TEST_F(FacetRender, WritesOnePngOfTheDefaultSize) {
  const Outcome run = RunFacet({"render", in_, "-o", out_});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(run.err, "");
  EXPECT_EQ(run.out, "");
  const std::string bytes = ReadText(out_);
  EXPECT_EQ(bytes.substr(0, 8), "\x89PNG\r\n\x1a\n");
  EXPECT_NE(bytes.find("sRGB"), std::string::npos);
  const Image image = LoadImage(out_);
  EXPECT_EQ(image.width, 1024);
  EXPECT_EQ(image.height, 1024);
  EXPECT_EQ(folder_.Files(), (std::vector<std::string>{"out.png", "tiny scene é.gltf"}));
}

TEST_F(FacetRender, Size) {
  const Outcome run = RunFacet({"render", in_, "--size", "40x24", "--output=" + out_});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const Image image = LoadImage(out_);
  EXPECT_EQ(image.width, 40);
  EXPECT_EQ(image.height, 24);
  EXPECT_EQ(image.channels, 4);
}

// The square is 2 of the 8 units that the orthographic camera sees: 16 of 64 pixels, to the pixel.
TEST_F(FacetRender, CameraByNameAndIndex) {
  const Image by_name = Draw({"--camera", "Flat"});
  EXPECT_EQ(Covered(by_name), 16 * 16);
  EXPECT_EQ(At(by_name, 24, 24), (Pixel{255, 0, 0, 255}));
  EXPECT_EQ(At(by_name, 39, 39), (Pixel{255, 0, 0, 255}));
  EXPECT_EQ(At(by_name, 23, 24)[3], 0);
  EXPECT_EQ(At(by_name, 40, 39)[3], 0);
  EXPECT_EQ(Draw({"--camera", "1"}).bytes, by_name.bytes);
  EXPECT_NE(Draw({"--camera", "Front"}).bytes, by_name.bytes);
}

// Seen from 4 away with 90 degrees, half the picture is 4 high: the square takes a quarter of it.
TEST_F(FacetRender, OrbitTargetAndFov) {
  EXPECT_EQ(Covered(Draw({"--orbit", "0,90,4", "--target", "0,0,0", "--fov", "90"})), 16 * 16);
  const Image beside = Draw({"--orbit", "0,90,4", "--target=-2,0,0", "--fov", "90"});  // the square moves right
  EXPECT_EQ(Covered(beside), 16 * 16);
  EXPECT_EQ(At(beside, 40, 32)[3], 255);
  EXPECT_EQ(At(beside, 39, 32)[3], 0);
  EXPECT_EQ(Covered(Draw({"--orbit", "180,90,4", "--fov", "90"}, "turns its back to the camera")), 0)
      << "the back of the square is culled";
  EXPECT_EQ(Covered(Draw({"--orbit=0,90", "--fov", "90"})), Covered(Draw({"--orbit=0,90,0", "--fov", "90"})));
  EXPECT_GT(Covered(Draw({})), 64 * 64 / 8) << "the automatic camera frames the square";
}

TEST_F(FacetRender, Scene) {
  EXPECT_EQ(Covered(Draw({"--camera", "Flat", "--scene", "Small"})), 4 * 4);
  EXPECT_EQ(Covered(Draw({"--camera", "Flat", "--scene", "1"})), 4 * 4);
}

// At 0.2 s the square has moved by 2 units: 16 pixels.
TEST_F(FacetRender, AnimationAndTime) {
  const Image moved = Draw({"--camera", "Flat", "--animation", "Slide", "--time", "0.2"});
  EXPECT_EQ(Covered(moved), 16 * 16);
  EXPECT_EQ(At(moved, 40, 32)[3], 255);
  EXPECT_EQ(At(moved, 39, 32)[3], 0);
  EXPECT_EQ(Draw({"--camera", "Flat", "--time", "0.2"}).bytes, moved.bytes) << "--time alone: the first animation";
  EXPECT_EQ(Covered(Draw({"--camera", "Flat", "--time", "1"}, "everything is beside the view")), 0);
  EXPECT_EQ(Draw({"--camera", "Flat", "--animation", "0"}).bytes, Draw({"--camera", "Flat"}).bytes);
}

TEST_F(FacetRender, Variant) {
  EXPECT_EQ(At(Draw({"--camera", "Flat", "--variant", "Blue"}), 32, 32), (Pixel{0, 0, 255, 255}));
  EXPECT_EQ(At(Draw({"--camera", "Flat", "--variant", "Plain"}), 32, 32), (Pixel{255, 0, 0, 255}));
}

TEST_F(FacetRender, Background) {
  EXPECT_EQ(At(Draw({"--camera", "Flat", "--background", "transparent"}), 0, 0)[3], 0);
  EXPECT_EQ(At(Draw({"--camera", "Flat", "--background", "#336699"}), 0, 0), (Pixel{0x33, 0x66, 0x99, 255}));
  const Image white = Draw({"--camera", "Flat", "--background", "white"});
  EXPECT_EQ(white.channels, 3);
  EXPECT_EQ(At(white, 0, 0), (Pixel{255, 255, 255, 255}));
  EXPECT_EQ(At(white, 32, 32), (Pixel{255, 0, 0, 255}));
  EXPECT_EQ(At(Draw({"--camera", "Front", "--background", "environment"}), 0, 0)[3], 255);
}

// Half the light of linear 1 is 0.5, which sRGB writes as 188 (187.516).
TEST_F(FacetRender, Exposure) {
  EXPECT_EQ(At(Draw({"--camera", "Flat", "--exposure", "-1"}), 32, 32), (Pixel{188, 0, 0, 255}));
}

TEST_F(FacetRender, SixteenBits) {
  const Image image = Draw({"--camera", "Flat", "--bits", "16", "--exposure", "-1"});
  ASSERT_EQ(image.type, ChannelType::U16);
  EXPECT_NEAR(At(image, 32, 32)[0], 0.7353569830524495 * 65535.0, 0.51);  // IEC 61966-2-1 of 0.5
}

TEST_F(FacetRender, ToneMapsDiffer) {
  std::set<std::string> pictures;
  for (const char* curve : {"none", "reinhard", "aces", "agx", "neutral"}) {
    const Outcome run = RunFacet({"render", in_, "-o", out_, "--size", "8x8", "--scene", "Lit", "--camera", "Flat",
                                  "--environment-intensity", "3", "--tonemap", curve});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    pictures.insert(ReadText(out_));
  }
  EXPECT_EQ(pictures.size(), 5u);
}

TEST_F(FacetRender, EnvironmentLights) {
  const std::vector<std::string> lit = {"--scene", "Lit", "--camera", "Flat"};
  const auto brightness = [&](std::vector<std::string> options, const std::string& warning = {}) {
    options.insert(options.end(), lit.begin(), lit.end());
    return At(Draw(options, warning), 32, 32)[1];
  };
  EXPECT_EQ(brightness({"--environment", "none"}, "there is no environment"), 0);
  EXPECT_EQ(brightness({"--environment-intensity", "0"}, "the environment's intensity is 0"), 0);
  EXPECT_GT(brightness({}), 0);
  EXPECT_LT(brightness({"--environment-intensity", "0.25"}), brightness({"--environment-intensity", "0.5"}));

  // Half of the horizon is white: some rotation shows it to the square, another hides it.
  Image sky{32, 16, 3, ChannelType::U8, Encoding::Srgb, std::vector<std::byte>(32 * 16 * 3)};
  for (std::size_t i = 0; i < sky.bytes.size(); ++i) sky.bytes[i] = std::byte((i / 3) % 32 < 16 ? 255 : 0);
  const std::string file = folder_ / "sky.png";
  WriteImage(file, sky);
  std::vector<int> seen;
  for (const char* rotation : {"0", "90", "180", "-90"}) {
    seen.push_back(brightness({"--environment", file, "--environment-rotation", rotation}));
  }
  std::sort(seen.begin(), seen.end());
  EXPECT_GT(seen.back(), 200);
  EXPECT_LT(seen.front(), 100);
}

// One sample is all or nothing; more samples grade the edges.
TEST_F(FacetRender, Samples) {
  const auto alphas = [&](const char* samples) {
    const Image image = Draw({"--orbit", "20,70,5", "--samples", samples});
    std::set<int> values;
    for (int y = 0; y < 64; ++y) {
      for (int x = 0; x < 64; ++x) values.insert(At(image, x, y)[3]);
    }
    return values;
  };
  EXPECT_EQ(alphas("1"), (std::set<int>{0, 255}));
  EXPECT_LE(alphas("2").size(), 3u);
  EXPECT_GT(alphas("4").size(), 3u);
  EXPECT_LE(alphas("4").size(), 5u);
  EXPECT_GT(alphas("8").size(), 5u);
  EXPECT_LE(alphas("8").size(), 9u);
}

TEST_F(FacetRender, ThreadsAndTilesNeverChangeTheFile) {
  Draw({"--orbit", "20,70", "--threads", "1", "--scene", "Lit"});
  const std::string one = ReadText(out_);
  for (const char* threads : {"2", "3", "0"}) {
    Draw({"--orbit", "20,70", "--threads", threads, "--scene", "Lit"});
    EXPECT_EQ(ReadText(out_), one) << threads << " threads";
  }
  for (const char* tile : {"8", "16", "64"}) {
    Draw({"--orbit", "20,70", "--tile-size", tile, "--scene", "Lit"});
    EXPECT_EQ(ReadText(out_), one) << "tiles of " << tile;
  }
}

TEST_F(FacetRender, StatsAsATable) {
  const Outcome run = RunFacet({"render", in_, "-o", out_, "--size", "64x64", "--camera", "Flat", "--stats"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(run.out, "");
  for (const char* word : {"64x64", "load", "raster", "total", "covered pixels", "256", "peak memory"}) {
    EXPECT_NE(run.err.find(word), std::string::npos) << word;
  }
}

TEST_F(FacetRender, StatsAsJson) {
  const Outcome run = RunFacet({"render", in_, "-o", out_, "--size", "64x64", "--camera", "Flat", "--stats=json",
                                "--samples", "2", "--threads", "1"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(run.err, "");
  const nlohmann::json json = nlohmann::json::parse(run.out);
  EXPECT_EQ(json.at("input"), in_);
  EXPECT_EQ(json.at("width"), 64);
  EXPECT_EQ(json.at("samples"), 2);
  EXPECT_EQ(json.at("threads"), 1);
  EXPECT_EQ(json.at("counts").at("covered_pixels"), 256);
  EXPECT_EQ(json.at("counts").at("triangles_in"), 2);
  EXPECT_EQ(json.at("counts").at("non_finite_fragments"), 0);
  EXPECT_GT(json.at("seconds").at("total").get<double>(), 0.0);
  EXPECT_GE(json.at("seconds").at("total").get<double>(), json.at("seconds").at("render").get<double>());
  EXPECT_GT(json.at("bytes").at("peak_resident").get<double>(), 1e6);
  EXPECT_GT(json.at("bytes").at("input").get<double>(), 100.0);
  EXPECT_TRUE(json.at("warnings").empty());

  const std::string file = folder_ / "stats.json";
  ASSERT_EQ(RunFacet({"render", in_, "-o", out_, "--size", "8x8", "--stats-json", file}).exit_code, 0);
  EXPECT_EQ(nlohmann::json::parse(ReadText(file)).at("width"), 8);
}

TEST_F(FacetRender, WarningsNameUnknownExtensionsUnlessQuiet) {
  WriteText(in_, TinyScene(R"("extensionsUsed": ["ABC_unheard_of"],)"));
  Outcome run = RunFacet({"render", in_, "-o", out_, "--size", "8x8"});
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_EQ(run.err.rfind("facet: warning: ", 0), 0u) << run.err;
  EXPECT_NE(run.err.find("ABC_unheard_of"), std::string::npos) << run.err;
  run = RunFacet({"render", in_, "-o", out_, "--size", "8x8", "--quiet"});
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_EQ(run.err, "");
}

TEST_F(FacetRender, IgnoresRequiredExtensionsWhenTold) {
  WriteText(in_, TinyScene(R"("extensionsUsed": ["ABC_unheard_of"], "extensionsRequired": ["ABC_unheard_of"],)"));
  EXPECT_EQ(RunFacet({"render", in_, "-o", out_, "--size", "8x8"}).exit_code, 5);
  const Outcome run = RunFacet({"render", in_, "-o", out_, "--size", "8x8", "--ignore-required-extensions"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.err.find("ABC_unheard_of"), std::string::npos) << run.err;
  EXPECT_EQ(LoadImage(out_).width, 8);
}

TEST_F(FacetRender, ProgressOnlyWhereItIsWanted) {
  const std::vector<std::string> base = {"render", in_, "-o", out_, "--size", "256x256"};
  const auto with = [&](const char* option) {
    std::vector<std::string> arguments = base;
    arguments.emplace_back(option);
    return RunFacet(arguments).err;
  };
  EXPECT_EQ(with("--no-progress"), "");
  const std::string lines = with("--progress");  // no terminal: lines, never a bar
  EXPECT_NE(lines.find(" %\n"), std::string::npos) << lines;
  EXPECT_EQ(lines.find('\r'), std::string::npos) << lines;
}

TEST_F(FacetRender, WritesLinearExr) {
  const std::string exr = folder_ / "out.exr";
  const Outcome run = RunFacet({"render", in_, "-o", exr, "--size", "64x64", "--camera", "Flat", "--exposure", "3"});
  if (run.exit_code == 8) {
    EXPECT_TRUE(IsOneErrorLine(run.err)) << run.err;
    GTEST_SKIP() << "OpenImageIO is not installed: " << run.err;
  }
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const Image image = LoadImage(exr);
  ASSERT_EQ(image.type, ChannelType::F32);
  ASSERT_EQ(image.width, 64);
  ASSERT_EQ(image.channels, 4);
  const float* centre = image.As<float>() + (32 * 64 + 32) * 4;
  EXPECT_EQ(centre[0], 8.0f);  // 2^3, not tone-mapped
  EXPECT_EQ(centre[1], 0.0f);
  EXPECT_EQ(centre[3], 1.0f);
  EXPECT_EQ(image.As<float>()[3], 0.0f);
}

TEST_F(FacetRender, OpaqueFormatsGetAWhiteBackground) {
  const std::string jpg = folder_ / "out.jpg";
  const Outcome run = RunFacet({"render", in_, "-o", jpg, "--size", "64x64", "--camera", "Flat"});
  if (run.exit_code == 8) GTEST_SKIP() << "OpenImageIO is not installed: " << run.err;
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const Pixel corner = At(LoadImage(jpg), 0, 0);
  EXPECT_GE(corner[0], 253);
  EXPECT_GE(corner[2], 253);
}

}  // namespace
}  // namespace facet::test
