// Renders a glTF file with a fragment shader of one's own: my_own_shader IN.glb OUT.png
#include <cstdio>

#include "facet/facet.h"
#include "toon.shader.h"  // written by facet_add_shader(), see docs/library.md

int main(int argc, char** argv) {
  if (argc != 3) return std::fprintf(stderr, "usage: my_own_shader IN.glb OUT.png\n"), 2;
  try {
    const facet::LoadedScene loaded = facet::LoadGltf(argv[1]);
    const auto toon = facet::MakeToon({.shade_below = 0.3f, .shine_above = 0.7f});
    facet::RenderSettings settings;
    settings.width = 640;
    settings.height = 480;
    settings.shader = toon.get();
    facet::RenderStats stats;
    facet::WriteImage(argv[2], facet::EncodeFilm(facet::Render(loaded.scene, settings, &stats), {}));
    std::printf("%llu pixels covered\n", static_cast<unsigned long long>(stats.covered_pixels));
  } catch (const facet::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return facet::ExitCode(error.code());
  }
  return 0;
}
