// decoder_files FOLDER: empties the folder and fills it.
#include <cmath>
#include <cstdio>
#include <exception>
#include <fstream>
#include <stdexcept>

#include "gltf_writer.h"

namespace facet::decoder_files {

float PatternAt(int x, int y, int channel) {
  if ((x / 8 + y / 8) % 3 == 0) return float((x / 4 + y / 2 + channel) % 2);
  const auto part = [](int number, std::uint32_t prime) { return static_cast<std::uint32_t>(number) * prime; };
  const std::uint32_t hash =
      (part(x, 73856093) ^ part(y, 19349663) ^ part(channel, 83492791)) * 2654435769u;  // wraps around
  if (y > kPatternHeight / 2) return float(hash >> 24) / 255.0f;
  return 0.5f + 0.5f * std::sin(float(x) * 0.21f + float(y) * 0.13f * float(channel + 1));
}

void WriteWhole(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream file(path, std::ios::binary);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!file.flush()) throw std::runtime_error(path.string() + ": cannot be written");
}

void WritePictures(const std::filesystem::path& path, const std::string& mime,
                   const std::vector<std::string>& pictures) {
  GltfWriter file;
  file.Require("KHR_materials_unlit");
  const int uvs = file.Accessor(Values<float, 2>{{0, 1}, {1, 1}, {1, 0}, {0, 0}}, kFloat, "VEC2");
  const int indices = file.Accessor(std::vector<std::uint16_t>{0, 1, 2, 0, 2, 3}, kUnsignedShort, "SCALAR");
  Json primitives;
  int columns = 1;
  while (columns * columns < static_cast<int>(pictures.size())) ++columns;
  for (int i = 0; i < static_cast<int>(pictures.size()); ++i) {
    file.Append("images", {{"bufferView", file.View(pictures[static_cast<std::size_t>(i)])}, {"mimeType", mime}});
    file.Append("textures", {{"source", i}});
    if (mime == "image/webp") file.root["textures"][i] = {{"extensions", {{"EXT_texture_webp", {{"source", i}}}}}};
    file.Append("materials", {{"alphaMode", "BLEND"},
                              {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", i}}}}},
                              {"extensions", {{"KHR_materials_unlit", Json::object()}}}});
    const auto x = float(i % columns) * 1.1f, y = float(i / columns) * -1.1f;
    const Values<float, 3> corners{{x, y, 0}, {x + 1, y, 0}, {x + 1, y + 1, 0}, {x, y + 1, 0}};
    primitives.push_back(
        Json{{"attributes", {{"POSITION", file.Accessor(corners, kFloat, "VEC3")}, {"TEXCOORD_0", uvs}}},
             {"indices", indices},
             {"material", i}});
  }
  if (mime == "image/webp") file.Require("EXT_texture_webp");
  file.Append("meshes", {{"primitives", primitives}});
  file.Append("nodes", {{"mesh", 0}});
  file.Write(path);
}

void WriteAll(const Folder& folder) {
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  WriteDraco(folder);
  WriteMeshopt(folder);
  WriteJpeg(folder);
  WritePng(folder);
  WriteRadiance(folder);
#if FACET_HAS_OPENIMAGEIO
  WriteByOpenImageIo(folder);
#endif
}

}  // namespace facet::decoder_files

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: decoder_files FOLDER\n");
    return 2;
  }
  try {
    facet::decoder_files::WriteAll(argv[1]);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "decoder_files: %s\n", error.what());
    return 2;
  }
}
