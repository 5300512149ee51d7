// Writes the reference's image of a scene, for comparison with other renderers (tests/engines/compare_cycles.py):
//   reference_film IN OUT.exr WIDTH HEIGHT ENVIRONMENT|none SAMPLES BATCHES
// Through the file's first camera, or facet's own where it has none. Says the relative error that the image has left.
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <memory>
#include <string>

#include "facet/film.h"
#include "facet/load.h"
#include "reference/reference.h"

int main(int argc, char** argv) try {
  if (argc != 8) {
    std::fprintf(stderr, "usage: reference_film IN OUT.exr WIDTH HEIGHT ENVIRONMENT|none SAMPLES BATCHES\n");
    return 2;
  }
  const facet::LoadedScene loaded = facet::LoadGltf(argv[1]);
  facet::RenderSettings settings;
  settings.width = std::atoi(argv[3]);
  settings.height = std::atoi(argv[4]);
  if (!loaded.scene.cameras.empty()) settings.camera = facet::SceneCamera{0};
  const std::string environment = argv[5];
  settings.environment.kind = facet::EnvironmentSettings::Kind::None;
  if (environment != "none") {
    settings.environment.kind = facet::EnvironmentSettings::Kind::Image;
    settings.environment.image = std::make_shared<const facet::Image>(facet::LoadImage(environment));
  }
  facet::ReferenceSettings effort;
  effort.samples = std::atoi(argv[6]);
  effort.batches = std::atoi(argv[7]);
  const facet::ReferenceFilm film = facet::RenderReference(loaded.scene, settings, effort);
  facet::WriteImage(argv[2], facet::EncodeFilm(facet::ToFilm(film), {}, facet::ChannelType::F32));
  std::printf("%.3g\n", film.relative_error);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "reference_film: %s\n", error.what());
  return 1;
}
