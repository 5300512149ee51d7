#include "image/webp.h"

#include <webp/decode.h>
#include <webp/demux.h>
#include <webp/encode.h>

#include <cstdint>
#include <cstring>
#include <memory>

#include "facet/error.h"
#include "image/limits.h"

namespace facet {
namespace {

const std::uint8_t* Data(std::span<const std::byte> bytes) {
  return reinterpret_cast<const std::uint8_t*>(bytes.data());
}

Error Broken(const std::string& name) { return Error(ErrorCode::InvalidInput, "broken WebP", name); }

void DecodeFirstFrame(std::span<const std::byte> bytes, Image& image, const std::string& name) {
  const WebPData data = {Data(bytes), bytes.size()};
  WebPAnimDecoderOptions options;
  WebPAnimDecoderOptionsInit(&options);  // RGBA, straight
  const std::unique_ptr<WebPAnimDecoder, void (*)(WebPAnimDecoder*)> decoder(WebPAnimDecoderNew(&data, &options),
                                                                             WebPAnimDecoderDelete);
  std::uint8_t* frame = nullptr;
  int time = 0;
  if (decoder == nullptr || WebPAnimDecoderGetNext(decoder.get(), &frame, &time) == 0) throw Broken(name);
  std::memcpy(image.bytes.data(), frame, image.bytes.size());
}

}  // namespace

void ProbeWebP(const FileStart& file, ImageHeader& header) {
  constexpr std::size_t kData = 20;  // of the first chunk
  if (file.Is(12, "VP8 ") && file.Has(kData, 10)) {
    const bool key_frame = (file.Byte(kData) & 1) == 0;
    if (!key_frame || !file.Is(kData + 3, "\x9D\x01\x2A")) return;
    header.width = static_cast<int>(file.Little16(kData + 6) & 0x3FFF);  // above: scaling, which nobody applies
    header.height = static_cast<int>(file.Little16(kData + 8) & 0x3FFF);
    header.channels = 3;
  } else if (file.Is(12, "VP8L") && file.Has(kData, 5)) {
    if (file.Byte(kData) != 0x2F) return;
    const std::uint32_t packed = file.Little32(kData + 1);
    header.width = static_cast<int>(packed & 0x3FFF) + 1;
    header.height = static_cast<int>(packed >> 14 & 0x3FFF) + 1;
    header.channels = (packed >> 28 & 1) != 0 ? 4 : 3;
  } else if (file.Is(12, "VP8X") && file.Has(kData, 10)) {
    header.width = static_cast<int>(file.Little24(kData + 4)) + 1;
    header.height = static_cast<int>(file.Little24(kData + 7)) + 1;
    header.channels = (file.Byte(kData) & 0x10) != 0 ? 4 : 3;
  } else {
    return;
  }
  header.bits = 8;
}

Image DecodeWebP(std::span<const std::byte> bytes, const std::string& name) {
  WebPBitstreamFeatures features;
  if (WebPGetFeatures(Data(bytes), bytes.size(), &features) != VP8_STATUS_OK) throw Broken(name);
  const bool animated = features.has_animation != 0;
  Image image;
  image.width = features.width;
  image.height = features.height;
  image.channels = features.has_alpha != 0 || animated ? 4 : 3;
  image.type = ChannelType::U8;
  image.encoding = Encoding::Srgb;
  CheckImageSize(std::uint64_t(features.width), std::uint64_t(features.height), name);
  // libwebp holds as much again at most; an animation's canvas, twice.
  const std::uint64_t copies = animated ? 4 : 2;
  const MemoryLease lease = LeaseImage(std::uint64_t(image.width), std::uint64_t(image.height),
                                       std::uint64_t(image.height), copies * std::uint64_t(image.channels), name);
  image.bytes = AllocatePixels(image.PixelCount() * std::size_t(image.channels), name);
  if (animated) {
    DecodeFirstFrame(bytes, image, name);
    return image;
  }
  const auto decode = image.channels == 4 ? WebPDecodeRGBAInto : WebPDecodeRGBInto;
  if (decode(Data(bytes), bytes.size(), image.As<std::uint8_t>(), image.bytes.size(), image.width * image.channels) ==
      nullptr) {
    throw Broken(name);
  }
  return image;
}

std::vector<std::byte> EncodeWebP(const Image& image) {
  if (image.width > WEBP_MAX_DIMENSION || image.height > WEBP_MAX_DIMENSION) {
    throw Error(ErrorCode::InvalidUsage, "a WebP file has at most 16383 pixels a side", {},
                "make the picture smaller, or write .png");
  }
  // Measured on a rendered picture of 1024 x 1024, one thread: see docs/performance.md.
  constexpr int kEffort = 1;
  WebPConfig config;
  WebPPicture picture;
  WebPMemoryWriter writer;
  if (WebPConfigInit(&config) == 0 || WebPConfigLosslessPreset(&config, kEffort) == 0 ||
      WebPPictureInit(&picture) == 0) {
    throw Error(ErrorCode::Internal, "libwebp is of another version than it was compiled for");
  }
  config.exact = 1;  // colours under alpha 0 stay
  WebPMemoryWriterInit(&writer);
  picture.use_argb = 1;
  picture.width = image.width;
  picture.height = image.height;
  picture.writer = WebPMemoryWrite;
  picture.custom_ptr = &writer;
  const std::unique_ptr<WebPPicture, void (*)(WebPPicture*)> picture_owner(&picture, WebPPictureFree);
  const std::unique_ptr<WebPMemoryWriter, void (*)(WebPMemoryWriter*)> writer_owner(&writer, WebPMemoryWriterClear);
  const auto import = image.channels == 4 ? WebPPictureImportRGBA : WebPPictureImportRGB;
  if (import(&picture, image.As<std::uint8_t>(), image.width * image.channels) == 0 ||
      WebPEncode(&config, &picture) == 0) {
    throw Error(picture.error_code == VP8_ENC_ERROR_OUT_OF_MEMORY ? ErrorCode::OutOfMemory : ErrorCode::OutputFailed,
                "libwebp could not encode the picture (its error " + std::to_string(picture.error_code) + ")");
  }
  const auto* begin = reinterpret_cast<const std::byte*>(writer.mem);
  return {begin, begin + writer.size};
}

}  // namespace facet
