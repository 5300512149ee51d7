// Renders a glTF file to a picture: render_a_file IN.glb OUT.png
#include <cstdio>

#include "facet/facet.h"

int main(int argc, char** argv) {
  if (argc != 3) return std::fprintf(stderr, "usage: render_a_file IN.glb OUT.png\n"), 2;
  try {
    const facet::LoadedScene loaded = facet::LoadGltf(argv[1]);
    for (const std::string& warning : loaded.report.warnings) std::fprintf(stderr, "%s\n", warning.c_str());

    facet::RenderSettings settings;  // 1024 x 1024, 4 samples, framed from the bounds, studio light
    settings.width = 640;
    settings.height = 480;
    facet::RenderStats stats;
    const facet::Film film = facet::Render(loaded.scene, settings, &stats);

    facet::DisplaySettings display;
    display.background_srgb = glm::vec3(1.0f);
    facet::WriteImage(argv[2], facet::EncodeFilm(film, display));
    std::printf("%llu pixels covered\n", static_cast<unsigned long long>(stats.covered_pixels));
  } catch (const facet::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return facet::ExitCode(error.code());
  }
  return 0;
}
