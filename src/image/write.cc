// WriteImage() of facet/image.h. The image is converted to what the format's row in formats.cc says: formats of floats
// get linear light (8 and 16 bits are decoded first), formats of bytes get 8 bits, others get the components as they
// are. Formats without alpha accept opaque images only.
#include <array>
#include <string>
#include <vector>

#include "facet/error.h"
#include "image/codec.h"
#include "image/convert.h"
#include "image/formats.h"
#include "image/oiio_loader.h"

namespace facet {
namespace {

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
                "convert to 8 bits, or write .exr, .hdr or .tif");
  }
  return WithType(image, ChannelType::U8);
}

// `keep_glow`: in float images, colour with alpha 0 is light without coverage and is kept, as decoding does; in integer
// images it has no meaning.
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

// The image in the form that the format stores: `image` itself, or `converted`.
const Image& FormFor(const ImageFormat& format, const Image& image, const std::filesystem::path& path,
                     Image& converted) {
  if (format.Holds(ChannelType::U16)) return image;
  const bool drops_alpha = format.alpha == FileAlpha::None;
  const Image opaque = drops_alpha ? Opaque(image, path) : Image();
  const Image& source = drops_alpha ? opaque : image;
  converted = format.IsLinear() ? ToLinear32F(source) : Bytes(source, path);
  if (format.alpha == FileAlpha::Associated) Premultiply(converted, image.type == ChannelType::F32);
  if (!format.has_grey && converted.channels < 3) converted = WithChannels(converted, converted.channels + 2);
  return converted;
}

std::vector<std::byte> Encode(const ImageFormat& format, const Image& form, const TextMaker& make_text) {
  const MakeText make = [&] { return format.read_text != nullptr ? make_text(form) : ImageText(); };
  if (format.encode != nullptr) return format.encode(form, make);
  const std::string extension(format.extensions[0].substr(1));
  return EncodeWithOiio(extension, form, format.alpha == FileAlpha::Associated, make());
}

}  // namespace

void WriteImage(const std::filesystem::path& path, const Image& image,
                const std::vector<std::array<std::string, 2>>& text) {
  WriteImageWithText(path, image, [&](const Image&) { return text; });
}

Image StoredForm(const std::filesystem::path& path, const Image& image) {
  Image converted;
  return FormFor(FormatToWrite(path), image, path, converted);
}

void WriteImageWithText(const std::filesystem::path& path, const Image& image, const TextMaker& make_text) {
  const ImageFormat& format = FormatToWrite(path);
  CheckImage(image, path.c_str());
  OutputFile file(path);  // first, because it may not be writable
  try {
    Image converted;
    file.Write(Encode(format, FormFor(format, image, path, converted), make_text));
  } catch (const Error& error) {
    if (!error.where().empty()) throw;
    throw Error(error.code(), error.message(), path.string(), error.hint());
  }
  file.Commit();
}

}  // namespace facet
