// Whole frames: nanoseconds per covered pixel and per triangle, and the stages' times, for DamagedHelmet (from the
// folder that FACET_CORPUS names) and the bundled scenes.
//
// What is timed: "load" reads the file; "frame" renders a loaded scene, images decoded anew; "file to file" does
// everything that the program does between its command line and its PNG.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "facet/facet.h"
#include "facet/shader/dispatch.h"

namespace {

namespace fs = std::filesystem;

constexpr int kSize = 1024, kSamples = 4;

struct Subject {
  std::string name;
  fs::path path;
};

std::vector<Subject> Subjects() {
  const fs::path root = FACET_SOURCE_DIR;
  std::vector<Subject> subjects;
  const char* variable = std::getenv("FACET_CORPUS");
  const fs::path corpus = variable != nullptr ? fs::path(variable) : root / "../shared/corpus";
  std::error_code ignored;
  if (fs::exists(corpus / "models", ignored)) {
    for (const auto& entry : fs::recursive_directory_iterator(corpus / "models", ignored)) {
      if (entry.path().filename() == "DamagedHelmet.glb") {
        subjects.push_back({"DamagedHelmet", entry.path()});
        break;
      }
    }
  }
  for (const char* name : {"showcase", "gallery", "material_grid", "materials", "room", "animated"}) {
    subjects.push_back({name, root / "assets/scenes" / (std::string(name) + ".glb")});
  }
  return subjects;
}

facet::RenderSettings Settings(int threads) {
  facet::RenderSettings settings;
  settings.width = settings.height = kSize;
  settings.samples = kSamples;
  settings.threads = threads;
  return settings;
}

// Sums over the iterations of a benchmark, reported as means.
class Totals {
 public:
  void Add(const facet::RenderStats& stats) {
    ++frames_;
    last_ = stats;
    total_ += stats.total_seconds;
    pose_ += stats.pose_seconds;
    environment_ += stats.environment_seconds;
    texture_ += stats.texture_seconds;
    geometry_ += stats.geometry_seconds;
    raster_ += stats.raster_seconds;
  }
  void Report(benchmark::State& state) const {
    if (frames_ == 0) return;
    const double n = frames_;
    state.counters["ns/pixel"] = 1e9 * total_ / n / double(std::max<std::uint64_t>(last_.covered_pixels, 1));
    state.counters["ns/triangle"] = 1e9 * geometry_ / n / double(std::max<std::uint64_t>(last_.triangles_in, 1));
    state.counters["pose_ms"] = 1e3 * pose_ / n;
    state.counters["environment_ms"] = 1e3 * environment_ / n;
    state.counters["texture_ms"] = 1e3 * texture_ / n;
    state.counters["geometry_ms"] = 1e3 * geometry_ / n;
    state.counters["raster_ms"] = 1e3 * raster_ / n;
    state.counters["texture_MB"] = 1e-6 * double(last_.texture_bytes);
    state.counters["pixels"] = double(last_.covered_pixels);
    state.SetLabel(last_.target + ", " + std::to_string(last_.threads) + " threads");
  }

 private:
  int frames_ = 0;
  double total_ = 0, pose_ = 0, environment_ = 0, texture_ = 0, geometry_ = 0, raster_ = 0;
  facet::RenderStats last_;
};

void Load(benchmark::State& state, const Subject& subject) {
  for (auto _ : state) benchmark::DoNotOptimize(facet::LoadGltf(subject.path));
}

void Frame(benchmark::State& state, const Subject& subject, int threads) {
  const facet::LoadedScene loaded = facet::LoadGltf(subject.path);
  Totals totals;
  for (auto _ : state) {
    facet::RenderStats stats;
    benchmark::DoNotOptimize(facet::Render(loaded.scene, Settings(threads), &stats));
    totals.Add(stats);
  }
  totals.Report(state);
}

void FileToFile(benchmark::State& state, const Subject& subject) {
  const fs::path output = fs::temp_directory_path() / ("facet_frame_bench_" + subject.name + ".png");
  Totals totals;
  for (auto _ : state) {
    facet::RenderStats stats;
    const facet::LoadedScene loaded = facet::LoadGltf(subject.path);
    facet::WriteImage(output, facet::EncodeFilm(facet::Render(loaded.scene, Settings(0), &stats), {}));
    totals.Add(stats);
  }
  totals.Report(state);
  std::error_code ignored;
  fs::remove(output, ignored);
}

}  // namespace

int main(int argc, char** argv) {
  const auto add = [](const std::string& name, auto function, auto... arguments) {
    benchmark::RegisterBenchmark(name.c_str(), function, arguments...)->Unit(benchmark::kMillisecond)->UseRealTime();
  };
  for (const Subject& subject : Subjects()) {
    add("load/" + subject.name, Load, subject);
    add("frame/" + subject.name, Frame, subject, 0);
    add("frame, one thread/" + subject.name, Frame, subject, 1);
    add("file to file/" + subject.name, FileToFile, subject);
  }
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
