#include "image/formats.h"

#include <algorithm>

#include "base/printable.h"
#include "facet/error.h"
#include "image/exr.h"
#include "image/jpeg.h"
#include "image/ktx2.h"
#include "image/png.h"
#include "image/radiance.h"
#include "image/webp.h"

namespace facet {
namespace {

using namespace std::string_view_literals;

constexpr unsigned kU8 = 1u << static_cast<unsigned>(ChannelType::U8);
constexpr unsigned kU16 = 1u << static_cast<unsigned>(ChannelType::U16);
constexpr unsigned kF32 = 1u << static_cast<unsigned>(ChannelType::F32);

// The first matching format counts; messages list extensions in this order.
constexpr ImageFormat kFormats[] = {
    {.name = "PNG",
     .extensions = {".png"},
     .signatures = {"\x89PNG\r\n\x1A\n"},
     .in_gltf = true,
     .probe = ProbePng,
     .decode_rows = DecodePng,
     .read_text = ReadPngText,
     .types = kU8 | kU16,
     .alpha = FileAlpha::Straight,
     .encode = EncodePng},
    {.name = "OpenEXR",
     .extensions = {".exr"},
     .signatures = {"\x76\x2F\x31\x01...."},
     .check = CheckExrHeader,
     .read_text = ReadExrText,
     .types = kF32,
     .alpha = FileAlpha::Associated},
    {.name = "Radiance HDR",
     .extensions = {".hdr"},
     .signatures = {"#?RADIANCE", "#?RGBE"},
     .probe = ProbeRadiance,
     .decode = DecodeRadiance,
     .types = kF32,
     .has_grey = false},
    {.name = "TIFF",
     .extensions = {".tif", ".tiff"},
     .signatures = {"II*\0"sv, "MM\0*"sv, "II+\0"sv, "MM\0+"sv},
     .types = kU8 | kU16 | kF32,
     .alpha = FileAlpha::Straight},
    {.name = "WebP",
     .extensions = {".webp"},
     .signatures = {"RIFF....WEBP"},
     .in_gltf = true,
     .probe = ProbeWebP,
     .decode = DecodeWebP,
     .types = kU8,
     .alpha = FileAlpha::Straight,
     .has_grey = false,
     .encode = [](const Image& form, const MakeText&) { return EncodeWebP(form); }},
    {.name = "JPEG",
     .extensions = {".jpg", ".jpeg"},
     .signatures = {"\xFF\xD8\xFF"},
     .in_gltf = true,
     .probe = ProbeJpeg,
     .decode_rows = DecodeJpeg,
     .types = kU8,
     .encode = [](const Image& form, const MakeText&) { return EncodeJpeg(form); }},
    {.name = "Targa", .extensions = {".tga"}, .types = kU8, .alpha = FileAlpha::Straight},
    {.name = "BMP", .extensions = {".bmp"}, .signatures = {"BM"}, .types = kU8},
    {.name = "PPM", .extensions = {".ppm"}, .signatures = {"P3", "P6"}, .types = kU8},
    {.name = "KTX2", .extensions = {".ktx2"}, .signatures = {"\xABKTX 20\xBB\r\n\x1A\n"}, .probe = ProbeKtx2},
    {"KTX", {".ktx"}, {"\xABKTX 11\xBB"}},
    {"GIF", {".gif"}, {"GIF8"}},
    {"DDS", {".dds"}, {"DDS "}},
    {"Photoshop", {".psd"}, {"8BPS"}},
    {"JPEG 2000", {".jp2"}, {"....jP  "}},
    {"JPEG 2000", {".j2c"}, {"\xFF\x4F\xFF\x51"}},
    {"HEIF", {".heic"}, {"....ftyphei", "....ftypmif1"}},
    {"AVIF", {".avif"}, {"....ftypavif"}},
    {"DPX", {".dpx"}, {"SDPX", "XPDS"}},
    {"Cineon", {".cin"}, {"\x80\x2A\x5F\xD7"}},
    {"SGI", {".sgi"}, {"\x01\xDA"}},
    {"FITS", {".fits"}, {"SIMPLE"}},
    {"PBM", {".pbm"}, {"P1", "P4"}},
    {"PGM", {".pgm"}, {"P2", "P5"}},
    {"PFM", {".pfm"}, {"PF\n", "Pf\n"}},
    {"icon", {".ico"}, {"\0\0\1\0"sv}},
    // Files that only resemble a format above: the module reports the error.
    {"PNG", {".png"}, {"\x89PNG"}},
    {"WebP", {".webp"}, {"........WEBP"}},
    {"Radiance HDR", {".hdr"}, {"#?R"}},
    {"OpenEXR", {".exr"}, {"\x76\x2F\x31\x01"}},
    {"KTX2", {".ktx2"}, {"\xABKTX 20\xBB"}},
};

bool Begins(std::string_view file, std::string_view signature) {
  return !signature.empty() && file.size() >= signature.size() &&
         std::equal(signature.begin(), signature.end(), file.begin(),
                    [](char expected, char c) { return expected == '.' || expected == c; });
}

std::string Lower(std::string text) {
  for (char& c : text) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return text;
}

}  // namespace

const ImageFormat* FormatBySignature(std::string_view file, std::size_t fewest) {
  for (const ImageFormat& format : kFormats) {
    for (const std::string_view signature : format.signatures) {
      if (signature.size() >= fewest && Begins(file, signature)) return &format;
    }
  }
  return nullptr;
}

const ImageFormat* FormatOf(std::span<const std::byte> bytes, std::string_view name) {
  const std::string_view file(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (const ImageFormat* const format = FormatBySignature(file)) return format;
  const std::string lower = Lower(std::string(name));
  for (const ImageFormat& format : kFormats) {
    if (format.signatures[0].empty() && lower.ends_with(format.extensions[0])) return &format;
  }
  return nullptr;
}

std::string FormatsOfFacet(bool writing) {
  std::string list;
  for (const ImageFormat& format : kFormats) {
    const bool reads = format.decode != nullptr || format.decode_rows != nullptr;
    if (writing ? format.encode == nullptr : !reads) continue;
    list += list.empty() ? "" : ", ";
    list += format.name;
  }
  return list;
}

std::string ExtensionOf(const std::filesystem::path& path) { return Lower(path.extension().string()); }

const ImageFormat& FormatToWrite(const std::filesystem::path& path) {
  const std::string named = ExtensionOf(path);
  std::string list;
  for (const ImageFormat& format : kFormats) {
    if (format.types == 0) continue;
    for (const std::string_view extension : format.extensions) {
      if (extension.empty()) continue;
      if (extension == named) return format;
      list += list.empty() ? "" : ", ";
      list += extension;
    }
  }
  throw Error(
      ErrorCode::InvalidUsage,
      named.empty() ? "the name has no extension to tell the format by" : "facet writes no " + Quoted(named) + " files",
      Printable(path.string()), "use one of " + list);
}

}  // namespace facet
