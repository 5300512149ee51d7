// Files that are not the program's own: inputs are not written over, links and data lead nowhere else, and a run that
// is ended leaves nothing behind.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <thread>

#include "cli/program.h"
#include "cli/tiny_scene.h"
#include "facet/film.h"
#include "facet/load.h"

namespace facet::test {
namespace {

namespace fs = std::filesystem;
using Names = std::vector<std::string>;

bool Has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

// One pixel.
void WritePixel(const fs::path& path, std::uint8_t grey) {
  WriteImage(path, Image{1, 1, 3, ChannelType::U8, Encoding::Srgb, std::vector<std::byte>(3, std::byte{grey})});
}

// A scene whose square has a texture of that name.
std::string TexturedScene(const std::string& image) {
  std::string scene = TinyScene(R"("images": [{"uri": ")" + image + R"("}], "textures": [{"source": 0}],)");
  const std::string red = R"("baseColorFactor": [1, 0, 0, 1])";
  return scene.insert(scene.find(red), R"("baseColorTexture": {"index": 0}, )");
}

class FacetFiles : public testing::Test {
 protected:
  FacetFiles() { WriteText(scene_, TinyScene()); }

  Outcome Draw(const std::string& in, const std::string& out, std::vector<std::string> more = {}) const {
    more.insert(more.begin(), {"render", in, "-o", out, "--size", "8x8", "--samples", "1", "-q"});
    return RunFacet(more);
  }
  void ExpectRefused(const Outcome& run, int exit_code, const std::string& part) const {
    EXPECT_EQ(run.exit_code, exit_code) << run.err;
    EXPECT_TRUE(IsOneErrorLine(run.err)) << run.err;
    EXPECT_TRUE(Has(run.err, part)) << run.err;
  }

  const Folder folder_;
  const std::string scene_ = folder_ / "scene.gltf", out_ = folder_ / "out.png";
};

TEST_F(FacetFiles, NoInputIsWrittenOver) {
  const std::string car = folder_ / "car.gltf", texture = folder_ / "car.png", sky = folder_ / "sky.png";
  WriteText(car, TexturedScene("car.png"));
  WritePixel(texture, 100);
  WritePixel(sky, 50);
  fs::create_symlink("car.png", folder_ / "link.png");
  fs::create_hard_link(texture, folder_ / "hard.png");
  const std::string before = ReadText(texture);
  for (const char* name : {"car.png", "link.png", "hard.png"}) {
    ExpectRefused(Draw(car, folder_ / name), 2, "is also an input");
  }
  ExpectRefused(Draw(car, (fs::path(texture).parent_path() / "." / "car.png").string()), 2, "is also an input");
  EXPECT_EQ(ReadText(texture), before);
  ExpectRefused(Draw(scene_, sky, {"--environment", sky}), 2, "is also an input");
  // An input of any name, and every kind of output.
  fs::copy_file(scene_, folder_ / "scene.png");
  ExpectRefused(Draw(folder_ / "scene.png", folder_ / "scene.png"), 2, "is also an input");
  ExpectRefused(Draw(scene_, out_, {"--stats-json", scene_}), 2, "is also an input");
  ExpectRefused(Draw(scene_, out_, {"--stats-json", out_}), 2, "two outputs");
  ExpectRefused(RunFacet({"diff", texture, sky, "-o", texture}), 2, "is also an input");
  WriteText(folder_ / "goldens.json", R"({"version": 1, "entries": [{"name": "a", "scene": "scene.gltf"}]})");
  ExpectRefused(RunFacet({"check", folder_ / "goldens.json", "--html", folder_ / "goldens.json"}), 2,
                "is also an input");
  EXPECT_EQ(ReadText(scene_), TinyScene());
  EXPECT_EQ(Draw(car, folder_ / "other.png").exit_code, 0);
}

TEST_F(FacetFiles, AReportIsWrittenOverNoFileOfTheScene) {
  std::string text = TexturedScene("texture.json");
  WriteText(scene_, text);
  WritePixel(folder_ / "texture.png", 100);
  fs::rename(folder_ / "texture.png", folder_ / "texture.json");
  const std::string before = ReadText(folder_ / "texture.json");
  ExpectRefused(RunFacet({"report", scene_, "-o", folder_ / "texture.json", "-q", "--size", "8x8", "--budget", "1s"}),
                2, "is also an input");
  EXPECT_EQ(ReadText(folder_ / "texture.json"), before);
}

TEST_F(FacetFiles, OutputsOfACheckAreWrittenOverNoInputOfAnyEntry) {
  WriteText(folder_ / "car.gltf", TexturedScene("texture.png"));
  WritePixel(folder_ / "texture.png", 100);
  const std::string manifest = folder_ / "goldens.json";
  WriteText(manifest, R"({"version": 1, "settings": {"size": 8}, "entries": [
    {"name": "a", "scene": "scene.gltf", "expect": {"picture": "a.actual.png"}}, {"name": "b", "scene": "car.gltf"}]})");
  // A golden picture under the name of what a failed entry gets.
  WritePixel(folder_ / "a.actual.png", 1);
  const auto files = [&] {
    std::vector<std::string> bytes;
    for (const std::string& name : folder_.Files()) bytes.push_back(ReadText(folder_ / name));
    return bytes;
  };
  const std::vector<std::string> before = files();
  for (const char* name : {"scene.gltf", "car.gltf", "texture.png", "a.actual.png", "goldens.json"}) {
    for (const char* option : {"--html", "--junit"}) {
      const Outcome run = RunFacet({"check", manifest, option, folder_ / name});
      EXPECT_EQ(run.exit_code, 2) << name << run.out << run.err;
      EXPECT_TRUE(Has(run.err, "is also an input")) << run.err;
    }
  }
  const Outcome run = RunFacet({"check", manifest, "--output", folder_ / "."});
  EXPECT_EQ(run.exit_code, 2) << run.out << run.err;
  EXPECT_TRUE(Has(run.err, "is also an input")) << run.err;
  EXPECT_EQ(files(), before);
}

// Two spellings of one name that is not there yet.
TEST_F(FacetFiles, TwoOutputsAreTwoFiles) {
  ExpectRefused(Draw(scene_, out_, {"--stats-json", folder_ / "./out.png"}), 2, "two outputs");
  fs::create_symlink("out.png", folder_ / "link.json");
  ExpectRefused(Draw(scene_, out_, {"--stats-json", folder_ / "link.json"}), 2, "two outputs");
  EXPECT_FALSE(fs::exists(out_));
}

// One that cannot be written keeps none of the others.
TEST_F(FacetFiles, ACheckWritesAllReportsThatItCan) {
  WriteText(folder_ / "goldens.json", R"({"version": 1, "settings": {"size": 8}, "entries": [
    {"name": "a", "scene": "scene.gltf"}]})");
  fs::create_directories(folder_ / "out/a.actual.png");
  const Outcome run = RunFacet({"check", folder_ / "goldens.json", "--output", folder_ / "out", "--html",
                                folder_ / "a.html", "--junit", folder_ / "a.xml"});
  EXPECT_EQ(run.exit_code, 2) << run.out << run.err;
  EXPECT_TRUE(Has(run.err, "a.actual.png")) << run.err;
  EXPECT_TRUE(fs::exists(folder_ / "a.html"));
  EXPECT_TRUE(fs::exists(folder_ / "a.xml"));
}

TEST_F(FacetFiles, AnUpdateWritesOverNoInputAndNothingOutsideOfItsFolder) {
  WriteText(scene_, TexturedScene("texture.png"));
  WritePixel(folder_ / "texture.png", 100);
  const std::string texture = ReadText(folder_ / "texture.png");
  fs::create_directory(folder_ / "outside");
  WriteText(folder_ / "outside/victim", "before");
  fs::create_directory(folder_ / "inside");
  fs::copy_file(scene_, folder_ / "inside/scene.gltf");
  fs::copy_file(folder_ / "texture.png", folder_ / "inside/texture.png");
  fs::create_symlink("../outside/victim", folder_ / "inside/link.png");
  fs::create_symlink("../outside", folder_ / "inside/folder");
  const std::string manifest = folder_ / "inside/goldens.json";
  const auto update = [&](const std::string& picture, std::vector<std::string> more = {}) {
    WriteText(manifest, R"({"version": 1, "settings": {"size": 8}, "entries": [{"name": "a", "scene": "scene.gltf",
      "expect": {"picture": ")" +
                            picture + R"("}}]})");
    more.insert(more.begin(), {"check", manifest, "--update"});
    return RunFacet(more);
  };
  for (const std::string& picture : {std::string("../outside/new.png"), std::string("folder/new.png"),
                                     std::string("link.png"), folder_ / "new.png"}) {
    const Outcome run = update(picture);
    EXPECT_EQ(run.exit_code, 2) << picture << run.out << run.err;
    EXPECT_TRUE(Has(run.err, "lies outside of the folder") || Has(run.err, "no plain file")) << run.err;
  }
  Outcome run = update("texture.png");
  EXPECT_EQ(run.exit_code, 2) << run.out;
  EXPECT_TRUE(Has(run.err, "is also an input")) << run.err;
  EXPECT_EQ(ReadText(folder_ / "inside/texture.png"), texture);
  EXPECT_EQ(ReadText(folder_ / "outside/victim"), "before");
  EXPECT_EQ(folder_.Files(), (Names{"inside", "outside", "scene.gltf", "texture.png"}));
  EXPECT_EQ(update("new/a.png").exit_code, 0);
  EXPECT_TRUE(fs::exists(folder_ / "inside/new/a.png"));
  run = update("../outside/new.png", {"--root", folder_ / "."});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_TRUE(fs::exists(folder_ / "outside/new.png"));
}

// What a PNG says is data: it names no file but those beside the scene.
TEST_F(FacetFiles, VerifyOpensOnlyWhatLiesBesideTheScene) {
  const std::string lit = folder_ / "lit.png";
  WritePixel(folder_ / "sky.png", 200);
  ASSERT_EQ(Draw(scene_, lit, {"--scene", "Lit", "--environment", folder_ / "sky.png"}).exit_code, 0);
  EXPECT_EQ(RunFacet({"verify", lit, scene_}).exit_code, 0);
  const Image image = LoadImage(lit);
  const std::string zeros(64, '0');
  const auto verify = [&](const std::string& environment) {
    WriteImage(lit, image,
               {{"Software", "facet 1"},
                {"facet:scene", "scene.gltf"},
                {"facet:settings", R"({"size": "8x8", "environment": ")" + environment + "\"}"},
                {"facet:film", zeros},
                {"facet:pixels", zeros}});
    return RunFacet({"verify", lit, scene_});
  };
  fs::create_symlink("/dev/zero", folder_ / "zero");
  ASSERT_EQ(mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  ExpectRefused(verify("/dev/zero"), 2, "lies outside of the folder");
  ExpectRefused(verify("../../../../../../../../dev/zero"), 2, "lies outside of the folder");
  ExpectRefused(verify("zero"), 2, "lies outside of the folder");
  ExpectRefused(verify("pipe"), 2, "is not a regular file");
  EXPECT_EQ(verify("sky.png").exit_code, 1) << "is read, and the film is another";
}

TEST_F(FacetFiles, ExrCarriesWhatVerifyNeeds) {
  const std::string exr = folder_ / "out.exr";
  const Outcome run = Draw(scene_, exr);
  if (run.exit_code == 8) GTEST_SKIP() << "OpenImageIO is not installed: " << run.err;
  ASSERT_EQ(run.exit_code, 0) << run.err;
  Outcome verified = RunFacet({"verify", exr, scene_});
  EXPECT_EQ(verified.exit_code, 0) << verified.out << verified.err;
  Image image = LoadImage(exr);
  image.As<float>()[0] = 0.25f;
  WriteImage(exr, image);  // without a text
  verified = RunFacet({"verify", exr, scene_});
  EXPECT_EQ(verified.exit_code, 2);
  EXPECT_TRUE(Has(verified.err, "says nothing of facet:scene")) << verified.err;
}

TEST_F(FacetFiles, OutputsMayHaveTheLongestNames) {
  const std::string name = std::string(251, 'n') + ".png";
  EXPECT_EQ(Draw(scene_, folder_ / name).exit_code, 0);
  ExpectRefused(Draw(scene_, folder_ / ("n" + name)), 6, "File name too long");
  EXPECT_EQ(folder_.Files(), (Names{name, "scene.gltf"}));
}

TEST_F(FacetFiles, APlantedLinkIsNotWrittenThrough) {
  WriteText(folder_ / "victim", "before");
  // Whatever a run of earlier versions would have called its temporary file.
  for (int i = 0; i < 50; ++i) {
    fs::create_symlink("victim", folder_ / (".out.part-" + std::to_string(getpid() + i) + "-0.png"));
  }
  EXPECT_EQ(Draw(scene_, out_).exit_code, 0);
  EXPECT_EQ(ReadText(folder_ / "victim"), "before");
}

TEST_F(FacetFiles, ALinkGivenAsOutputIsFollowed) {
  for (const std::string name : {"a.png", "a.webp", "a.jpg"}) {
    fs::create_symlink("target-" + name, folder_ / name);
    EXPECT_EQ(Draw(scene_, folder_ / name).exit_code, 0);
    EXPECT_TRUE(fs::is_symlink(folder_ / name));
    EXPECT_GT(fs::file_size(folder_ / ("target-" + name)), 0u);
  }
}

// Every format, on a disk that is full from the start.
TEST_F(FacetFiles, AFullDiskIsAnErrorInEveryFormat) {
  for (const std::string extension : {"png", "jpg", "webp", "exr", "hdr", "tif", "bmp", "tga", "ppm"}) {
    const std::string out = folder_ / ("out." + extension);
    const Outcome run =
        RunFacet({"render", scene_, "-o", out, "--size", "64x64", "--background", "white"}, {.max_file_bytes = 100});
    if (run.exit_code == 8) continue;  // without OpenImageIO
    ExpectRefused(run, 6, out + ": cannot be written: File too large");
  }
  EXPECT_EQ(folder_.Files(), Names{"scene.gltf"});
}

// A process that is started and then ended while it writes.
class EndedRun {
 public:
  // Band by band, so that the file is there for a while.
  EndedRun(const std::string& scene, const std::string& out) : child_(fork()) {
    if (child_ != 0) return;
    const int null = open("/dev/null", O_RDWR);
    for (const int stream : {0, 1, 2}) dup2(null, stream);
    execl(FACET_PROGRAM, FACET_PROGRAM, "render", scene.c_str(), "-o", out.c_str(), "--size", "8192x8192",
          "--memory-limit", "128MiB", "--threads", "1", static_cast<char*>(nullptr));
    _exit(127);
  }
  ~EndedRun() { End(SIGKILL); }
  EndedRun(const EndedRun&) = delete;
  EndedRun& operator=(const EndedRun&) = delete;

  // Sends the signal, and says by which the process ended; 0: by none.
  int End(int signal) {
    if (child_ <= 0) return 0;
    kill(child_, signal);
    int status = 0;
    waitpid(child_, &status, 0);
    child_ = 0;
    return WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  }

 private:
  pid_t child_;
};

TEST_F(FacetFiles, ARunThatIsEndedLeavesNothing) {
  const std::string large = std::string(FACET_SOURCE_DIR) + "/assets/scenes/showcase.glb";
  const auto wait_for_two_files = [&] {
    while (folder_.Files().size() < 2) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  };
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGXCPU, SIGPIPE}) {
    EndedRun run(large, out_);
    wait_for_two_files();
    EXPECT_EQ(run.End(signal), signal);
    EXPECT_EQ(folder_.Files(), Names{"scene.gltf"}) << "signal " << signal;
  }
  EndedRun killed(large, out_);
  wait_for_two_files();
  EXPECT_EQ(killed.End(SIGKILL), SIGKILL);
  EXPECT_EQ(folder_.Files().size(), 2u);
  EXPECT_EQ(Draw(scene_, out_).exit_code, 0) << "finds what the other left";
  EXPECT_EQ(folder_.Files(), (Names{"out.png", "scene.gltf"}));
}

// The texture stands at the end of a file that is mapped, and is read after the environment, which comes through a pipe
// that this test fills when it has cut the file short.
TEST_F(FacetFiles, AFileThatIsCutShortWhileItIsInUseIsOneLine) {
  constexpr std::size_t kAt = std::size_t{80} << 20;
  WritePixel(folder_ / "pixel.png", 100);
  const std::string pixel = ReadText(folder_ / "pixel.png"), sky = folder_ / "sky", large = folder_ / "large.bin";
  std::string scene =
      TinyScene(R"("images": [{"bufferView": 4, "mimeType": "image/png"}], "textures": [{"source": 0}],)");
  const auto replace = [&](const std::string& old, const std::string& text) {
    const std::size_t at = scene.find(old);
    ASSERT_NE(at, std::string::npos) << old;
    scene.replace(at, old.size(), text);
  };
  replace(R"({"metallicFactor": 0})", R"({"metallicFactor": 0, "baseColorTexture": {"index": 0}})");
  replace(R"("byteLength": 24})", R"("byteLength": 24}, {"buffer": 1, "byteOffset": )" + std::to_string(kAt) +
                                      R"(, "byteLength": )" + std::to_string(pixel.size()) + "}");
  replace("\"}]}\n", R"("}, {"uri": "large.bin", "byteLength": )" + std::to_string(kAt + pixel.size()) + "}]}");
  WriteText(scene_, scene);
  ASSERT_EQ(mkfifo(sky.c_str(), 0600), 0);
  const auto draw = [&](bool cut, std::vector<std::string> more) {
    WriteText(large, "");
    fs::resize_file(large, kAt);
    const int file = open(large.c_str(), O_WRONLY | O_APPEND);
    EXPECT_EQ(write(file, pixel.data(), pixel.size()), ssize_t(pixel.size()));
    close(file);
    std::thread feeder([&] {
      const int pipe = open(sky.c_str(), O_WRONLY);  // waits until the program opens it: the scene is loaded then
      if (cut) fs::resize_file(large, 1000);
      EXPECT_EQ(write(pipe, pixel.data(), pixel.size()), ssize_t(pixel.size()));
      close(pipe);
    });
    more.insert(more.end(), {"--scene", "Lit", "--environment", sky});
    const Outcome run = Draw(scene_, out_, more);
    feeder.join();
    return run;
  };
  Outcome run = draw(false, {});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(run.err, "");
  run = draw(true, {"--no-mmap"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(run.err, "");
  fs::remove(out_);
  ExpectRefused(draw(true, {}), 3, "was cut short while it was in use");
  EXPECT_FALSE(fs::exists(out_));
}

}  // namespace
}  // namespace facet::test
