// Pictures in memory.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "facet/digest.h"

namespace facet {

// How the numbers of a picture relate to light.
enum class Encoding : std::uint8_t {
  Srgb,    // IEC 61966-2-1 transfer function (alpha is always linear)
  Linear,  // proportional to light, Rec. 709 primaries; or plain data
};

enum class ChannelType : std::uint8_t { U8, U16, F32 };

constexpr std::size_t SizeOf(ChannelType type) {
  return type == ChannelType::U8 ? 1 : type == ChannelType::U16 ? 2 : 4;
}

// A picture: `height` rows of `width` pixels of `channels` interleaved numbers, top row first, no padding.
// Alpha, where there is one (2 or 4 channels), is straight (unassociated). U8 and U16 are normalised to [0, 1].
struct Image {
  int width = 0;
  int height = 0;
  int channels = 0;  // 1 grey, 2 grey + alpha, 3 RGB, 4 RGBA
  ChannelType type = ChannelType::U8;
  Encoding encoding = Encoding::Srgb;
  std::vector<std::byte> bytes;  // width * height * channels * SizeOf(type), native byte order
  std::string damage = {};       // what was broken in the file without touching its pixels, one line; mostly empty

  std::size_t PixelCount() const { return std::size_t(width) * std::size_t(height); }
  template <class T>
  const T* As() const { return reinterpret_cast<const T*>(bytes.data()); }
  template <class T>
  T* As() { return reinterpret_cast<T*>(bytes.data()); }
};

// What an encoded picture says of itself at its start. 0 (or empty) where it is not known.
struct ImageHeader {
  std::string format;     // "PNG", "JPEG", "WebP", "KTX2" or "Radiance HDR"; empty for a picture that is in memory
  int width = 0;          // pixels
  int height = 0;         // pixels
  int channels = 0;       // those of the decoded picture: a palette counts as RGB or RGBA, CMYK as RGB
  int bits = 0;           // of a channel, likewise: grey of 1 bit counts as 8, Radiance HDR as 32
  std::size_t bytes = 0;  // of the whole encoded picture
};

// Takes rows of a picture as they are decoded, top to bottom: an Image of some of them (valid during the call), and how
// many the whole picture has.
using RowReceiver = std::function<void(const Image& rows, int height)>;

// A picture that is decoded only when it is needed. Implementations are immutable and thread-safe.
class ImageSource {
 public:
  virtual ~ImageSource() = default;
  // The decoded picture. Throws Error (InvalidInput, NotFound, MissingModule).
  virtual Image Decode() const = 0;
  // The same picture piece by piece, where the format allows without ever having it whole. Throws what Decode() throws,
  // maybe after some rows, and what `receive` throws.
  virtual void DecodeRows(const RowReceiver& receive) const;
  // What a message calls it: a file name, or "image 3 of scene.glb".
  virtual std::string Name() const = 0;
  // What the first bytes say, without decoding; nullopt where they say nothing, or are not there. It is no promise that
  // Decode() succeeds. Throws nothing but what the lack of memory makes it throw.
  virtual std::optional<ImageHeader> Header() const { return std::nullopt; }
  // True where Decode() may succeed though it failed before, as of a file that was not there yet.
  virtual bool MayChange() const { return false; }
  // The memory that the source takes for as long as it lives.
  virtual std::size_t BytesHeld() const { return 0; }
};

// An ImageSource over a picture that is already in memory. Its header has no format, and the pixels' size in bytes.
std::shared_ptr<const ImageSource> MakeImageSource(Image image, std::string name);

// Of the line "facet image WIDTH HEIGHT CHANNELS BITS ENCODING\n" (32 bits are floats; srgb or linear) and the pixels
// as they lie in memory, little-endian, top row first.
Digest HashImage(const Image& image);

// Loads an image of any format that facet or OpenImageIO reads. `memory_limit`: bytes that it may take; 0: three
// quarters of what the machine has. Throws Error: NotFound, InvalidInput, OutOfMemory, MissingModule.
Image LoadImage(const std::filesystem::path& path, std::uint64_t memory_limit = 0);

// Writes by extension: .png (U8, U16), .exr and what else OpenImageIO writes. The file appears whole or not at all.
// `text`: keyword and value pairs, which PNG and EXR hold. Throws Error: InvalidUsage (unknown extension),
// OutputFailed, MissingModule.
void WriteImage(const std::filesystem::path& path, const Image& image,
                const std::vector<std::array<std::string, 2>>& text = {});

}  // namespace facet
