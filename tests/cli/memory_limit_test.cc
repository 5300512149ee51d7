// `facet render --memory-limit`, and large pictures that are written band by band.
#include <gtest/gtest.h>

#include "base/input_file.h"
#include "cli/program.h"
#include "cli/tiny_scene.h"
#include "facet/film.h"
#include "facet/load.h"
#include "image/codec.h"

namespace facet::test {
namespace {

const std::string kShowcase = std::string(FACET_SOURCE_DIR) + "/assets/scenes/showcase.glb";

class FacetMemoryLimit : public testing::Test {
 protected:
  FacetMemoryLimit() { WriteText(tiny_, TinyScene()); }

  Outcome Draw(const std::string& in, const std::string& out, std::vector<std::string> more) const {
    more.insert(more.begin(), {"render", in, "-o", out});
    return RunFacet(more);
  }

  // Exit code 7, one line with `part` in it, and no file.
  void ExpectRefused(const Outcome& run, const std::string& part, int exit_code = 7) const {
    EXPECT_EQ(run.exit_code, exit_code) << run.err;
    EXPECT_TRUE(IsOneErrorLine(run.err)) << run.err;
    EXPECT_NE(run.err.find(part), std::string::npos) << run.err;
    for (const std::string& name : folder_.Files()) EXPECT_EQ(name.find(".part-"), std::string::npos) << name;
  }

  const Folder folder_;
  const std::string tiny_ = folder_ / "tiny.gltf", whole_ = folder_ / "whole.png", bands_ = folder_ / "bands.png";
};

// A film of 6 MiB is more than a quarter of 20 MiB: it comes in bands.
TEST_F(FacetMemoryLimit, BandsMakeTheSamePictureAndText) {
  for (const std::vector<std::string>& options :
       std::vector<std::vector<std::string>>{{},
                                             {"--bits", "16", "--threads", "1"},
                                             {"--background", "teal", "--tile-size", "8"},
                                             {"--background", "environment", "--samples", "1", "--threads", "3"}}) {
    std::vector<std::string> all = {"--size", "768x509"};
    all.insert(all.end(), options.begin(), options.end());
    ASSERT_EQ(Draw(kShowcase, whole_, all).exit_code, 0);
    all.insert(all.end(), {"--memory-limit", "20MiB"});
    const Outcome run = Draw(kShowcase, bands_, all);
    ASSERT_EQ(run.exit_code, 0) << run.err;
    EXPECT_EQ(run.out + run.err, "");
    const Bytes whole = ReadFile(whole_), bands = ReadFile(bands_);
    EXPECT_TRUE(whole.Text() != bands.Text()) << "it was not written in bands";
    EXPECT_TRUE(DecodeImage(whole.Span(), "whole").bytes == DecodeImage(bands.Span(), "bands").bytes);
    EXPECT_EQ(ReadImageText(bands.Span(), "bands"), ReadImageText(whole.Span(), "whole"));
    const Outcome verified = RunFacet({"verify", bands_, kShowcase});
    EXPECT_EQ(verified.exit_code, 0) << verified.out << verified.err;
  }
  EXPECT_EQ(folder_.Files(), (std::vector<std::string>{"bands.png", "tiny.gltf", "whole.png"}));
}

TEST_F(FacetMemoryLimit, APictureThatFailsHalfWayLeavesNothing) {
  WriteText(bands_, "before");
  const std::vector<std::string> arguments = {"render",  kShowcase,        "-o",   bands_, "--size",
                                              "768x512", "--memory-limit", "20MiB"};
  const Outcome run = RunFacet(arguments, {.max_file_bytes = 20000});
  EXPECT_EQ(run.exit_code, 6) << run.err;
  EXPECT_TRUE(IsOneErrorLine(run.err)) << run.err;
  EXPECT_NE(run.err.find(bands_ + ": cannot be written"), std::string::npos) << run.err;
  EXPECT_EQ(ReadText(bands_), "before");
  EXPECT_EQ(folder_.Files(), (std::vector<std::string>{"bands.png", "tiny.gltf"}));
}

TEST_F(FacetMemoryLimit, StatsOfBandsAreThoseOfTheWhole) {
  const auto lines = [&](std::vector<std::string> more) {
    more.insert(more.end(), {"--size", "512x512", "--stats"});
    const Outcome run = Draw(tiny_, whole_, more);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    const std::size_t at = run.err.find("  drawables");
    return run.err.substr(at, run.err.find("  input files") - at);
  };
  EXPECT_EQ(lines({"--memory-limit", "12MiB"}), lines({}));
}

TEST_F(FacetMemoryLimit, RefusesFilms) {
  // 16 bytes a pixel, and what is tone-mapped and encoded from it twice, for the encoder as well.
  ExpectRefused(
      Draw(tiny_, folder_ / "out.exr", {"--size", "16384x16384", "--memory-limit", "1GiB"}),
      "this needs 4.0 GiB for a film of 16384 x 16384 pixels, and the memory limit is 1.0 GiB; make the picture "
      "smaller, or write it as .png, which is done piece by piece, or raise the limit");
  ExpectRefused(Draw(tiny_, folder_ / "out.exr", {"--size", "1024x1024", "--memory-limit", "20MiB"}),
                "32.0 MiB for its encoded pixels");
  // One row of tiles.
  ExpectRefused(Draw(tiny_, bands_, {"--size", "16384x16384", "--memory-limit", "7MiB"}),
                "8.0 MiB for a film of 16384 x 32 pixels");
}

TEST_F(FacetMemoryLimit, RefusesTextures) {
  ExpectRefused(Draw(kShowcase, whole_, {"--size", "64x64", "--memory-limit", "4MiB"}), "for textures (the largest: ");
}

TEST_F(FacetMemoryLimit, RefusesEnvironmentsByTheirHeader) {
  const std::string sky = folder_ / "sky.hdr";
  WriteText(sky, "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 8192 +X 16384\n");  // no pixels: they must not be asked for
  ExpectRefused(Draw(tiny_, whole_, {"--scene", "Lit", "--environment", sky, "--memory-limit", "256MiB"}),
                "1.5 GiB for decoding an image of 16384 x 8192 pixels");
}

TEST_F(FacetMemoryLimit, NamesTheSizeOfPicturesBeyondAllLimits) {
  const Outcome narrow = Draw(tiny_, whole_, {"--size", "20000x10"});
  EXPECT_NE(narrow.err.find("--size: '20000x10' is too large; give"), std::string::npos) << narrow.err;
  const Outcome run = Draw(tiny_, whole_, {"--size", "1000000x1000000"});
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_TRUE(IsOneErrorLine(run.err)) << run.err;
  EXPECT_NE(run.err.find("--size: '1000000x1000000' is too large: it needs 14901.2 GiB, and the limit is 4.0 GiB; "),
            std::string::npos)
      << run.err;
}

// A header alone: 100000 x 100000 pixels.
TEST_F(FacetMemoryLimit, NamesTheSizeOfTexturesBeyondAllLimits) {
  const std::string_view header(
      "\x89PNG\r\n\x1a\n\0\0\0\x0dIHDR\0\x01\x86\xa0\0\x01\x86\xa0\x08\x02\0\0\0\0\0\0\0\0\0\0\0IDAT\0\0\0\0", 45);
  WriteText(folder_ / "huge.png", std::string(header));
  std::string scene = TinyScene(R"("images": [{"uri": "huge.png"}], "textures": [{"source": 0}],)");
  const std::string red = R"("baseColorFactor": [1, 0, 0, 1])";
  const std::size_t at = scene.find(red);
  ASSERT_NE(at, std::string::npos);
  scene.insert(at, R"("baseColorTexture": {"index": 0}, )");
  WriteText(tiny_, scene);
  ExpectRefused(Draw(tiny_, whole_, {"-q"}),
                "a texture of 100000 x 100000 texels needs 74.5 GiB, and the limit is 32768");
}

// The stacks of threads are not what a limit is about.
TEST_F(FacetMemoryLimit, LeavesRoomForManyThreads) {
  const Outcome run = Draw(tiny_, whole_, {"--size", "64x64", "--threads", "128", "--memory-limit", "64MiB"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
}

TEST_F(FacetMemoryLimit, TakesAmountsWithUnits) {
  for (const char* good : {"64MiB", "0.5GiB", "1TiB"}) {
    EXPECT_EQ(Draw(tiny_, whole_, {"--size", "8x8", "--memory-limit", good}).exit_code, 0) << good;
  }
  for (const char* bad : {"", "64", "64MB", "-1GiB", "0MiB", "nanMiB", "2000TiB", "MiB", "1 GiB"}) {
    const Outcome run = Draw(tiny_, whole_, {"--size", "8x8", std::string("--memory-limit=") + bad});
    EXPECT_EQ(run.exit_code, 2) << bad;
    EXPECT_TRUE(IsOneErrorLine(run.err)) << run.err;
  }
}

}  // namespace
}  // namespace facet::test
