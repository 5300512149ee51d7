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
#include "image/exr_text.h"
#include "image/format.h"
#include "image/jpeg.h"
#include "image/limits.h"
#include "image/oiio_loader.h"
#include "image/png.h"
#include "image/probe.h"
#include "image/radiance.h"
#include "image/webp.h"

namespace facet {
namespace {

constexpr int kPieceRows = 64;  // a piece stays in the processor's cache until the receiver has it

using DecodeRowsOf = void (*)(std::span<const std::byte>, const std::string&, int, const PieceReceiver&);

// Before a decoder sees the file.
void CheckHeader(std::span<const std::byte> bytes, const std::string& name) {
  const std::optional<ImageHeader> header = ProbeImage(bytes);
  if (header && header->width > 0 && header->height > 0) {
    CheckImageSize(std::uint64_t(header->width), std::uint64_t(header->height), name);
  }
}

// Of the formats that are decoded row by row; null for others.
DecodeRowsOf RowDecoderOf(std::span<const std::byte> bytes) {
  return LooksLikePng(bytes) ? DecodePng : LooksLikeJpeg(bytes) ? DecodeJpeg : nullptr;
}

Image DecodeWhole(std::span<const std::byte> bytes, const std::string& name, ImageFormats formats) {
  if (LooksLikeWebP(bytes)) return DecodeWebP(bytes, name);
  const ImageFormat* const format = FormatOf(bytes, name);
  if (formats == ImageFormats::Gltf) {
    throw Error(ErrorCode::InvalidInput,
                format != nullptr ? "a " + std::string(format->name) + " image, which glTF does not allow"
                                  : std::string("no image: its format is not known"),
                name, "convert it to PNG or JPEG");
  }
  if (LooksLikeRadiance(bytes)) return DecodeRadiance(bytes, name);
  if (format == nullptr) throw Error(ErrorCode::InvalidInput, "no image: its format is not known", name);
  return DecodeWithOiio(bytes, format->extension, name);
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

Image DecodeImage(std::span<const std::byte> bytes, const std::string& name, ImageFormats formats) {
  CheckHeader(bytes, name);
  const DecodeRowsOf decode = RowDecoderOf(bytes);
  if (decode == nullptr) return DecodeWhole(bytes, name, formats);
  Image image;
  MemoryLease lease;
  decode(bytes, name, kPieceRows, [&](Image& rows, int height) {
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
  CheckHeader(bytes, name);
  if (const DecodeRowsOf decode = RowDecoderOf(bytes)) return decode(bytes, name, kPieceRows, receive);
  const Image whole = DecodeWhole(bytes, name, formats);
  const MemoryLease lease(whole.bytes.size(), 1, "decoded images", name);
  receive(whole, whole.height);
}

Image DecodeStored(std::span<const std::byte> bytes, const std::string& name) {
  return LooksLikeExr(bytes) ? DecodeWithOiio(bytes, "exr", name, /*as_stored=*/true) : DecodeImage(bytes, name);
}

std::map<std::string, std::string> ReadImageText(std::span<const std::byte> bytes, const std::string& name) {
  if (LooksLikePng(bytes)) return ReadPngText(bytes, name);
  if (LooksLikeExr(bytes)) return ReadExrText(bytes, name);
  throw Error(ErrorCode::InvalidInput, "is neither PNG nor EXR", name);
}

Image LoadImage(const std::filesystem::path& path, std::uint64_t memory_limit) {
  const FloatEnvironment pinned;
  MemoryBudget budget(memory_limit);
  const MemoryBudget::Scope scope(budget);
  return DecodeImage(ReadFile(path).Span(), path.string());
}

}  // namespace facet
