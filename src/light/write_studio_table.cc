// Prepares the studio as any environment is prepared, and writes what comes out as a C++ source: kStudioTable. Part of
// the build; the bits are those that preparing it at run time gives.
#include <bit>
#include <cstdio>

#include "light/studio_table.h"

int main(int argc, char** argv) {
  using namespace facet;
  const auto map = PrefilterEnvironment(StudioImage(kStudioWidth, kStudioHeight), kStudioOptions);
  std::FILE* file = argc == 2 ? std::fopen(argv[1], "w") : nullptr;
  if (file == nullptr) {
    std::fprintf(stderr, "write_studio_table: give the name of a file that can be written\n");
    return 1;
  }
  std::fprintf(file, "#include \"light/studio_table.h\"\nnamespace facet {\nconst std::uint32_t kStudioTable[] = {\n");
  for (std::size_t i = 0; i < map->texels.size(); i += 4) {
    const std::uint32_t red = std::bit_cast<std::uint32_t>(map->texels[i]);
    std::fprintf(file, "0x%08x,%s", unsigned(red), i % 40 == 36 ? "\n" : "");
  }
  std::fprintf(file, "};\nconst std::size_t kStudioTableSize = %zu;\n}  // namespace facet\n", map->texels.size() / 4);
  const bool written = std::ferror(file) == 0;
  return std::fclose(file) == 0 && written ? 0 : 1;
}
