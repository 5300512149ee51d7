// Help, errors and exit codes of the facet program.
#include <gtest/gtest.h>
#include <unistd.h>

#include <set>
#include <utility>

#include "cli/program.h"
#include "cli/tiny_scene.h"
#include "facet/settings.h"
#include "facet/version.h"

namespace facet::test {
namespace {

TEST(FacetHelp, IsOnStandardOutput) {
  for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{{"--help"},
                                                                                         {"-h"},
                                                                                         {"render", "--help"},
                                                                                         {"render", "-h"},
                                                                                         {"info", "--help"},
                                                                                         {"hash", "--help"},
                                                                                         {"explain", "--help"},
                                                                                         {"verify", "--help"},
                                                                                         {"diff", "--help"}}) {
    const Outcome run = RunFacet(arguments);
    EXPECT_EQ(run.exit_code, 0);
    EXPECT_EQ(run.err, "");
    EXPECT_NE(run.out.find("Usage: facet"), std::string::npos);
    EXPECT_NE(run.out.find("Exit codes:"), std::string::npos);
  }
}

TEST(FacetHelp, NamesEveryOptionAsTheManualDoes) {
  const std::string help = RunFacet({"render", "--help"}).out;
  std::string manual = ReadText(std::string(FACET_SOURCE_DIR) + "/docs/facet.1");
  ASSERT_FALSE(manual.empty());
  for (std::size_t at = 0; (at = manual.find("\\-", at)) != std::string::npos;) manual.erase(at, 1);
  for (const char* option : {"--output",
                             "--size",
                             "--samples",
                             "--threads",
                             "--camera",
                             "--orbit",
                             "--target",
                             "--fov",
                             "--scene",
                             "--environment",
                             "--environment-rotation",
                             "--environment-intensity",
                             "--background",
                             "--exposure",
                             "--camera-exposure",
                             "--tonemap",
                             "--transfer",
                             "--white-balance",
                             "--contrast",
                             "--saturation",
                             "--curves",
                             "--model",
                             "--materials",
                             "--animation",
                             "--time",
                             "--variant",
                             "--without",
                             "--bits",
                             "--max-anisotropy",
                             "--mip-filter",
                             "--texels",
                             "--tangents",
                             "--environment-size",
                             "--environment-samples",
                             "--irradiance",
                             "--specular-antialiasing",
                             "--tile-size",
                             "--cache",
                             "--max-error",
                             "--max-time",
                             "--report",
                             "--budget",
                             "--ignore-required-extensions",
                             "--stats",
                             "--stats-json",
                             "--progress",
                             "--no-progress",
                             "--quiet"}) {
    EXPECT_NE(help.find(option), std::string::npos) << option << " is not in the help";
    const std::string flag = "Fl " + std::string(option + 1);  // mdoc's Fl sets the first hyphen
    EXPECT_NE(manual.find(flag), std::string::npos) << option << " is not in the manual";
  }
}

// What can be left out is in the help, the manual and the page about it, each word by itself.
TEST(FacetHelp, NamesEveryFeatureAsTheManualDoes) {
  const auto words_of = [](std::string text) {
    std::set<std::string> words;
    std::string word;
    for (const char c : text + " ") {
      if ((c >= 'a' && c <= 'z') || c == '-') {
        word += c;
      } else {
        words.insert(std::exchange(word, ""));
      }
    }
    return words;
  };
  const std::string docs = std::string(FACET_SOURCE_DIR) + "/docs/";
  for (const std::string& text : {RunFacet({"render", "--help"}).out, RunFacet({"explain", "--help"}).out,
                                  ReadText(docs + "facet.1"), ReadText(docs + "explain.md")}) {
    const std::set<std::string> words = words_of(text);
    for (const FeatureWord& known : kFeatureWords) {
      EXPECT_TRUE(words.contains(std::string(known.word))) << known.word << " is not in\n" << text.substr(0, 200);
    }
  }
  const std::string help = RunFacet({"render", "--help"}).out;
  for (std::size_t begin = 0, end; (end = help.find('\n', begin)) != std::string::npos; begin = end + 1) {
    EXPECT_LE(end - begin, 85u) << help.substr(begin, end - begin);
  }
}

TEST(FacetVersion, IsTheLibrarys) {
  const Outcome run = RunFacet({"--version"});
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_EQ(run.out, std::string("facet ") + Version() + "\n");
}

TEST(FacetHelp, FailsWhenItCannotBeWritten) {
  EXPECT_EQ(RunFacet({"render", "--help"}, {.max_file_bytes = 100}).exit_code, 6);
}

struct WrongUsage {
  std::vector<std::string> arguments;
  std::string says;
};

TEST(FacetUsage, WrongArgumentsEndWithTwoAndOneLine) {
  const Folder folder;
  const std::string in = folder / "in.gltf", out = folder / "out.png";
  WriteText(in, TinyScene());
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {"render", in, "-o", out, "--size", "8x8"});
    return more;
  };
  const std::vector<WrongUsage> cases = {
      {{}, "no command"},
      {{"rendr"}, "did you mean 'render'"},
      {{"render"}, "input file is missing"},
      {{"render", in}, "-o FILE is missing"},
      {{"render", "-o", out}, "input file is missing"},
      {{"render", in, "-o"}, "needs a value"},
      {{"render", in, in, "-o", out}, "unexpected argument"},
      {{"render", in, "-o", folder / "out"}, "no extension"},
      {{"render", in, "-o", folder / "out.xyz"}, "'.xyz'"},
      {{"render", in, "-o", folder / "out.glb"}, "'.glb'"},
      {{"info"}, "input file is missing"},
      {{"info", in, "--jsn"}, "did you mean '--json'"},
      {with({"--sise", "3x3"}), "did you mean '--size'"},
      {with({"--size", "9x9"}), "more than once"},
      {{"render", in, "-o", out, "--size", "9,9"}, "--size"},
      {{"render", in, "-o", out, "--size", "0x9"}, "1 to 16384"},
      {{"render", in, "-o", out, "--size", "9x16385"}, "1 to 16384"},
      {with({"--samples", "3"}), "1, 2, 4 or 8"},
      {with({"--samples", "16"}), "1, 2, 4 or 8"},
      {with({"--threads", "-1"}), "0 to 1024"},
      {with({"--threads", "two"}), "0 to 1024"},
      {with({"--camera", "Nobody"}), "0 'Front', 1 'Flat'"},
      {with({"--camera", "2"}), "0 'Front', 1 'Flat'"},
      {with({"--camera", "0", "--orbit", "0,90,3"}), "--orbit"},
      {with({"--camera", "0", "--fov", "30"}), "--fov"},
      {with({"--orbit", "0,90,nan"}), "THETA,PHI or THETA,PHI,RADIUS"},
      {with({"--target", "1,2"}), "X,Y,Z"},
      {with({"--fov", "0"}), "1 to 179"},
      {with({"--fov", "inf"}), "1 to 179"},
      {with({"--fov", "45deg"}), "1 to 179"},
      {with({"--scene", "Nowhere"}), "0 'Main', 1 'Small', 2 'Lit'"},
      {with({"--scene", "3"}), "0 'Main', 1 'Small', 2 'Lit'"},
      {with({"--animation", "Jump"}), "0 'Slide'"},
      {with({"--time", "-1"}), "0 to 1000000000"},
      {with({"--time", "nan"}), "0 to 1000000000"},
      {with({"--variant", "Green"}), "0 'Plain', 1 'Blue'"},
      {with({"--background", "#12"}), "#rrggbb"},
      {with({"--background", "environment", "--environment", "none"}), "no environment"},
      {with({"--exposure", "bright"}), "-64 to 64"},
      {with({"--exposure", "65"}), "-64 to 64"},
      {with({"--tonemap", "sepia"}),
       "none, reinhard, aces, agx, neutral, filmic, generic, gt7, agx-golden or agx-punchy"},
      {with({"--camera-exposure", "16,1/125"}), "APERTURE,SECONDS,ISO"},
      {with({"--camera-exposure", "16,1/0,100"}), "1e-06 to 1000000"},
      {with({"--transfer", "linear"}), "srgb or gamma"},
      {with({"--white-balance", "2,0"}), "-1 to 1"},
      {with({"--white-balance", "1"}), "separate them by commas"},
      {with({"--contrast", "3"}), "0 to 2"},
      {with({"--curves", "0,1,1"}), "0.01 to 100"},
      {with({"--environment-rotation", "left"}), "-36000 to 36000"},
      {with({"--environment-intensity", "-1"}), "0 to 1000000"},
      {with({"--bits", "12"}), "8 or 16"},
      {with({"--max-anisotropy", "0"}), "1 to 16"},
      {with({"--max-anisotropy", "17"}), "1 to 16"},
      {with({"--stats=xml"}), "table or json"},
      {with({"--quiet=yes"}), "takes no value"},
      {{"render", in, "-o", folder / "out.jpg", "--bits", "16"}, "16-bit"},
      {{"render", in, "-o", folder / "out.jpg", "--background", "transparent"}, "no transparency"},
  };
  for (const WrongUsage& wrong : cases) {
    std::string line;
    for (const std::string& argument : wrong.arguments) line += " " + argument;
    const Outcome run = RunFacet(wrong.arguments);
    EXPECT_EQ(run.exit_code, 2) << line << "\n" << run.err;
    EXPECT_TRUE(IsOneErrorLine(run.err)) << line << "\n" << run.err;
    EXPECT_NE(run.err.find(wrong.says), std::string::npos) << line << "\n" << run.err;
    EXPECT_EQ(run.out, "") << line;
  }
  EXPECT_EQ(folder.Files(), std::vector<std::string>{"in.gltf"});
}

TEST(FacetErrors, ExitCodesTellWhatIsWrong) {
  const Folder folder;
  const std::string in = folder / "in.gltf", broken = folder / "broken.gltf", text = folder / "text.glb",
                    strange = folder / "strange.gltf", out = folder / "out.png", bad_picture = folder / "bad.png";
  WriteText(in, TinyScene());
  WriteText(broken, TinyScene().substr(0, 400));
  WriteText(text, "glTF but not really");
  WriteText(strange, TinyScene(R"("extensionsUsed": ["ABC_unheard_of"], "extensionsRequired": ["ABC_unheard_of"],)"));
  WriteText(bad_picture, "\x89PNG\r\n\x1a\n and nothing else");
  struct Case {
    std::vector<std::string> arguments;
    int exit_code;
    std::string says;
  };
  const std::vector<Case> cases = {
      {{"render", folder / "none.glb", "-o", out}, 3, "none.glb"},
      {{"render", folder / "", "-o", out}, 3, ""},
      {{"info", folder / "none.glb"}, 3, "none.glb"},
      {{"render", broken, "-o", out}, 4, "broken.gltf"},
      {{"render", text, "-o", out}, 4, "text.glb"},
      {{"info", broken}, 4, "broken.gltf"},
      {{"render", strange, "-o", out}, 5, "ABC_unheard_of"},
      {{"render", in, "-o", out, "--size", "8x8", "--environment", folder / "none.hdr"}, 3, "none.hdr"},
      {{"render", in, "-o", out, "--size", "8x8", "--environment", bad_picture}, 4, "bad.png"},
      {{"render", in, "-o", folder / "nowhere/out.png"}, 6, "does not exist"},
      {{"render", in, "-o", in + "/out.png"}, 6, "does not exist"},
      {{"render", in, "-o", out, "--stats-json", folder / "nowhere/s.json"}, 6, "nowhere"},
  };
  const std::vector<std::string> before = folder.Files();
  for (const Case& c : cases) {
    std::string line;
    for (const std::string& argument : c.arguments) line += " " + argument;
    const Outcome run = RunFacet(c.arguments);
    EXPECT_EQ(run.exit_code, c.exit_code) << line << "\n" << run.err;
    EXPECT_TRUE(IsOneErrorLine(run.err)) << line << "\n" << run.err;
    EXPECT_NE(run.err.find(c.says), std::string::npos) << line << "\n" << run.err;
    EXPECT_EQ(run.out, "") << line;
  }
  EXPECT_EQ(folder.Files(), before);
}

TEST(FacetErrors, AFolderThatCannotBeWrittenIsNoticedBeforeLoading) {
  if (geteuid() == 0) GTEST_SKIP() << "the superuser may write everywhere";
  const Folder folder;
  std::filesystem::create_directory(folder / "locked");
  std::filesystem::permissions(folder / "locked",
                               std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
  const Outcome run = RunFacet({"render", folder / "none.glb", "-o", folder / "locked/out.png"});
  EXPECT_EQ(run.exit_code, 6) << run.err;
  EXPECT_TRUE(IsOneErrorLine(run.err)) << run.err;
}

TEST(FacetErrors, AnExistingPictureSurvivesFailure) {
  const Folder folder;
  const std::string in = folder / "in.gltf", out = folder / "out.png";
  WriteText(in, TinyScene());
  WriteText(out, "precious");
  const std::vector<std::string> before = folder.Files();
  EXPECT_EQ(RunFacet({"render", folder / "none.gltf", "-o", out}).exit_code, 3);
  EXPECT_EQ(ReadText(out), "precious");
  // The disk is full when the picture is written.
  const Outcome run =
      RunFacet({"render", in, "-o", out, "--size", "512x512", "--orbit", "20,70"}, {.max_file_bytes = 500});
  EXPECT_EQ(run.exit_code, 6) << run.err;
  EXPECT_TRUE(IsOneErrorLine(run.err)) << run.err;
  EXPECT_EQ(ReadText(out), "precious");
  EXPECT_EQ(folder.Files(), before) << "a temporary file was left behind";
}

TEST(FacetErrors, HostileNamesDoNotReachTheTerminal) {
  const Outcome run = RunFacet({"render", "a\x1b[2J\nb.glb", "-o", "/nowhere\x07/out.png"});
  EXPECT_EQ(run.exit_code, 6);
  EXPECT_TRUE(IsOneErrorLine(run.err)) << run.err;
  for (const char c : run.err.substr(0, run.err.size() - 1)) EXPECT_GE(static_cast<unsigned char>(c), 0x20);
}

}  // namespace
}  // namespace facet::test
