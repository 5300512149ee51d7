// facet hash and facet verify as their users run them.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <regex>

#include "base/input_file.h"
#include "cli/program.h"
#include "cli/tiny_scene.h"
#include "facet/film.h"
#include "facet/load.h"
#include "image/codec.h"

namespace facet::test {
namespace {

class FacetHash : public testing::Test {
 protected:
  FacetHash() { WriteText(in_, TinyScene()); }

  nlohmann::json Hash(std::vector<std::string> more) const {
    more.insert(more.begin(), {"hash", in_, "--json", "--size", "32x32"});
    const Outcome run = RunFacet(more);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return nlohmann::json::parse(run.out);
  }

  // Draws in_ into picture_.
  void Draw(std::vector<std::string> more = {}) const {
    more.insert(more.begin(), {"render", in_, "-o", picture_, "--quiet", "--size", "32x24", "--orbit", "20,70"});
    const Outcome run = RunFacet(more);
    ASSERT_EQ(run.exit_code, 0) << run.err;
  }

  // Writes picture_ anew with the same text, its pixels changed.
  void Retouch(const std::function<void(Image&)>& change) const {
    const auto text = ReadImageText(ReadFile(picture_).Span(), "picture");
    Image image = LoadImage(picture_);
    change(image);
    std::vector<std::array<std::string, 2>> pairs;
    for (const auto& [key, value] : text) pairs.push_back({key, value});
    WriteImage(picture_, image, pairs);
  }

  const Folder folder_;
  const std::string in_ = folder_ / "scene.gltf", picture_ = folder_ / "picture.png";
};

TEST_F(FacetHash, PrintsOneDigestALine) {
  const Outcome run = RunFacet({"hash", in_, "--size", "32x32"});
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_EQ(run.err, "");
  const std::string digest = "[0-9a-f]{64}\n";
  EXPECT_TRUE(std::regex_match(
      run.out, std::regex("film         " + digest + "pixels       " + digest + "description  " + digest +
                          "geometry     " + digest + "textures     " + digest + "environment  " + digest)))
      << run.out;
}

TEST_F(FacetHash, EachOptionChangesItsOwn) {
  const nlohmann::json base = Hash({});
  const auto changed = [&](const std::vector<std::string>& options) {
    const nlohmann::json now = Hash(options);
    std::string list;
    for (const auto& [key, value] : base.items()) {
      if (now[key] != value) list += key + " ";
    }
    return list;
  };
  EXPECT_EQ(changed({}), "");
  EXPECT_EQ(changed({"--threads", "3"}), "");
  EXPECT_EQ(changed({"--tile-size", "8"}), "");
  EXPECT_EQ(changed({"--exposure", "1"}), "pixels ");
  EXPECT_EQ(changed({"--bits", "16"}), "pixels ");
  EXPECT_EQ(changed({"--orbit", "20,70"}), "film pixels ");
  EXPECT_EQ(changed({"--scene", "Lit", "--environment", "none"}), "environment film pixels ");
  EXPECT_TRUE(Hash({"--environment", "none"})["environment"].is_null());
}

TEST_F(FacetHash, PlanesThatAreAskedForFollowTheFilm) {
  const Outcome plain = RunFacet({"hash", in_, "--size", "32x32"});
  const Outcome run = RunFacet({"hash", in_, "--size", "32x32", "--planes", "triangle,depth"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  const std::string digest = "[0-9a-f]{64}\n";
  std::smatch planes;
  ASSERT_TRUE(std::regex_search(run.out, planes, std::regex("triangle     " + digest + "depth        " + digest)));
  EXPECT_EQ(planes.prefix().str() + planes.suffix().str(), plain.out);
  EXPECT_EQ(planes.prefix().str().rfind("film ", 0), 0u);

  const nlohmann::json json = Hash({"--planes", "depth"}), eight = Hash({"--planes", "depth", "--samples", "8"});
  EXPECT_EQ(json["planes"].size(), 1u);
  EXPECT_NE(run.out.find(json["planes"]["depth"].get<std::string>()), std::string::npos);
  EXPECT_NE(json["planes"]["depth"], eight["planes"]["depth"]);
  EXPECT_FALSE(Hash({}).contains("planes"));

  for (const char* wrong : {"dpth", "depth,depth", "depth,"}) {
    const Outcome refused = RunFacet({"hash", in_, "--planes", wrong});
    EXPECT_EQ(refused.exit_code, 2) << wrong;
    EXPECT_TRUE(IsOneErrorLine(refused.err)) << refused.err;
  }
  EXPECT_NE(RunFacet({"hash", in_, "--planes", "dpth"}).err.find("depth or triangle"), std::string::npos);
}

TEST_F(FacetHash, TellsWhatIsWrongAsRenderDoes) {
  EXPECT_EQ(RunFacet({"hash", folder_ / "nothing.glb"}).exit_code, 3);
  EXPECT_EQ(RunFacet({"hash", in_, "--camera", "Front", "--fov", "30"}).exit_code, 2);
  EXPECT_TRUE(IsOneErrorLine(RunFacet({"hash", in_, "--size", "0x1"}).err));
}

TEST_F(FacetHash, VerifyFindsThePictureEqual) {
  for (const std::vector<std::string>& options :
       std::vector<std::vector<std::string>>{{},
                                             {"--scene", "Lit", "--exposure", "-1.5", "--bits", "16"},
                                             {"--background", "teal", "--tonemap", "aces"},
                                             {"--animation", "Slide", "--time", "0.5", "--target", "5,0,0"},
                                             {"--variant", "Blue", "--fov", "30", "--samples", "8"},
                                             {"--environment", "none"}}) {
    Draw(options);
    const Outcome run = RunFacet({"verify", picture_, in_, "--threads", "2"});
    EXPECT_EQ(run.exit_code, 0) << run.out << run.err << ::testing::PrintToString(options);
    EXPECT_EQ(run.out.rfind("equal: film ", 0), 0u);
  }
}

TEST_F(FacetHash, VerifyFindsTheEnvironmentBesideTheScene) {
  Image sky{2, 1, 3, ChannelType::U8, Encoding::Srgb, std::vector<std::byte>(6, std::byte(200))};
  const std::string elsewhere = folder_ / "sky";
  std::filesystem::create_directory(elsewhere);
  WriteImage(elsewhere + "/sky.png", sky);
  Draw({"--scene", "Lit", "--environment", elsewhere + "/sky.png"});
  EXPECT_EQ(ReadImageText(ReadFile(picture_).Span(), "picture").at("facet:settings").find(elsewhere), std::string::npos)
      << "folders of this machine stay out of pictures";
  const Outcome lost = RunFacet({"verify", picture_, in_});
  EXPECT_EQ(lost.exit_code, 2);
  EXPECT_NE(lost.err.find("sky.png"), std::string::npos);
  EXPECT_EQ(RunFacet({"verify", picture_, in_, "--environment", elsewhere + "/sky.png"}).exit_code, 0);
  WriteImage(folder_ / "sky.png", sky);
  EXPECT_EQ(RunFacet({"verify", picture_, in_}).exit_code, 0);
}

TEST_F(FacetHash, VerifySaysWhereTheSceneDiffers) {
  Draw();
  std::string scene = TinyScene();
  const std::size_t red = scene.find("\"baseColorFactor\"");
  ASSERT_NE(red, std::string::npos);
  scene.replace(scene.find('[', red), scene.find(']', red) + 1 - scene.find('[', red), "[0.5, 0, 0, 1]");
  WriteText(in_, scene);
  const Outcome run = RunFacet({"verify", picture_, in_});
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_NE(run.out.find("another film"), std::string::npos) << run.out;
  const nlohmann::json json = nlohmann::json::parse(RunFacet({"verify", picture_, in_, "--json"}).out);
  EXPECT_FALSE(json["equal"]);
  EXPECT_TRUE(json["intact"]);
  EXPECT_FALSE(json["film"]["equal"]);
  EXPECT_GT(json["pixels"]["differing"], 0);
}

TEST_F(FacetHash, VerifyTellsARetouchedPictureFromAChangedScene) {
  Draw();
  Retouch([](Image& image) {
    image.bytes[4 * (32 * 5 + 7)] ^= std::byte(0x80);        // column 7, row 5
    image.bytes[4 * (32 * 11 + 20) + 1] ^= std::byte(0x01);  // column 20, row 11
  });
  const nlohmann::json json = nlohmann::json::parse(RunFacet({"verify", picture_, in_, "--json"}).out);
  EXPECT_FALSE(json["equal"]);
  EXPECT_FALSE(json["intact"]);
  EXPECT_TRUE(json["film"]["equal"]);
  EXPECT_EQ(json["pixels"]["differing"], 2);
  EXPECT_EQ(json["pixels"]["rectangle"], (nlohmann::json{{"left", 7}, {"top", 5}, {"right", 20}, {"bottom", 11}}));
  EXPECT_EQ(json["pixels"]["largest"]["x"], 7);
  EXPECT_EQ(json["pixels"]["largest"]["y"], 5);
  EXPECT_NEAR(json["pixels"]["largest"]["difference"], 128.0 / 255.0, 1e-6);
}

TEST_F(FacetHash, VerifyRefusesPicturesThatFacetDidNotWrite) {
  const Image plain{1, 1, 3, ChannelType::U8, Encoding::Srgb, std::vector<std::byte>(3)};
  WriteImage(picture_, plain);
  Outcome run = RunFacet({"verify", picture_, in_});
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_TRUE(IsOneErrorLine(run.err)) << run.err;
  WriteText(picture_, "no PNG at all");
  EXPECT_EQ(RunFacet({"verify", picture_, in_}).exit_code, 2);
  EXPECT_EQ(RunFacet({"verify", folder_ / "none.png", in_}).exit_code, 2);
  Draw();
  EXPECT_EQ(RunFacet({"verify", picture_, folder_ / "none.glb"}).exit_code, 2);
  Retouch([](Image& image) {
    image.height /= 2;
    image.bytes.resize(image.bytes.size() / 2);
  });
  run = RunFacet({"verify", picture_, in_});
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_TRUE(IsOneErrorLine(run.err)) << run.err;
}

}  // namespace
}  // namespace facet::test
