// Writes the bundled scenes and the studio environment: facet_assets FOLDER. The same bytes with every compiler and on
// every machine.

#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>

#include "scenes.h"
#include "studio.h"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: facet_assets FOLDER\n");
    return 2;
  }
  try {
    using facet::assets::Glb;
    const std::filesystem::path folder = std::filesystem::path(argv[1]) / "scenes";
    std::filesystem::create_directories(folder);
    struct Entry {
      const char* name;
      Glb (*make)();
    };
    for (const Entry& entry :
         {Entry{"material_grid.glb", facet::assets::MaterialGrid}, Entry{"materials.glb", facet::assets::Materials},
          Entry{"showcase.glb", facet::assets::Showcase}, Entry{"room.glb", facet::assets::Room},
          Entry{"animated.glb", facet::assets::Animated}, Entry{"gallery.glb", facet::assets::Gallery}}) {
      entry.make().Write(folder / entry.name);
    }
    facet::assets::WriteStudio(std::filesystem::path(argv[1]) / "studio.hdr");
  } catch (const std::exception& error) {
    std::fprintf(stderr, "facet_assets: %s\n", error.what());
    return 1;
  }
  return 0;
}
