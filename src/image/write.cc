// WriteImage of facet/film.h. PNG is written here, all else by OpenImageIO. OpenEXR gets linear light as floats with
// the colours multiplied by alpha, as that format wants them (8 and 16 bits are decoded first); Radiance gets linear
// light; TIFF keeps the numbers, alpha straight; the others 8 bits. A format that gets no alpha takes opaque pictures
// only.
#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include <unistd.h>

#include "facet/error.h"
#include "facet/film.h"
#include "image/codec.h"
#include "image/convert.h"
#include "image/oiio_loader.h"

namespace facet {
namespace {

// How a format holds numbers, and what becomes of alpha.
enum class Holds { Png, LinearPremultiplied, LinearOpaque, Bytes, BytesOpaque, Anything };

struct Format {
  const char* extension;
  Holds holds;
};

constexpr Format kFormats[] = {
    {".png", Holds::Png},           {".exr", Holds::LinearPremultiplied}, {".hdr", Holds::LinearOpaque},
    {".tif", Holds::Anything},      {".tiff", Holds::Anything},           {".jpg", Holds::BytesOpaque},
    // OpenImageIO 2.4 divides the colours of WebP by alpha, whatever it is told.
    {".jpeg", Holds::BytesOpaque},  {".webp", Holds::BytesOpaque},        {".bmp", Holds::BytesOpaque},
    {".tga", Holds::Bytes},         {".ppm", Holds::BytesOpaque},
};

Holds HoldsOf(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  std::string known;
  for (const Format& format : kFormats) {
    if (extension == format.extension) return format.holds;
    known += (known.empty() ? "" : ", ") + std::string(format.extension);
  }
  throw Error(ErrorCode::InvalidUsage,
              extension.empty() ? "a picture's name needs an extension" : "no picture is written as " + extension,
              path.string(), "use one of " + known);
}

bool HasAlpha(const Image& image) { return image.channels == 2 || image.channels == 4; }

bool IsOpaque(const Image& image) {
  if (!HasAlpha(image)) return true;
  const std::size_t channels = static_cast<std::size_t>(image.channels), count = image.PixelCount() * channels;
  for (std::size_t i = channels - 1; i < count; i += channels) {
    const bool opaque = image.type == ChannelType::U8    ? image.As<std::uint8_t>()[i] == 0xFF
                        : image.type == ChannelType::U16 ? image.As<std::uint16_t>()[i] == 0xFFFF
                                                         : image.As<float>()[i] >= 1.0f;
    if (!opaque) return false;
  }
  return true;
}

Image Opaque(const Image& image, const std::filesystem::path& path) {
  if (!IsOpaque(image)) {
    throw Error(ErrorCode::InvalidUsage, "no alpha is written to this format, and the picture is transparent in places",
                path.string(), "give the picture a background, or write .png or .exr");
  }
  return HasAlpha(image) ? WithChannels(image, image.channels - 1) : image;
}

Image Bytes(const Image& image, const std::filesystem::path& path) {
  if (image.type == ChannelType::F32) {
    throw Error(ErrorCode::InvalidUsage, "this format cannot hold floats", path.string(),
                "develop to 8 bits, or write .exr, .hdr or .tif");
  }
  return WithType(image, ChannelType::U8);
}

// `keep_glow`: a float picture's colour where alpha is 0 is light without coverage, and stays (as decoding keeps it);
// in integers it is whatever the program that made the picture left there.
void Premultiply(Image& image, bool keep_glow) {
  if (!HasAlpha(image)) return;
  const std::size_t channels = static_cast<std::size_t>(image.channels);
  float* pixel = image.As<float>();
  for (std::size_t i = 0; i < image.PixelCount(); ++i, pixel += channels) {
    const float alpha = pixel[channels - 1];
    if (keep_glow && alpha == 0.0f) continue;
    for (std::size_t c = 0; c + 1 < channels; ++c) pixel[c] *= alpha;
  }
}

// The encoder's own message seldom says that a folder is missing or may not be written to; this asks the system.
void CheckFolderWritable(const std::filesystem::path& path) {
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
  if (::access(folder.c_str(), W_OK | X_OK) == 0) return;
  throw Error(ErrorCode::OutputFailed, std::string("cannot be written: ") + std::strerror(errno), path.string());
}

}  // namespace

void WriteImage(const std::filesystem::path& path, const Image& image,
                const std::vector<std::array<std::string, 2>>& text) {
  WriteImageWithText(path, image, [&] { return text; });
}

void WriteImageWithText(const std::filesystem::path& path, const Image& image,
                        const std::function<PngText()>& make_text) {
  const Holds holds = HoldsOf(path);
  CheckImage(image, path.c_str());
  if (holds == Holds::Png) return WriteFileWhole(path, EncodePng(image, make_text));

  bool premultiplied = false;
  Image form;
  switch (holds) {
    case Holds::LinearPremultiplied:
      form = ToLinear32F(image);
      Premultiply(form, image.type == ChannelType::F32);
      premultiplied = true;
      break;
    case Holds::LinearOpaque:
      form = WithChannels(ToLinear32F(Opaque(image, path)), 3);
      break;
    case Holds::Bytes:
      form = Bytes(image, path);
      break;
    case Holds::BytesOpaque:
      form = Bytes(Opaque(image, path), path);
      break;
    default:
      form = image;
  }
  CheckFolderWritable(path);
  RequireOiio();
  WriteFileWhole(path, [&](const std::filesystem::path& temporary) {
    try {
      EncodeWithOiio(temporary, form, premultiplied);
    } catch (const Error& error) {
      throw Error(error.code(), error.message(), path.string(), error.hint());
    }
  });
}

}  // namespace facet
