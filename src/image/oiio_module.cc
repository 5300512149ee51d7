// The OpenImageIO module: see oiio_abi.h. The only file that includes OpenImageIO.
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <dlfcn.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <memory>
#include <new>
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

// OpenImageIO finds a reader by the name's extension; facet by content, so the content chooses the extension.
std::string ExtensionOf(std::string_view bytes, const std::string& name) {
  struct Signature {
    std::size_t at;
    std::string_view text;
    const char* extension;
  };
  using namespace std::string_view_literals;
  static constexpr Signature kSignatures[] = {
      {0, "\x76\x2F\x31\x01"sv, "exr"}, {0, "II*\0"sv, "tif"},         {0, "MM\0*"sv, "tif"},
      {0, "II+\0"sv, "tif"},            {0, "MM\0+"sv, "tif"},         {8, "WEBP"sv, "webp"},
      {0, "\x89PNG"sv, "png"},          {0, "\xFF\xD8\xFF"sv, "jpg"},  {0, "#?R"sv, "hdr"},
      {0, "GIF8"sv, "gif"},             {0, "BM"sv, "bmp"},            {0, "DDS "sv, "dds"},
      {0, "8BPS"sv, "psd"},             {4, "jP  "sv, "jp2"},          {0, "\xFF\x4F\xFF\x51"sv, "j2c"},
      {4, "ftypheic"sv, "heic"},        {4, "ftypmif1"sv, "heic"},     {4, "ftypavif"sv, "avif"},
      {0, "SDPX"sv, "dpx"},             {0, "XPDS"sv, "dpx"},          {0, "\x80\x2A\x5F\xD7"sv, "cin"},
      {0, "\x01\xDA"sv, "sgi"},         {0, "SIMPLE"sv, "fits"},       {0, "P1"sv, "pbm"},
      {0, "P2"sv, "pgm"},               {0, "P3"sv, "ppm"},            {0, "P4"sv, "pbm"},
      {0, "P5"sv, "pgm"},               {0, "P6"sv, "ppm"},            {0, "PF\n"sv, "pfm"},
      {0, "Pf\n"sv, "pfm"},             {0, "\0\0\1\0"sv, "ico"},
  };
  for (const Signature& signature : kSignatures) {
    if (bytes.size() > signature.at && bytes.substr(signature.at).starts_with(signature.text)) {
      return signature.extension;
    }
  }
  // Targa has no signature at its start.
  std::string extension = std::filesystem::path(name).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  if (extension == ".tga") return "tga";
  throw Failure{FACET_OIIO_INVALID_INPUT, "the picture's format is not known"};
}

// A file with these bytes for the readers that cannot read from memory; gone with the object.
class TemporaryFile {
 public:
  TemporaryFile(std::string_view bytes, const std::string& extension) {
    path_ = (std::filesystem::temp_directory_path() / "facet-XXXXXX").string() + "." + extension;
    const int file = ::mkstemps(path_.data(), static_cast<int>(extension.size()) + 1);
    if (file < 0) throw Failure{FACET_OIIO_INVALID_INPUT, "no temporary file could be made for decoding"};
    bool whole = true;
    while (whole && !bytes.empty()) {
      const ssize_t count = ::write(file, bytes.data(), bytes.size());
      whole = count > 0;
      if (whole) bytes.remove_prefix(static_cast<std::size_t>(count));
    }
    ::close(file);
    if (!whole) {
      ::unlink(path_.c_str());
      throw Failure{FACET_OIIO_INVALID_INPUT, "no room for a temporary file for decoding"};
    }
  }
  ~TemporaryFile() { ::unlink(path_.c_str()); }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

std::string OneLine(std::string text) {
  for (char& c : text) {
    if (c == '\n' || c == '\r') c = ' ';
  }
  while (!text.empty() && (text.back() == ' ' || text.back() == '.')) text.pop_back();
  return text;
}

// Which of the file's channels make the picture: grey, grey + alpha, RGB or RGBA at the front.
int UsedChannels(const ImageSpec& spec) {
  if (spec.nchannels >= 3) return spec.nchannels >= 4 && spec.alpha_channel == 3 ? 4 : 3;
  return spec.nchannels == 2 && spec.alpha_channel == 1 ? 2 : 1;
}

// Straight alpha where the reader gave associated: colour / alpha; where alpha is 0 the colour stays.
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

// OpenImageIO 2.4 multiplies WebP's colours by alpha in 8 bits whatever it is asked for, and what lay under alpha 0 is
// lost; glTF ignores alpha in most places, so the colours matter. libwebp, which OpenImageIO has loaded already, gives
// them as they are. False when it cannot (an animation, another version): OpenImageIO reads the picture then.
bool DecodeStraightWebP(std::string_view bytes, const FacetOiioPicture& picture) {
  using DecodeInto = std::uint8_t* (*)(const std::uint8_t*, std::size_t, std::uint8_t*, std::size_t, int);
  void* library = ::dlopen("libwebp.so.7", RTLD_NOW | RTLD_NOLOAD);
  if (!library) return false;
  const auto decode = reinterpret_cast<DecodeInto>(::dlsym(library, "WebPDecodeRGBAInto"));
  const bool done = decode && decode(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size(),
                                     static_cast<std::uint8_t*>(picture.pixels), picture.size, picture.width * 4);
  ::dlclose(library);  // its count of users, not the library
  return done;
}

void Decode(std::string_view bytes, const std::string& name, int max_side, std::uint64_t max_pixels,
            FacetOiioPicture* picture) {
  const std::string extension = ExtensionOf(bytes, name);
  ImageSpec config;
  config.attribute("oiio:UnassociatedAlpha", 1);
  auto input = ImageInput::create(extension);
  if (!input) {
    OIIO::geterror();
    throw Failure{FACET_OIIO_UNSUPPORTED, "OpenImageIO was built without a reader for ." + extension};
  }
  OIIO::Filesystem::IOMemReader memory(const_cast<char*>(bytes.data()), bytes.size());
  std::unique_ptr<TemporaryFile> file;
  std::string path = "picture." + extension;
  if (input->supports("ioproxy")) {
    input->set_ioproxy(&memory);
  } else {
    file = std::make_unique<TemporaryFile>(bytes, extension);
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
  picture->pixels = std::malloc(picture->size);
  if (!picture->pixels) throw std::bad_alloc();
  if (extension == "webp" && picture->channels == 4 && DecodeStraightWebP(bytes, *picture)) return;
  if (!input->read_image(0, 0, 0, picture->channels, TypeOf(type), picture->pixels)) {
    throw Failure{FACET_OIIO_INVALID_INPUT, "broken " + extension + " picture: " + OneLine(input->geterror())};
  }
  const bool has_alpha = picture->channels == 2 || picture->channels == 4;
  if (has_alpha && spec.get_int_attribute("oiio:UnassociatedAlpha") == 0) Unassociate(*picture);
  input->close();
}

void Encode(const std::string& path, const FacetOiioPicture& picture, bool premultiplied) {
  const auto fail = [&](const std::string& why) {
    throw Failure{FACET_OIIO_OUTPUT_FAILED, "the picture could not be written: " + OneLine(why)};
  };
  auto output = ImageOutput::create(path);
  if (!output) fail(OIIO::geterror());
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
  spec.attribute("oiio:ColorSpace", picture.encoding == static_cast<int>(Encoding::Linear) ? "Linear" : "sRGB");
  const std::string extension = std::filesystem::path(path).extension().string();
  // OpenImageIO stamps EXR and TIFF with the present time; the file is to be a function of the picture alone.
  spec.attribute("DateTime", "1970:01:01 00:00:00");
  if (extension == ".jpg" || extension == ".jpeg") spec.attribute("Compression", "jpeg:95");
  if (!output->open(path, spec)) fail(output->geterror());
  if (!output->write_image(type, picture.pixels)) fail(output->geterror());
  if (!output->close()) fail(output->geterror());
}

// No exception leaves the module.
template <class Body>
int32_t Guarded(char* message, std::size_t message_size, Body&& body) noexcept {
  const auto say = [&](const char* text) {
    std::strncpy(message, text, message_size - 1);
    message[message_size - 1] = '\0';
  };
  try {
    // Error texts are kept per thread; one of an earlier call shall not show up in this one.
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

FACET_MODULE_EXPORT int32_t FacetOiioDecode_(const void* bytes, size_t size, const char* name, int32_t max_side,
                                             uint64_t max_pixels, FacetOiioPicture* picture, char* message,
                                             size_t message_size) {
  return Guarded(message, message_size, [&] {
    Decode(std::string_view(static_cast<const char*>(bytes), size), name, max_side, max_pixels, picture);
  });
}

FACET_MODULE_EXPORT int32_t FacetOiioEncode_(const char* path, const FacetOiioPicture* picture, int32_t premultiplied,
                                             char* message, size_t message_size) {
  return Guarded(message, message_size, [&] { Encode(path, *picture, premultiplied != 0); });
}

FACET_MODULE_EXPORT void FacetOiioFree_(void* pixels) { std::free(pixels); }
