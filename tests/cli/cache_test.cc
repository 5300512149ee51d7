// `facet render --cache`: the same pictures, sooner.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <thread>

#include "cli/program.h"
#include "cli/tiny_scene.h"
#include "facet/load.h"
#include "light/environment_source.h"

namespace facet::test {
namespace {

class FacetCache : public testing::Test {
 protected:
  FacetCache() {
    unsetenv("FACET_CACHE");
    WriteText(scene_, TinyScene());
    WriteSky(16, 8);
  }
  ~FacetCache() override { unsetenv("FACET_CACHE"); }

  void WriteSky(int width, int height) const {
    std::string sky = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n";
    sky += "-Y " + std::to_string(height) + " +X " + std::to_string(width) + "\n";
    for (int i = 0; i < width * height; ++i) sky += {char(10 + i % 50), char(20 + i % 30), char(60), char(0x81)};
    WriteText(sky_, sky);
  }

  // The bytes of the picture; nothing else may be said about it than `warning`.
  std::string Draw(std::vector<std::string> more, const std::string& name = "out.png",
                   const std::string& warning = {}) const {
    const Outcome run = Run(std::move(more), name);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_EQ(run.out, "");
    EXPECT_TRUE(warning.empty() ? run.err.empty() : run.err.find(warning) != std::string::npos) << run.err;
    return ReadText(folder_ / name);
  }
  Outcome Run(std::vector<std::string> more, const std::string& name = "out.png") const {
    more.insert(more.begin(), {"render", scene_, "-o", folder_ / name, "--size", "48x48", "--scene", "Lit"});
    if (std::find(more.begin(), more.end(), "--environment") == more.end()) {
      more.insert(more.end(), {"--environment", sky_});
    }
    return RunFacet(more);
  }
  std::vector<std::string> Entries() const {
    std::vector<std::string> names;
    if (!std::filesystem::is_directory(cache_)) return names;
    for (const auto& entry : std::filesystem::directory_iterator(cache_)) names.push_back(entry.path().string());
    return names;
  }

  const Folder folder_;
  const std::string scene_ = folder_ / "tiny.gltf", sky_ = folder_ / "sky.hdr", cache_ = folder_ / "cache";
};

TEST_F(FacetCache, PicturesAreTheSameWithoutColdAndWarm) {
  std::size_t entries = 0;
  for (const std::vector<std::string>& options :
       std::vector<std::vector<std::string>>{{},
                                             {"--background", "environment"},
                                             {"--environment-size", "64"},
                                             {"--environment-samples", "6", "--threads", "1"},
                                             {"--irradiance", "harmonics"}}) {
    std::vector<std::string> cached = options;
    cached.insert(cached.end(), {"--cache", cache_});
    const std::string without = Draw(options);
    EXPECT_EQ(Entries().size(), entries);
    EXPECT_TRUE(Draw(cached) == without) << "cold";
    EXPECT_EQ(Entries().size(), ++entries);
    EXPECT_TRUE(Draw(cached) == without) << "warm";
    EXPECT_EQ(Entries().size(), entries);
    // The rotation and strength of the light are not prepared.
    cached.insert(cached.end(), {"--environment-rotation", "90", "--environment-intensity", "2"});
    EXPECT_FALSE(Draw(cached) == without);
    EXPECT_EQ(Entries().size(), entries);
  }
  Draw({"--cache", cache_, "--environment", "none"}, "out.png", "nothing lights the picture");
  Draw({"--cache", cache_, "--environment", "studio"});
  EXPECT_EQ(Entries().size(), entries);
  EXPECT_EQ(RunFacet({"verify", folder_ / "out.png", scene_}).exit_code, 0);
}

// The program renders with what was kept for a file that cannot be decoded.
TEST_F(FacetCache, WarmRunsDoNotDecode) {
  const std::string expected = Draw({});
  const EnvironmentOptions options;  // render's defaults
  const auto map = PrefilterEnvironment(*OpenEnvironment(sky_, cache_)->Decode(), options);
  WriteText(sky_, "no picture at all");
  EXPECT_EQ(Run({"--cache", cache_}).exit_code, 4);
  EXPECT_TRUE(Entries().empty());
  ASSERT_EQ(OpenEnvironment(sky_, cache_)->Keep(options, *map), "");
  EXPECT_TRUE(Draw({"--cache", cache_}) == expected);
}

TEST_F(FacetCache, DamagedEntriesAreMadeAnew) {
  const std::string expected = Draw({"--cache", cache_});
  ASSERT_EQ(Entries().size(), 1u);
  const std::string entry = Entries()[0], whole = ReadText(entry);
  for (const std::size_t at : {std::size_t{5}, std::size_t{60}, whole.size() / 2, whole.size() - 2}) {
    std::string damaged = whole;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x40);
    WriteText(entry, damaged);
    EXPECT_TRUE(Draw({"--cache", cache_}) == expected) << at;
    EXPECT_TRUE(ReadText(entry) == whole) << at;
  }
}

TEST_F(FacetCache, FoldersThatCannotBeWrittenAreAWarning) {
  const std::string expected = Draw({});
  const Outcome run = Run({"--cache", sky_});  // a file
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_TRUE(IsOneErrorLine(run.err)) << run.err;
  EXPECT_EQ(run.err.rfind("facet: warning: the prepared environment is not kept: " + sky_, 0), 0u) << run.err;
  EXPECT_TRUE(ReadText(folder_ / "out.png") == expected);
  EXPECT_TRUE(Draw({"--cache", sky_, "-q"}) == expected);
}

TEST_F(FacetCache, TheVariableIsTheDefault) {
  setenv("FACET_CACHE", cache_.c_str(), 1);
  Draw({"--cache", folder_ / "other"});
  Draw({"--cache", "none"});
  EXPECT_TRUE(Entries().empty());
  const std::string without = ReadText(folder_ / "out.png");
  EXPECT_TRUE(Draw({}) == without);
  EXPECT_EQ(Entries().size(), 1u);
  EXPECT_TRUE(Draw({}) == without);
  EXPECT_EQ(RunFacet({"info", scene_}).exit_code, 0);
  for (const char* off : {"", "none"}) {
    setenv("FACET_CACHE", off, 1);
    WriteSky(32, 16);
    EXPECT_FALSE(Draw({}) == without);
    EXPECT_EQ(Entries().size(), 1u) << off;
  }
}

TEST_F(FacetCache, SeveralProgramsAtOnce) {
  const std::string expected = Draw({});
  std::vector<std::thread> threads;
  for (int i = 0; i < 6; ++i) {
    threads.emplace_back([&, i] { EXPECT_TRUE(Draw({"--cache", cache_}, std::to_string(i) + ".png") == expected); });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(Entries().size(), 1u);
}

TEST_F(FacetCache, CountsAgainstTheMemoryLimit) {
  WriteSky(1024, 4);  // little to decode; prepared 5.4 MiB
  Draw({"--cache", cache_});
  const Outcome run = Run({"--cache", cache_, "--memory-limit", "3MiB"});
  EXPECT_EQ(run.exit_code, 7) << run.err;
  EXPECT_NE(run.err.find("for a prepared environment"), std::string::npos) << run.err;
}

}  // namespace
}  // namespace facet::test
