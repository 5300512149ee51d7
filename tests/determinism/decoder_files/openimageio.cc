#include <OpenImageIO/imageio.h>

#include <fstream>
#include <sstream>
#include <stdexcept>

#include "gltf_writer.h"

namespace facet::decoder_files {
namespace {

void WriteImage(const std::filesystem::path& path, int channels, OIIO::TypeDesc type, const std::string& compression) {
  OIIO::ImageSpec spec(kPatternWidth, kPatternHeight, channels, type);
  spec.attribute("compression", compression);
  std::vector<float> pixels;
  for (int y = 0; y < kPatternHeight; ++y) {
    for (int x = 0; x < kPatternWidth; ++x) {
      // Beyond 1 where the file may hold it.
      const float scale = type.is_floating_point() && x % 16 == 3 ? 37.0f : 1.0f;
      for (int c = 0; c < channels; ++c) pixels.push_back(PatternAt(x, y, c) * (c < 3 ? scale : 1.0f));
    }
  }
  const auto output = OIIO::ImageOutput::create(path.string());
  if (!output || !output->open(path.string(), spec) || !output->write_image(OIIO::TypeDesc::FLOAT, pixels.data()) ||
      !output->close()) {
    throw std::runtime_error(path.string() + ": " + (output ? output->geterror() : OIIO::geterror()));
  }
}

std::string WebP(const Folder& folder, int channels, const std::string& compression) {
  const std::filesystem::path path = folder / "scratch.webp";
  WriteImage(path, channels, OIIO::TypeDesc::UINT8, compression);
  std::ostringstream bytes;
  bytes << std::ifstream(path, std::ios::binary).rdbuf();
  std::filesystem::remove(path);
  return bytes.str();
}

}  // namespace

void WriteByOpenImageIo(const Folder& folder) {
  WritePictures(folder / "webp-lossy.glb", "image/webp",
                {WebP(folder, 3, "webp:20"), WebP(folder, 3, "webp:75"), WebP(folder, 3, "webp:100")});
  WritePictures(folder / "webp-lossless.glb", "image/webp", {WebP(folder, 3, "lossless"), WebP(folder, 4, "lossless")});
  WritePictures(folder / "webp-alpha.glb", "image/webp", {WebP(folder, 4, "webp:30"), WebP(folder, 4, "webp:90")});
  // Without DWAA and DWAB, whose transform OpenEXR computes by what the processor has, in other bits.
  for (const std::string compression : {"none", "rle", "zips", "zip", "piz", "pxr24", "b44", "b44a"}) {
    WriteImage(folder / ("exr-half-" + compression + ".exr"), 3, OIIO::TypeDesc::HALF, compression);
    WriteImage(folder / ("exr-float-" + compression + ".exr"), 3, OIIO::TypeDesc::FLOAT, compression);
  }
  for (const std::string compression : {"none", "lzw", "zip"}) {
    for (const auto& [name, type] : {std::pair{"8", OIIO::TypeDesc::UINT8}, std::pair{"16", OIIO::TypeDesc::UINT16},
                                     std::pair{"float", OIIO::TypeDesc::FLOAT}}) {
      WriteImage(folder / (std::string("tiff-") + name + "-" + compression + ".tif"), 3, type, compression);
    }
  }
}

}  // namespace facet::decoder_files
