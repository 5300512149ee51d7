#include "image/format.h"

namespace facet {
namespace {

using namespace std::string_view_literals;

constexpr ImageFormat kFormats[] = {
    {0, "\x89PNG"sv, "png", "PNG"},
    {0, "\xFF\xD8\xFF"sv, "jpg", "JPEG"},
    {8, "WEBP"sv, "webp", "WebP"},
    {0, "#?R"sv, "hdr", "Radiance HDR"},
    {0, "\x76\x2F\x31\x01"sv, "exr", "OpenEXR"},
    {0, "\xABKTX 20\xBB"sv, "ktx2", "KTX2"},
    {0, "\xABKTX 11\xBB"sv, "ktx", "KTX"},
    {0, "II*\0"sv, "tif", "TIFF"},
    {0, "MM\0*"sv, "tif", "TIFF"},
    {0, "II+\0"sv, "tif", "TIFF"},
    {0, "MM\0+"sv, "tif", "TIFF"},
    {0, "GIF8"sv, "gif", "GIF"},
    {0, "BM"sv, "bmp", "BMP"},
    {0, "DDS "sv, "dds", "DDS"},
    {0, "8BPS"sv, "psd", "Photoshop"},
    {4, "jP  "sv, "jp2", "JPEG 2000"},
    {0, "\xFF\x4F\xFF\x51"sv, "j2c", "JPEG 2000"},
    {4, "ftypheic"sv, "heic", "HEIF"},
    {4, "ftypmif1"sv, "heic", "HEIF"},
    {4, "ftypavif"sv, "avif", "AVIF"},
    {0, "SDPX"sv, "dpx", "DPX"},
    {0, "XPDS"sv, "dpx", "DPX"},
    {0, "\x80\x2A\x5F\xD7"sv, "cin", "Cineon"},
    {0, "\x01\xDA"sv, "sgi", "SGI"},
    {0, "SIMPLE"sv, "fits", "FITS"},
    {0, "P1"sv, "pbm", "PBM"},
    {0, "P2"sv, "pgm", "PGM"},
    {0, "P3"sv, "ppm", "PPM"},
    {0, "P4"sv, "pbm", "PBM"},
    {0, "P5"sv, "pgm", "PGM"},
    {0, "P6"sv, "ppm", "PPM"},
    {0, "PF\n"sv, "pfm", "PFM"},
    {0, "Pf\n"sv, "pfm", "PFM"},
    {0, "\0\0\1\0"sv, "ico", "icon"},
};
constexpr ImageFormat kTarga = {0, ""sv, "tga", "Targa"};

bool IsTargaName(std::string_view name) {
  if (name.size() < 4) return false;
  name.remove_prefix(name.size() - 4);
  return name == ".tga" || name == ".TGA";
}

}  // namespace

const ImageFormat* FormatOf(std::span<const std::byte> bytes, std::string_view name) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  for (const ImageFormat& format : kFormats) {
    if (text.size() > format.at && text.substr(format.at).starts_with(format.signature)) return &format;
  }
  return IsTargaName(name) ? &kTarga : nullptr;
}

}  // namespace facet
