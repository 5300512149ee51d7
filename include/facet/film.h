// The film, which is the linear image that rendering produces, with the planes that it may have besides colour, and its
// tone mapping and encoding for display.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string_view>
#include <vector>

#include "facet/digest.h"
#include "facet/image.h"
#include "facet/planes.h"

namespace facet {

// Linear light, Rec. 709, premultiplied by alpha (coverage); height rows of width pixels, top row first.
struct Film {
  int width = 0;
  int height = 0;
  std::vector<glm::vec4> pixels;
  std::vector<Plane> planes = {};  // those of RenderSettings::planes, in its order
  // The share of what is behind the picture that each channel shows, where that is not 1 - alpha for all three: of
  // frames with coloured glass before a transparent background. Empty, or one for each pixel.
  std::vector<glm::vec3> through = {};
};

// The digest of the line "facet film WIDTH HEIGHT\n" followed by the pixels: R, G, B, A as little-endian IEEE 754
// floats, top row first. Planes do not change it, nor does what shows through.
Digest HashFilm(const Film& film);

// The digest of the line "facet plane NAME WIDTH HEIGHT CHANNELS TYPE\n", TYPE being f32 or u32, and the bytes of
// film.planes[plane].
Digest HashPlane(const Film& film, std::size_t plane);

enum class ToneMap : std::uint8_t { None, Reinhard, Aces, AgX, Neutral, Filmic, Generic, Gt7, AgXGolden, AgXPunchy };

// The words for tone maps, in their order.
inline constexpr auto kToneMapWords = std::to_array<std::string_view>(
    {"none", "reinhard", "aces", "agx", "neutral", "filmic", "generic", "gt7", "agx-golden", "agx-punchy"});

// How a picture's light becomes codes: by sRGB's curve, or by a power of 1 / 2.2, as lectures write it.
enum class Transfer : std::uint8_t { Srgb, Gamma };

// A camera's exposure: with it, light of 1.2 * 2^EV100 is 1 in the picture, EV100 = log2(aperture^2 / shutter * 100 /
// sensitivity) (Lagarde and de Rousiers, 2014, Moving Frostbite to Physically Based Rendering, section 5.1.1). For
// lights in their own units: lux and candela.
struct CameraExposure {
  double aperture = 16.0;              // f-number, 0.1 to 1000
  double shutter_seconds = 1 / 125.0;  // 1e-6 to 1e6
  double iso = 100.0;                  // 1 to 1e7
};

// Changes to exposed light before the tone curve, in this order. The defaults change nothing.
struct ColorGrading {
  double temperature = 0.0, tint = 0.0;  // white balance, -1 to 1: from blue to yellow, from green to magenta
  double contrast = 1.0;                 // 0 to 2: the exponent around middle grey
  double saturation = 1.0;               // 0 to 2
  // Curves, by channel: below `middle` a power with the middle fixed, above it a line of slope `scale`.
  glm::dvec3 gamma{1.0}, middle{1.0}, scale{1.0};  // 0.01 to 100 each

  bool operator==(const ColorGrading&) const = default;
};

struct DisplaySettings {
  double exposure_ev = 0.0;  // light is multiplied by 2^exposure_ev
  std::optional<CameraExposure> camera;  // and by this exposure; none: 1
  ToneMap tone_map = ToneMap::Neutral;
  ColorGrading grading;
  Transfer transfer = Transfer::Srgb;  // of U8 and U16
  // A colour to composite the image over, in sRGB, [0, 1], exactly as it shall be in the output; none: the image stays
  // transparent.
  std::optional<glm::vec3> background_srgb;
};

// Applies exposure, tone curve, background and sRGB encoding. With `type` U8 or U16 the image is sRGB; with F32 it is
// linear, exposed but not tone-mapped, and composited over the background, if there is one, in linear light. The image
// has 4 channels with straight alpha, or 3 if a background makes every pixel opaque. A background shows through
// coloured glass by channel; alpha, of images without one, has only the mean.
Image EncodeFilm(const Film& film, const DisplaySettings& settings, ChannelType type = ChannelType::U8);

}  // namespace facet
