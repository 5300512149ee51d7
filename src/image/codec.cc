#include "image/codec.h"

#include <cstdint>
#include <new>
#include <string>
#include <utility>

#include "base/bytes_text.h"
#include "base/float_environment.h"
#include "base/input_file.h"
#include "base/pages.h"
#include "facet/error.h"
#include "image/file_start.h"
#include "image/formats.h"
#include "image/limits.h"
#include "image/oiio_loader.h"

namespace facet {
namespace {

constexpr int kPieceRows = 64;  // few enough that a piece stays in the processor's cache until it is received

// The format of a file, which must be allowed to be decoded; checked before any decoder sees it. Throws as
// DecodeImage().
const ImageFormat& FormatToDecode(std::span<const std::byte> bytes, const std::string& name, ImageFormats formats) {
  const std::optional<ImageHeader> header = ProbeImage(bytes);
  if (header && header->width > 0 && header->height > 0) {
    CheckImageSize(std::uint64_t(header->width), std::uint64_t(header->height), name);
  }
  const ImageFormat* const format = FormatOf(bytes, name);
  const bool gltf = formats == ImageFormats::Gltf;
  if (format != nullptr && (format->in_gltf || !gltf)) return *format;
  throw Error(ErrorCode::InvalidInput,
              format != nullptr ? "a " + std::string(format->name) + " image, which glTF does not allow"
                                : std::string("no image: its format is not known"),
              name, gltf ? "convert it to PNG or JPEG" : "");
}

Image DecodeByModule(const ImageFormat& format, std::span<const std::byte> bytes, const std::string& name,
                     bool as_stored = false) {
  if (format.check != nullptr) format.check(bytes, name);
  return DecodeWithOiio(bytes, format.extensions[0].substr(1), name, as_stored);
}

Image DecodeWhole(const ImageFormat& format, std::span<const std::byte> bytes, const std::string& name) {
  return format.decode != nullptr ? format.decode(bytes, name) : DecodeByModule(format, bytes, name);
}

}  // namespace

void CheckImageSize(std::uint64_t width, std::uint64_t height, const std::string& name) {
  if (width == 0 || height == 0) throw Error(ErrorCode::InvalidInput, "an empty picture", name);
  const auto side = static_cast<std::uint64_t>(kMaxImageSide);
  if (width <= side && height <= side && width * height <= kMaxImagePixels) return;
  throw Error(ErrorCode::OutOfMemory,
              std::to_string(width) + " x " + std::to_string(height) + " pixels, " +
                  BytesText(4.0 * double(width) * double(height)) + " at 4 bytes each, are more than the limit of " +
                  std::to_string(kMaxImageSide) + " a side and " + std::to_string(kMaxImagePixels) + " in all",
              name, "scale the picture down");
}

MemoryLease LeaseImage(std::uint64_t width, std::uint64_t height, std::uint64_t rows, std::uint64_t bytes_per_pixel,
                       const std::string& name) {
  CheckImageSize(width, height, name);
  return MemoryLease(width * rows, bytes_per_pixel,
                     "decoding an image of " + std::to_string(width) + " x " + std::to_string(height) + " pixels", name,
                     "scale the image down");
}

void ReservePixels(std::vector<std::byte>& pixels, std::size_t count, const std::string& name) {
  try {
    pixels.reserve(count);
    PreferHugePages(pixels.data(), count);
  } catch (const std::bad_alloc&) {
    throw Error(ErrorCode::OutOfMemory, "no memory for " + std::to_string(count) + " bytes of pixels", name);
  }
}

std::vector<std::byte> AllocatePixels(std::size_t count, const std::string& name) {
  std::vector<std::byte> pixels;
  ReservePixels(pixels, count, name);
  pixels.resize(count);
  return pixels;
}

std::optional<ImageHeader> ProbeImage(std::span<const std::byte> bytes) {
  const ImageFormat* const format = FormatOf(bytes);
  if (format == nullptr || format->probe == nullptr) return std::nullopt;
  ImageHeader header;
  header.format = format->name;
  header.bytes = bytes.size();
  format->probe(FileStart(bytes), header);
  return header;
}

Image DecodeImage(std::span<const std::byte> bytes, const std::string& name, ImageFormats formats) {
  const ImageFormat& format = FormatToDecode(bytes, name, formats);
  if (format.decode_rows == nullptr) return DecodeWhole(format, bytes, name);
  Image image;
  MemoryLease lease;
  format.decode_rows(bytes, name, kPieceRows, [&](Image& rows, int height) {
    if (rows.height == height) {
      image = std::move(rows);
      return;
    }
    const std::size_t row_bytes = rows.bytes.size() / std::size_t(rows.height);
    if (image.bytes.empty()) {
      lease = LeaseImage(std::uint64_t(rows.width), std::uint64_t(height), std::uint64_t(height),
                         row_bytes / std::size_t(rows.width), name);
      ReservePixels(image.bytes, row_bytes * std::size_t(height), name);
      image.width = rows.width, image.height = height, image.channels = rows.channels;
      image.type = rows.type, image.encoding = rows.encoding;
    }
    image.bytes.insert(image.bytes.end(), rows.bytes.begin(), rows.bytes.end());
    image.damage = rows.damage;
  });
  return image;
}

void DecodeImageRows(std::span<const std::byte> bytes, const std::string& name, const RowReceiver& receive,
                     ImageFormats formats) {
  const ImageFormat& format = FormatToDecode(bytes, name, formats);
  if (format.decode_rows != nullptr) return format.decode_rows(bytes, name, kPieceRows, receive);
  const Image whole = DecodeWhole(format, bytes, name);
  const MemoryLease lease(whole.bytes.size(), 1, "decoded images", name);
  receive(whole, whole.height);
}

Image DecodeStored(std::span<const std::byte> bytes, const std::string& name) {
  const ImageFormat* const format = FormatOf(bytes);
  const bool associated = format != nullptr && format->alpha == FileAlpha::Associated;
  return associated ? DecodeByModule(*format, bytes, name, /*as_stored=*/true) : DecodeImage(bytes, name);
}

std::map<std::string, std::string> ReadImageText(std::span<const std::byte> bytes, const std::string& name) {
  const ImageFormat* const format = FormatOf(bytes);
  if (format != nullptr && format->read_text != nullptr) return format->read_text(bytes, name);
  throw Error(ErrorCode::InvalidInput, "is neither PNG nor EXR", name);
}

Image LoadImage(const std::filesystem::path& path, std::uint64_t memory_limit) {
  const FloatEnvironment pinned;
  MemoryBudget budget(memory_limit);
  const MemoryBudget::Scope scope(budget);
  return DecodeImage(ReadFile(path).Span(), path.string());
}

}  // namespace facet
