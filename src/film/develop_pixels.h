// The kernel of Develop: pixels of a film, or of a tile, to those of a picture.
#pragma once

#include <array>
#include <cstddef>

#include "color/srgb.h"
#include "facet/film.h"

namespace facet {

struct DevelopTask {
  const float* pixels = nullptr;  // 4 numbers each: linear, premultiplied
  std::size_t count = 0;          // pixels of a row
  std::size_t rows = 1, pixel_stride = 0, out_stride = 0;  // pixels from one row to the next
  std::byte* out = nullptr;  // 4 numbers of `type` each, or 3 when `opaque`
  ChannelType type = ChannelType::U8;
  ToneMap tone_map = ToneMap::None;
  float exposure = 1.0f;  // a factor, finite, positive
  bool opaque = false;
  std::array<float, 3> background_linear{};  // for `opaque`
  const SrgbTables* tables = nullptr;
  const float* thresholds16 = nullptr;  // Srgb16Thresholds(), for U16

  std::size_t PixelBytes() const { return SizeOf(type) * (opaque ? 3 : 4); }
};

void DevelopPixels(const DevelopTask& task);

// A task without pixels. Throws Error(InvalidUsage) for settings that Develop() refuses.
DevelopTask MakeDevelopTask(const DisplaySettings& settings, ChannelType type);

// Makes `image` one of tasks' pixels, of this size; they are not set. Its memory is used again.
void SizeForTask(const DevelopTask& task, int width, int height, Image& image);

}  // namespace facet
