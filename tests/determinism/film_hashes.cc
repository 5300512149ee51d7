// Prints the SHA-256 of the linear film of scenes under chosen settings, of each of its planes besides colour, and of
// what was decoded for it: one line "SCENE <tab> WHAT <tab> HASH" each, WHAT being TARGET:THREADS:TILE for a film and
// TARGET:THREADS:TILE/NAME for a plane. prove.py runs it in every configuration and compares.
//   film_hashes [--hostile] [--size N] [--run TARGET:THREADS:TILE]... [--environment FILE] SCENE... [--environment ...]
//   film_hashes --targets
// --environment holds for the scenes after it and is shown behind them. --hostile: the floating-point state that a
// careless host may leave behind: upward rounding, and subnormals flushed to zero. Without --run: what was decoded
// alone.
#include <cfenv>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "facet/error.h"
#include "facet/load.h"
#include "facet/render.h"
#include "facet/scene.h"
#include "facet/shader/dispatch.h"

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace {

using namespace facet;

constexpr Target kTargets[] = {Target::Scalar, Target::Sse4, Target::Avx2, Target::Avx3, Target::Neon};

struct Run {
  Target target = Target::Scalar;
  int threads = 1;
  int tile_size = 32;
};

void MakeHostile() {
  std::fesetround(FE_UPWARD);
#if defined(__x86_64__)
  constexpr unsigned kFlushToZeroAndDenormalsAreZero = 0x8040;
  _mm_setcsr(_mm_getcsr() | kFlushToZeroAndDenormalsAreZero);
#elif defined(__aarch64__)
  constexpr std::uint64_t kFlushToZero = std::uint64_t{1} << 24;
  std::uint64_t state = 0;
  asm volatile("mrs %0, fpcr" : "=r"(state));
  asm volatile("msr fpcr, %0" : : "r"(state | kFlushToZero));
#endif
}

Run ParseRun(const std::string& text) {
  const std::size_t first = text.find(':'), second = text.find(':', first + 1);
  if (second == std::string::npos) throw Error(ErrorCode::InvalidUsage, "expected TARGET:THREADS:TILE", text);
  Run run;
  run.threads = std::stoi(text.substr(first + 1));
  run.tile_size = std::stoi(text.substr(second + 1));
  for (Target target : kTargets) {
    if (text.substr(0, first) == TargetName(target) && TargetIsAvailable(target)) {
      run.target = target;
      return run;
    }
  }
  throw Error(ErrorCode::InvalidUsage, "no such instruction set here", text);
}

void Print(const std::string& scene, const std::string& what, const std::string& value) {
  std::printf("%s\t%s\t%s\n", scene.c_str(), what.c_str(), value.c_str());
  std::fflush(stdout);
}

// Decoded once for all runs. What cannot be decoded stays white in the picture; says why.
std::string DecodeImages(Scene& scene) {
  std::string errors;
  for (SceneImage& image : scene.images) {
    try {
      image.source = MakeImageSource(image.source->Decode(), image.name);
    } catch (const Error& error) {
      if (error.code() == ErrorCode::MissingModule) throw;
      errors += (errors.empty() ? "" : "; ") + std::string(error.what());
    }
  }
  return errors;
}

void HashOne(const std::string& name, const std::string& path, const std::string& environment, int size,
             const std::vector<Run>& runs) {
  Scene scene = LoadGltf(path).scene;
  const std::string errors = DecodeImages(scene);
  if (!errors.empty()) Print(name, "error", errors);

  RenderSettings settings;
  settings.width = settings.height = size;
  for (const PlaneInfo& plane : kPlanes) settings.planes.push_back(plane.kind);
  if (!scene.animations.empty()) {
    settings.animation = 0;
    settings.time = 0.4;
  }
  if (!environment.empty()) {
    settings.environment.kind = EnvironmentSettings::Kind::Image;
    settings.environment.image = std::make_shared<Image>(LoadImage(environment));
    settings.environment.rotation = 0.7;
    settings.background = Background::Environment;
    Print(name, "environment", ToHex(HashImage(*settings.environment.image)));
  }
  const SceneDigests inputs = HashScene(scene);
  Print(name, "description", ToHex(inputs.description));
  Print(name, "geometry", ToHex(inputs.geometry));
  Print(name, "textures", ToHex(inputs.textures));
  for (const Run& run : runs) {
    const ScopedTarget target(run.target);
    settings.threads = run.threads;
    settings.tile_size = run.tile_size;
    const std::string what =
        std::string(TargetName(run.target)) + ":" + std::to_string(run.threads) + ":" + std::to_string(run.tile_size);
    const Film film = Render(scene, settings);
    Print(name, what, ToHex(HashFilm(film)));
    for (std::size_t i = 0; i < film.planes.size(); ++i) {
      Print(name, what + "/" + std::string(InfoOf(film.planes[i].kind).name), ToHex(HashPlane(film, i)));
    }
  }
}

void Execute(const std::vector<std::string>& arguments) {
  int size = 96;
  std::string environment;
  std::vector<Run> runs;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string& argument = arguments[i];
    const auto value = [&]() -> const std::string& {
      if (i + 1 == arguments.size()) throw Error(ErrorCode::InvalidUsage, "needs a value", argument);
      return arguments[++i];
    };
    if (argument == "--targets") {
      for (Target target : kTargets) {
        if (TargetIsAvailable(target)) std::printf("%s\n", TargetName(target));
      }
    } else if (argument == "--hostile") {
      MakeHostile();
    } else if (argument == "--size") {
      size = std::stoi(value());
    } else if (argument == "--run") {
      runs.push_back(ParseRun(value()));
    } else if (argument == "--environment") {
      environment = value();
    } else {
      const std::string name = environment.empty() ? argument : argument + " + " + environment;
      try {
        HashOne(name, argument, environment, size, runs);
      } catch (const Error& error) {
        const bool skipped = error.code() == ErrorCode::MissingModule;
        Print(name, skipped ? "skipped" : "error", error.what());
      }
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    Execute({argv + 1, argv + argc});
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "film_hashes: %s\n", error.what());
    return 2;
  }
}
