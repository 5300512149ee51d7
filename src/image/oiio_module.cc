// The OpenImageIO module: see oiio_abi.h. The only file that includes OpenImageIO.
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <new>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "facet/image.h"
#include "image/oiio_abi.h"

namespace {

using facet::ChannelType;
using facet::Encoding;
using OIIO::ImageInput;
using OIIO::ImageOutput;
using OIIO::ImageSpec;
using OIIO::TypeDesc;

// Thrown and caught in this file.
struct Failure {
  int result;
  std::string message;
};

TypeDesc TypeOf(ChannelType type) {
  return type == ChannelType::U8 ? TypeDesc::UINT8 : type == ChannelType::U16 ? TypeDesc::UINT16 : TypeDesc::FLOAT;
}

// A file in memory with these bytes, for readers that need a file name; it lives as long as the object.
class MemoryFile {
 public:
  explicit MemoryFile(std::string_view bytes) : descriptor_(::memfd_create("facet image", MFD_CLOEXEC)) {
    while (descriptor_ >= 0 && !bytes.empty()) {
      const ssize_t count = ::write(descriptor_, bytes.data(), bytes.size());
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0) break;
      bytes.remove_prefix(static_cast<std::size_t>(count));
    }
    if (descriptor_ < 0 || !bytes.empty()) {
      if (descriptor_ >= 0) ::close(descriptor_);
      throw Failure{FACET_OIIO_TOO_LARGE, "no memory for the file"};
    }
  }
  ~MemoryFile() { ::close(descriptor_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  std::string path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

 private:
  int descriptor_;
};

// Receives the bytes of a file. OpenImageIO's own class truncates the file behind rewritten bytes, which would break
// TIFF, where the directory is rewritten.
class MemoryOutput final : public OIIO::Filesystem::IOProxy {
 public:
  MemoryOutput() : IOProxy("", Write) {}
  const char* proxytype() const override { return "facet output"; }
  std::size_t size() const override { return bytes_.size(); }
  std::size_t write(const void* from, std::size_t count) override {
    count = pwrite(from, count, m_pos);
    m_pos += static_cast<std::int64_t>(count);
    return count;
  }
  std::size_t pwrite(const void* from, std::size_t count, std::int64_t offset) override {
    if (offset < 0) return 0;
    const auto at = static_cast<std::size_t>(offset);
    bytes_.resize(std::max(bytes_.size(), at + count));
    if (count > 0) std::memcpy(bytes_.data() + at, from, count);  // `from` may be null for 0 bytes
    return count;
  }
  const std::vector<unsigned char>& bytes() const { return bytes_; }

 private:
  std::vector<unsigned char> bytes_;
};

std::string OneLine(std::string text) {
  for (char& c : text) {
    if (c == '\n' || c == '\r') c = ' ';
  }
  while (!text.empty() && (text.back() == ' ' || text.back() == '.')) text.pop_back();
  return text;
}

// The channels of the file that form the image: grey, grey + alpha, RGB or RGBA at the front.
int UsedChannels(const ImageSpec& spec) {
  if (spec.nchannels >= 3) return spec.nchannels >= 4 && spec.alpha_channel == 3 ? 4 : 3;
  return spec.nchannels == 2 && spec.alpha_channel == 1 ? 2 : 1;
}

// Converts associated to straight alpha: colour / alpha. Where alpha is 0 the colour is not changed.
void Unassociate(FacetOiioPicture& picture) {
  const std::size_t pixels = std::size_t(picture.width) * std::size_t(picture.height);
  const std::size_t channels = static_cast<std::size_t>(picture.channels);
  if (picture.type == static_cast<int>(ChannelType::F32)) {
    auto* at = static_cast<float*>(picture.pixels);
    for (std::size_t i = 0; i < pixels; ++i, at += channels) {
      const float alpha = at[channels - 1];
      if (!(alpha > 0.0f) || alpha == 1.0f) continue;
      for (std::size_t c = 0; c + 1 < channels; ++c) at[c] /= alpha;
    }
    return;
  }
  const auto integers = [&](auto* at, unsigned max) {
    for (std::size_t i = 0; i < pixels; ++i, at += channels) {
      const unsigned alpha = at[channels - 1];
      if (alpha == 0 || alpha == max) continue;
      for (std::size_t c = 0; c + 1 < channels; ++c) {
        const unsigned long long straight = (static_cast<unsigned long long>(at[c]) * max + alpha / 2) / alpha;
        at[c] = static_cast<std::remove_pointer_t<decltype(at)>>(std::min<unsigned long long>(straight, max));
      }
    }
  };
  if (picture.type == static_cast<int>(ChannelType::U8)) integers(static_cast<std::uint8_t*>(picture.pixels), 0xFF);
  if (picture.type == static_cast<int>(ChannelType::U16)) integers(static_cast<std::uint16_t*>(picture.pixels), 0xFFFF);
}

void Decode(std::string_view bytes, const std::string& extension, int max_side, std::uint64_t max_pixels,
            std::uint64_t max_bytes, bool as_stored, FacetOiioPicture* picture) {
  ImageSpec config;
  config.attribute("oiio:UnassociatedAlpha", 1);
  auto input = ImageInput::create(extension);
  if (!input) {
    OIIO::geterror();
    throw Failure{FACET_OIIO_UNSUPPORTED, "OpenImageIO was built without a reader for ." + extension};
  }
  OIIO::Filesystem::IOMemReader memory(const_cast<char*>(bytes.data()), bytes.size());
  std::unique_ptr<MemoryFile> file;
  std::string path = "picture." + extension;
  if (input->supports("ioproxy")) {
    input->set_ioproxy(&memory);
  } else {
    file = std::make_unique<MemoryFile>(bytes);
    path = file->path();
  }
  ImageSpec spec;
  if (!input->open(path, spec, config)) {
    throw Failure{FACET_OIIO_INVALID_INPUT, "broken " + extension + " picture: " + OneLine(input->geterror())};
  }
  const auto width = static_cast<std::uint64_t>(spec.width), height = static_cast<std::uint64_t>(spec.height);
  if (spec.width <= 0 || spec.height <= 0 || spec.nchannels <= 0) {
    throw Failure{FACET_OIIO_INVALID_INPUT, "an empty picture"};
  }
  if (spec.width > max_side || spec.height > max_side || width * height > max_pixels) {
    throw Failure{FACET_OIIO_TOO_LARGE, std::to_string(width) + " x " + std::to_string(height) +
                                            " pixels are more than the limit of " + std::to_string(max_side) +
                                            " a side and " + std::to_string(max_pixels) + " in all"};
  }
  if (spec.deep || spec.depth > 1) throw Failure{FACET_OIIO_UNSUPPORTED, "deep and volume pictures are not read"};

  const TypeDesc::BASETYPE base = static_cast<TypeDesc::BASETYPE>(spec.format.basetype);
  const bool floating = base == TypeDesc::HALF || base == TypeDesc::FLOAT || base == TypeDesc::DOUBLE;
  const ChannelType type = floating                                            ? ChannelType::F32
                           : base == TypeDesc::UINT8 || base == TypeDesc::INT8 ? ChannelType::U8
                                                                               : ChannelType::U16;
  const std::string space = spec.get_string_attribute("oiio:ColorSpace");
  const bool linear = space.empty() ? floating : space == "Linear" || space == "linear" || space == "scene_linear";
  picture->width = spec.width;
  picture->height = spec.height;
  picture->channels = UsedChannels(spec);
  picture->type = static_cast<int32_t>(type);
  picture->encoding = static_cast<int32_t>(linear ? Encoding::Linear : Encoding::Srgb);
  picture->size = width * height * static_cast<std::size_t>(picture->channels) * facet::SizeOf(type);
  if (picture->size > max_bytes) {
    throw Failure{FACET_OIIO_TOO_LARGE, std::to_string(width) + " x " + std::to_string(height) + " pixels of " +
                                            std::to_string(picture->size / (width * height)) +
                                            " bytes do not fit into the memory limit"};
  }
  picture->pixels = std::malloc(picture->size);
  if (!picture->pixels) throw std::bad_alloc();
  if (!input->read_image(0, 0, 0, picture->channels, TypeOf(type), picture->pixels)) {
    throw Failure{FACET_OIIO_INVALID_INPUT, "broken " + extension + " picture: " + OneLine(input->geterror())};
  }
  const bool has_alpha = picture->channels == 2 || picture->channels == 4;
  if (has_alpha && !as_stored && spec.get_int_attribute("oiio:UnassociatedAlpha") == 0) Unassociate(*picture);
  input->close();
}

void Encode(const std::string& extension, const FacetOiioPicture& picture, bool premultiplied,
            std::span<const FacetOiioText> text, void** bytes, std::size_t* size) {
  const auto fail = [&](const std::string& why) {
    throw Failure{FACET_OIIO_OUTPUT_FAILED, "the picture could not be written: " + OneLine(why)};
  };
  auto output = ImageOutput::create(extension);
  if (!output) fail(OIIO::geterror());
  // Only writes to memory; facet itself writes the file.
  MemoryOutput memory;
  if (!output->supports("ioproxy") || !output->set_ioproxy(&memory)) fail("this format is not encoded in memory");
  const TypeDesc type = TypeOf(static_cast<ChannelType>(picture.type));
  ImageSpec spec(picture.width, picture.height, picture.channels, type);
  spec.channelnames.clear();
  if (picture.channels <= 2) {
    spec.channelnames = {"Y", "A"};
    spec.channelnames.resize(static_cast<std::size_t>(picture.channels));
  } else {
    spec.channelnames = {"R", "G", "B", "A"};
    spec.channelnames.resize(static_cast<std::size_t>(picture.channels));
  }
  const bool has_alpha = picture.channels == 2 || picture.channels == 4;
  spec.alpha_channel = has_alpha ? picture.channels - 1 : -1;
  if (has_alpha && !premultiplied) spec.attribute("oiio:UnassociatedAlpha", 1);
  // Not for TIFF, where it would become EXIF data, which OpenImageIO 2.4 cannot write to memory. Readers assume sRGB
  // for integers and linear light for floats there, which is right.
  if (!extension.starts_with("tif")) {
    spec.attribute("oiio:ColorSpace", picture.encoding == static_cast<int>(Encoding::Linear) ? "Linear" : "sRGB");
  }
  // OpenImageIO writes the current time to EXR and TIFF, but the file must depend on the image only.
  spec.attribute("DateTime", "1970:01:01 00:00:00");
  for (const FacetOiioText& entry : text) spec.attribute(entry.keyword, entry.value);
  if (!output->open("picture." + extension, spec)) fail(output->geterror());
  if (!output->write_image(type, picture.pixels)) fail(output->geterror());
  if (!output->close()) fail(output->geterror());
  *size = memory.bytes().size();
  *bytes = std::malloc(std::max<std::size_t>(*size, 1));
  if (*bytes == nullptr) throw std::bad_alloc();
  std::memcpy(*bytes, memory.bytes().data(), *size);
}

// Catches all exceptions, as none may leave the module.
template <class Body>
int32_t Guarded(char* message, std::size_t message_size, Body&& body) noexcept {
  const auto say = [&](const char* text) {
    std::strncpy(message, text, message_size - 1);
    message[message_size - 1] = '\0';
  };
  try {
    // Error texts are kept per thread; this discards that of an earlier call.
    OIIO::geterror();
    body();
    return FACET_OIIO_OK;
  } catch (const Failure& failure) {
    say(failure.message.c_str());
    return failure.result;
  } catch (const std::bad_alloc&) {
    say("no memory for the picture");
    return FACET_OIIO_TOO_LARGE;
  } catch (const std::exception& error) {
    say(error.what());
  } catch (...) {
    say("unknown failure in OpenImageIO");
  }
  return FACET_OIIO_INVALID_INPUT;
}

}  // namespace

#define FACET_MODULE_EXPORT extern "C" __attribute__((visibility("default")))

FACET_MODULE_EXPORT int32_t FacetOiioAbiVersion_() { return FACET_OIIO_ABI_VERSION; }

FACET_MODULE_EXPORT int32_t FacetOiioDecode_(const void* bytes, size_t size, const char* extension, int32_t max_side,
                                             uint64_t max_pixels, uint64_t max_bytes, int32_t as_stored,
                                             FacetOiioPicture* picture, char* message, size_t message_size) {
  return Guarded(message, message_size, [&] {
    Decode(std::string_view(static_cast<const char*>(bytes), size), extension, max_side, max_pixels, max_bytes,
           as_stored != 0, picture);
  });
}

FACET_MODULE_EXPORT int32_t FacetOiioEncode_(const char* extension, const FacetOiioPicture* picture,
                                             int32_t premultiplied, const FacetOiioText* text, size_t text_count,
                                             void** bytes, size_t* size, char* message, size_t message_size) {
  return Guarded(message, message_size, [&] {
    Encode(extension, *picture, premultiplied != 0, {text, text_count}, bytes, size);
  });
}

FACET_MODULE_EXPORT void FacetOiioFree_(void* pixels) { std::free(pixels); }
