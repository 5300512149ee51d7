// Pictures in memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

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

  std::size_t PixelCount() const { return std::size_t(width) * std::size_t(height); }
  template <class T>
  const T* As() const { return reinterpret_cast<const T*>(bytes.data()); }
  template <class T>
  T* As() { return reinterpret_cast<T*>(bytes.data()); }
};

// A picture that is decoded only when it is needed. Implementations are immutable and thread-safe.
class ImageSource {
 public:
  virtual ~ImageSource() = default;
  // The decoded picture. Throws Error (InvalidInput, NotFound, MissingModule).
  virtual Image Decode() const = 0;
  // What a message calls it: a file name, or "image 3 of scene.glb".
  virtual std::string Name() const = 0;
};

// An ImageSource over a picture that is already in memory.
std::shared_ptr<const ImageSource> MakeImageSource(Image image, std::string name);

}  // namespace facet
