// WriteImage of facet/film.h. PNG, JPEG and WebP are encoded here, all else by OpenImageIO. OpenEXR gets linear light
// as floats with the colours multiplied by alpha, as that format wants them (8 and 16 bits are decoded first); Radiance
// gets linear light; TIFF keeps the numbers, alpha straight; the others 8 bits. A format that gets no alpha takes
// opaque pictures only.
#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "facet/error.h"
#include "image/codec.h"
#include "image/convert.h"
#include "image/jpeg.h"
#include "image/oiio_loader.h"
#include "image/webp.h"

namespace facet {
namespace {

// How a format holds numbers, and what becomes of alpha.
enum class Holds { Png, LinearPremultiplied, LinearOpaque, Bytes, BytesOpaque, Anything };

struct Format {
  const char* extension;
  Holds holds;
};

constexpr Format kFormats[] = {
    {".png", Holds::Png},          {".exr", Holds::LinearPremultiplied},
    {".hdr", Holds::LinearOpaque}, {".tif", Holds::Anything},
    {".tiff", Holds::Anything},    {".jpg", Holds::BytesOpaque},
    {".jpeg", Holds::BytesOpaque}, {".webp", Holds::Bytes},
    {".bmp", Holds::BytesOpaque},  {".tga", Holds::Bytes},
    {".ppm", Holds::BytesOpaque},
};

const Format& FormatByName(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  std::string known;
  for (const Format& format : kFormats) {
    if (extension == format.extension) return format;
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

// The image in the form that the format holds.
Image FormFor(Holds holds, const Image& image, const std::filesystem::path& path) {
  switch (holds) {
    case Holds::LinearPremultiplied: {
      Image form = ToLinear32F(image);
      Premultiply(form, image.type == ChannelType::F32);
      return form;
    }
    case Holds::LinearOpaque: return WithChannels(ToLinear32F(Opaque(image, path)), 3);
    case Holds::Bytes: return Bytes(image, path);
    case Holds::BytesOpaque: return Bytes(Opaque(image, path), path);
    default: return image;
  }
}

std::vector<std::byte> Encode(const Format& format, const Image& image, const std::filesystem::path& path,
                              const TextMaker& make_text) {
  if (format.holds == Holds::Png) return EncodePng(image, [&] { return make_text(image); });
  const Image form = FormFor(format.holds, image, path);
  const std::string extension = std::string(format.extension).substr(1);
  if (extension == "jpg" || extension == "jpeg") return EncodeJpeg(form.channels == 2 ? WithChannels(form, 1) : form);
  if (extension == "webp") return EncodeWebP(form.channels < 3 ? WithChannels(form, form.channels + 2) : form);
  const bool is_exr = format.holds == Holds::LinearPremultiplied;
  return EncodeWithOiio(extension, form, is_exr, is_exr ? make_text(form) : ImageText());
}

}  // namespace

void WriteImage(const std::filesystem::path& path, const Image& image,
                const std::vector<std::array<std::string, 2>>& text) {
  WriteImageWithText(path, image, [&](const Image&) { return text; });
}

Image StoredForm(const std::filesystem::path& path, const Image& image) {
  return FormFor(FormatByName(path).holds, image, path);
}

void WriteImageWithText(const std::filesystem::path& path, const Image& image, const TextMaker& make_text) {
  const Format& format = FormatByName(path);
  CheckImage(image, path.c_str());
  OutputFile file(path);  // before the work: it may not be writable
  try {
    file.Write(Encode(format, image, path, make_text));
  } catch (const Error& error) {
    if (!error.where().empty()) throw;
    throw Error(error.code(), error.message(), path.string(), error.hint());
  }
  file.Commit();
}

}  // namespace facet
