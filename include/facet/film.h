// The linear picture that rendering makes, with the planes that it may have besides, and its way to the display.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "facet/digest.h"
#include "facet/image.h"
#include "facet/planes.h"

namespace facet {

// Linear light, Rec. 709, premultiplied by coverage alpha; height rows of width pixels, top row first.
struct Film {
  int width = 0;
  int height = 0;
  std::vector<glm::vec4> pixels;
  std::vector<Plane> planes = {};  // those of RenderSettings::planes, in its order
};

// Of the line "facet film WIDTH HEIGHT\n" and the pixels: R, G, B, A as little-endian IEEE 754 floats, top row first.
// Colour alone: planes besides it do not change it.
Digest HashFilm(const Film& film);

// Of the line "facet plane NAME WIDTH HEIGHT CHANNELS TYPE\n", TYPE being f32 or u32, and the bytes of
// film.planes[plane].
Digest HashPlane(const Film& film, std::size_t plane);

enum class ToneMap : std::uint8_t { None, Reinhard, Aces, AgX, Neutral };

struct DisplaySettings {
  double exposure_ev = 0.0;  // light is multiplied by 2^exposure_ev
  ToneMap tone_map = ToneMap::Neutral;
  // Shown behind the picture, sRGB in [0, 1] as it shall stand in the file; none: stays transparent.
  std::optional<glm::vec3> background_srgb;
};

// Exposure, tone curve, background and sRGB encoding. `type` U8 or U16 gives an sRGB picture, F32 a linear one that is
// exposed but not tone-mapped (the display's background, when given, is put behind it in linear light).
// 4 channels, straight alpha; 3 channels when a background makes every pixel opaque.
Image Develop(const Film& film, const DisplaySettings& settings, ChannelType type = ChannelType::U8);

}  // namespace facet
