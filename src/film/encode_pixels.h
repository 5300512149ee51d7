// The kernel of EncodeFilm: tone-maps and encodes pixels of a film, or of a tile.
#pragma once

#include <array>
#include <cstddef>

#include "color/grading.h"
#include "color/srgb.h"
#include "facet/film.h"

namespace facet {

struct EncodeTask {
  const float* pixels = nullptr;   // 4 components each: linear, premultiplied
  const float* through = nullptr;  // 3 each, in rows as the pixels are: Film::through; null: 1 - alpha
  std::size_t count = 0;          // pixels in a row
  std::size_t rows = 1, pixel_stride = 0, out_stride = 0;  // pixels from one row to the next
  std::byte* out = nullptr;  // 4 components of `type` each, or 3 if `opaque`
  ChannelType type = ChannelType::U8;
  ToneMap tone_map = ToneMap::None;
  GradingFactors grading;
  Transfer transfer = Transfer::Srgb;
  float exposure = 1.0f;  // a factor, finite, positive
  bool opaque = false;
  std::array<float, 3> background_linear{};  // for `opaque`
  const SrgbTables* tables = nullptr;
  const float* thresholds16 = nullptr;  // Srgb16Thresholds(), for U16

  std::size_t PixelBytes() const { return SizeOf(type) * (opaque ? 3 : 4); }
};

void EncodePixels(const EncodeTask& task);

// A task without pixels. Throws Error(InvalidUsage) for settings that EncodeFilm() refuses.
EncodeTask MakeEncodeTask(const DisplaySettings& settings, ChannelType type);

// Gives `image` this size and the format of the task, reusing its memory. The pixels are not set.
void SizeForTask(const EncodeTask& task, int width, int height, Image& image);

}  // namespace facet
