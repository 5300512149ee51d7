// Images in memory, and their sources.
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

// How the values of an image relate to light.
enum class Encoding : std::uint8_t {
  Srgb,    // IEC 61966-2-1 transfer function (alpha is always linear)
  Linear,  // proportional to light, Rec. 709 primaries; or plain data
};

enum class ChannelType : std::uint8_t { U8, U16, F32 };

constexpr std::size_t SizeOf(ChannelType type) {
  return type == ChannelType::U8 ? 1 : type == ChannelType::U16 ? 2 : 4;
}

// An image: `height` rows of `width` pixels of `channels` interleaved components, top row first, without padding.
// Alpha, if there is one (2 or 4 channels), is straight (unassociated). U8 and U16 stand for [0, 1].
struct Image {
  int width = 0;
  int height = 0;
  int channels = 0;  // 1 grey, 2 grey + alpha, 3 RGB, 4 RGBA
  ChannelType type = ChannelType::U8;
  Encoding encoding = Encoding::Srgb;
  std::vector<std::byte> bytes;  // width * height * channels * SizeOf(type), native byte order
  std::string damage = {};       // one line about damage in the file that did not affect the pixels; usually empty

  std::size_t PixelCount() const { return std::size_t(width) * std::size_t(height); }
  template <class T>
  const T* As() const { return reinterpret_cast<const T*>(bytes.data()); }
  template <class T>
  T* As() { return reinterpret_cast<T*>(bytes.data()); }
};

// The header of an encoded image. 0 (or empty) stands for what is not known.
struct ImageHeader {
  std::string format;     // its name in words, such as "Radiance HDR"; empty for an image in memory
  int width = 0;          // pixels
  int height = 0;         // pixels
  int channels = 0;       // after decoding: a palette counts as RGB or RGBA, CMYK as RGB
  int bits = 0;           // per channel, after decoding: 1-bit grey counts as 8, Radiance HDR as 32
  std::size_t bytes = 0;  // size of the encoded image
};

// Receives the rows of an image as they are decoded, from top to bottom: `rows` holds some of them and is valid during
// the call only; `height` is that of the whole image.
using RowReceiver = std::function<void(const Image& rows, int height)>;

// An image that is decoded when it is needed. Implementations are immutable and thread-safe.
class ImageSource {
 public:
  virtual ~ImageSource() = default;
  // Decodes the image. Throws Error (InvalidInput, NotFound, MissingModule).
  virtual Image Decode() const = 0;
  // Decodes the image and passes its rows to `receive`; where the format allows, the whole image is never in memory.
  // Throws what Decode() throws, possibly after some rows, and what `receive` throws.
  virtual void DecodeRows(const RowReceiver& receive) const;
  // The name for messages: a file name, or "image 3 of scene.glb".
  virtual std::string Name() const = 0;
  // Reads the header, without decoding; nullopt if there is none that can be read. Decode() may still fail. Throws only
  // when memory runs out.
  virtual std::optional<ImageHeader> Header() const { return std::nullopt; }
  // Whether Decode() may succeed after it failed, for example because a missing file may have appeared.
  virtual bool MayChange() const { return false; }
  // Bytes of memory that the source holds.
  virtual std::size_t BytesHeld() const { return 0; }
};

// An ImageSource of an image in memory. Its header has no format, and the size of the pixels in bytes.
std::shared_ptr<const ImageSource> MakeImageSource(Image image, std::string name);

// The digest of the line "facet image WIDTH HEIGHT CHANNELS BITS ENCODING\n" (32 bits are floats; ENCODING is srgb or
// linear) followed by the pixels, little-endian, top row first.
Digest HashImage(const Image& image);

// Loads an image file of any format that facet or OpenImageIO reads. `memory_limit`: in bytes; 0: three quarters of the
// machine's memory. Throws Error: NotFound, InvalidInput, OutOfMemory, MissingModule.
Image LoadImage(const std::filesystem::path& path, std::uint64_t memory_limit = 0);

// Writes an image file; the extension gives the format: .png (U8, U16), .exr, or another that OpenImageIO writes. If
// writing fails, no file is left behind. `text`: pairs of keyword and value, stored in PNG and EXR only. Throws Error:
// InvalidUsage (unknown extension), OutputFailed, MissingModule.
void WriteImage(const std::filesystem::path& path, const Image& image,
                const std::vector<std::array<std::string, 2>>& text = {});

}  // namespace facet
