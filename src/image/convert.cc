#include "image/convert.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "base/pages.h"
#include "color/srgb.h"
#include "facet/error.h"

namespace facet {
namespace {

bool HasAlpha(const Image& image) { return image.channels == 2 || image.channels == 4; }

// The linear light of all 65536 codes of 16 bits.
const std::vector<float>& Srgb16ToLinearTable() {
  static const std::vector<float> table = [] {
    std::vector<float> entries(65536);
    for (std::size_t i = 0; i < entries.size(); ++i) entries[i] = SrgbToLinear(static_cast<float>(i) / 65535.0f);
    return entries;
  }();
  return table;
}

std::size_t Channels(const Image& image) { return static_cast<std::size_t>(image.channels); }

Image Blank(const Image& like, int channels, ChannelType type) {
  Image out;
  out.width = like.width;
  out.height = like.height;
  out.channels = channels;
  out.type = type;
  out.encoding = like.encoding;
  const std::size_t bytes = out.PixelCount() * Channels(out) * SizeOf(type);
  out.bytes.reserve(bytes);
  PreferHugePages(out.bytes.data(), bytes);
  out.bytes.resize(bytes);
  return out;
}

// Writes the linear value of every component of the image.
template <class T, class Colour, class Alpha>
void ForEachNumber(const Image& image, Colour&& colour, Alpha&& alpha, float* out) {
  const T* from = image.As<T>();
  const std::size_t channels = Channels(image), colours = HasAlpha(image) ? channels - 1 : channels;
  for (std::size_t i = 0; i < image.PixelCount(); ++i, from += channels, out += channels) {
    for (std::size_t c = 0; c < colours; ++c) out[c] = colour(from[c]);
    if (colours < channels) out[colours] = alpha(from[colours]);
  }
}

std::uint8_t ToByte(std::uint16_t value) { return static_cast<std::uint8_t>((value * 255u + 32767u) / 65535u); }

// Maps [0, 1] to [0, max], rounded to nearest; NaN to 0.
float Quantised(float value, float max) {
  const float unit = value > 0.0f ? (value < 1.0f ? value : 1.0f) : 0.0f;
  return std::floor(unit * max + 0.5f);
}

template <class T>
void SpreadChannels(const Image& from, Image& to, T opaque) {
  const std::size_t have = Channels(from), want = Channels(to);
  const std::size_t have_colours = HasAlpha(from) ? have - 1 : have, want_colours = HasAlpha(to) ? want - 1 : want;
  const T* in = from.As<T>();
  T* out = to.As<T>();
  for (std::size_t i = 0; i < from.PixelCount(); ++i, in += have, out += want) {
    for (std::size_t c = 0; c < want_colours; ++c) out[c] = in[have_colours == 1 ? 0 : c];
    if (want_colours < want) out[want_colours] = have_colours < have ? in[have_colours] : opaque;
  }
}

}  // namespace

void CheckImage(const Image& image, const char* name) {
  const auto fail = [&](const std::string& why) { throw Error(ErrorCode::InvalidUsage, why, name); };
  if (image.width <= 0 || image.height <= 0) fail("the picture is empty");
  if (image.channels < 1 || image.channels > 4) {
    fail("a picture has 1 to 4 channels, not " + std::to_string(image.channels));
  }
  const std::size_t expected = image.PixelCount() * Channels(image) * SizeOf(image.type);
  if (image.bytes.size() != expected) {
    fail("the picture has " + std::to_string(image.bytes.size()) + " bytes where its size says " +
         std::to_string(expected));
  }
}

Image ToLinear32F(const Image& image) {
  CheckImage(image, "picture to convert");
  Image out = Blank(image, image.channels, ChannelType::F32);
  out.encoding = Encoding::Linear;
  const bool srgb = image.encoding == Encoding::Srgb;
  float* to = out.As<float>();
  switch (image.type) {
    case ChannelType::U8: {
      const auto plain = [](std::uint8_t v) { return static_cast<float>(v) / 255.0f; };
      if (srgb) {
        const auto& table = Srgb8ToLinearTable();
        ForEachNumber<std::uint8_t>(image, [&](std::uint8_t v) { return table[v]; }, plain, to);
      } else {
        ForEachNumber<std::uint8_t>(image, plain, plain, to);
      }
      break;
    }
    case ChannelType::U16: {
      const auto plain = [](std::uint16_t v) { return static_cast<float>(v) / 65535.0f; };
      if (srgb) {
        const auto& table = Srgb16ToLinearTable();
        ForEachNumber<std::uint16_t>(image, [&](std::uint16_t v) { return table[v]; }, plain, to);
      } else {
        ForEachNumber<std::uint16_t>(image, plain, plain, to);
      }
      break;
    }
    case ChannelType::F32: {
      const auto plain = [](float v) { return v; };
      if (srgb) {
        ForEachNumber<float>(image, [](float v) { return SrgbToLinear(v); }, plain, to);
      } else {
        ForEachNumber<float>(image, plain, plain, to);
      }
      break;
    }
  }
  return out;
}

Image ToLinearRgba32F(const Image& image) { return WithChannels(ToLinear32F(image), 4); }

Image ToLinearRgb32F(const Image& image, std::size_t* repaired) {
  Image out = WithChannels(ToLinear32F(image), 3);
  std::size_t count = 0;
  float* at = out.As<float>();
  for (std::size_t i = 0; i < out.PixelCount() * 3; ++i) {
    if (at[i] >= 0.0f && at[i] <= kMaxRadiance) continue;
    // An infinity is broken data, not a bright light.
    at[i] = std::isfinite(at[i]) && at[i] > 0.0f ? kMaxRadiance : 0.0f;
    ++count;
  }
  if (repaired) *repaired = count;
  return out;
}

Image WithType(const Image& image, ChannelType type) {
  CheckImage(image, "picture to convert");
  if (image.type == type) return image;
  if (type == ChannelType::F32) throw Error(ErrorCode::InvalidUsage, "WithType makes integers; see ToLinear32F");
  Image out = Blank(image, image.channels, type);
  const std::size_t count = image.PixelCount() * Channels(image);
  for (std::size_t i = 0; i < count; ++i) {
    if (image.type == ChannelType::U8) {
      out.As<std::uint16_t>()[i] = static_cast<std::uint16_t>(image.As<std::uint8_t>()[i] * 257u);
    } else if (image.type == ChannelType::U16) {
      out.As<std::uint8_t>()[i] = ToByte(image.As<std::uint16_t>()[i]);
    } else if (type == ChannelType::U8) {
      out.As<std::uint8_t>()[i] = static_cast<std::uint8_t>(Quantised(image.As<float>()[i], 255.0f));
    } else {
      out.As<std::uint16_t>()[i] = static_cast<std::uint16_t>(Quantised(image.As<float>()[i], 65535.0f));
    }
  }
  return out;
}

Image WithChannels(const Image& image, int channels) {
  CheckImage(image, "picture to convert");
  if (image.channels == channels) return image;
  if (channels < 1 || channels > 4 || (image.channels >= 3 && channels < 3)) {
    throw Error(ErrorCode::InvalidUsage, "cannot turn " + std::to_string(image.channels) + " channels into " +
                                             std::to_string(channels));
  }
  Image out = Blank(image, channels, image.type);
  switch (image.type) {
    case ChannelType::U8:
      SpreadChannels<std::uint8_t>(image, out, 0xFF);
      break;
    case ChannelType::U16:
      SpreadChannels<std::uint16_t>(image, out, 0xFFFF);
      break;
    case ChannelType::F32:
      SpreadChannels<float>(image, out, 1.0f);
      break;
  }
  return out;
}

}  // namespace facet
