// Images made by integer arithmetic, so that every program makes the same bits.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "facet/image.h"

namespace facet::test {

inline Image Blank(int width, int height, int channels, ChannelType type, Encoding encoding = Encoding::Srgb) {
  Image image;
  image.width = width;
  image.height = height;
  image.channels = channels;
  image.type = type;
  image.encoding = encoding;
  image.bytes.resize(image.PixelCount() * static_cast<std::size_t>(channels) * SizeOf(type));
  return image;
}

// Gradients under a checkerboard; the test has noise on its right half, blue on its lower left quarter and a thin green
// line.
inline Image ByteImage(int width, int height, bool test) {
  Image image = Blank(width, height, 3, ChannelType::U8);
  std::uint8_t* out = image.As<std::uint8_t>();
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x, out += 3) {
      int rgb[3] = {x * 255 / (width - 1), y * 255 / (height - 1), (x / 8 + y / 8) % 2 * 160 + x * y % 61};
      if (test) {
        const int noise = (x * 73 + y * 151 + x * y % 127 * 17) % 41 - 20;
        for (int& value : rgb) value += x > width / 2 ? noise : 0;
        if (y > height / 2 && x < width / 2) rgb[2] += 40;
        if (y >= height / 4 && y < height / 4 + 3) rgb[1] = 255;
      }
      for (int i = 0; i < 3; ++i) out[i] = static_cast<std::uint8_t>(std::clamp(rgb[i], 0, 255));
    }
  }
  return image;
}

// The same as linear light, (code + 1) / 64, in columns of one stop each from -4 to 5; the test has one very bright
// pixel.
inline Image FloatImage(int width, int height, bool test) {
  const Image bytes = ByteImage(width, height, test);
  Image image = Blank(width, height, 3, ChannelType::F32, Encoding::Linear);
  float* out = image.As<float>();
  const std::uint8_t* in = bytes.As<std::uint8_t>();
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const int stops = x * 10 / width - 4;
      for (int i = 0; i < 3; ++i) *out++ = std::ldexp(static_cast<float>(*in++ + 1) / 64.0f, stops);
    }
  }
  if (test) image.As<float>()[(static_cast<std::size_t>(height / 2) * width + width / 3) * 3] = 1000.0f;
  return image;
}

}  // namespace facet::test
