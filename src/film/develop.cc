#include <algorithm>
#include <cmath>
#include <string>

#include "base/float_environment.h"
#include "base/check.h"
#include "base/pages.h"
#include "base/parallel.h"
#include "facet/error.h"
#include "facet/film.h"
#include "film/develop_pixels.h"
#include "math/elementary.h"

namespace facet {
namespace {

// 2^exposure_ev as a factor that neither vanishes nor makes zero light NaN.
float ExposureFactor(double exposure_ev) {
  if (!std::isfinite(exposure_ev)) {
    throw Error(ErrorCode::InvalidUsage, "the exposure is not a finite number", "exposure");
  }
  return static_cast<float>(Exp2(std::clamp(exposure_ev, -126.0, 126.0)));
}

float LinearBackground(float encoded) {
  if (!(encoded >= 0.0f && encoded <= 1.0f)) {
    throw Error(ErrorCode::InvalidUsage,
                "a component of the background, " + std::to_string(encoded) + ", is not in [0, 1]", "background");
  }
  return SrgbToLinear(encoded);
}

}  // namespace

Image Develop(const Film& film, const DisplaySettings& settings, ChannelType type) {
  const FloatEnvironment pinned;
  FACET_CHECK_OP(film.width, >=, 0);
  FACET_CHECK_OP(film.height, >=, 0);
  Image image;
  image.width = film.width;
  image.height = film.height;
  image.channels = settings.background_srgb ? 3 : 4;
  image.type = type;
  image.encoding = type == ChannelType::F32 ? Encoding::Linear : Encoding::Srgb;
  FACET_CHECK_OP(film.pixels.size(), ==, image.PixelCount());

  DevelopTask whole;
  whole.type = type;
  whole.tone_map = settings.tone_map;
  whole.exposure = ExposureFactor(settings.exposure_ev);
  if (settings.background_srgb) {
    whole.opaque = true;
    for (int channel = 0; channel < 3; ++channel) {
      whole.background_linear[static_cast<std::size_t>(channel)] =
          LinearBackground((*settings.background_srgb)[channel]);
    }
  }
  if (type == ChannelType::U8) whole.tables = &GetSrgbTables();
  if (type == ChannelType::U16) whole.thresholds16 = Srgb16Thresholds().data();

  const std::size_t pixel_size = static_cast<std::size_t>(image.channels) * SizeOf(type);
  image.bytes.reserve(image.PixelCount() * pixel_size);
  PreferHugePages(image.bytes.data(), image.bytes.capacity());
  image.bytes.resize(image.PixelCount() * pixel_size);
  constexpr std::size_t kPixelsPerTask = 16384;
  ParallelFor(image.PixelCount(), kPixelsPerTask, [&](std::size_t begin, std::size_t end) {
    DevelopTask task = whole;
    task.pixels = &film.pixels[begin].x;
    task.count = end - begin;
    task.out = image.bytes.data() + begin * pixel_size;
    DevelopPixels(task);
  });
  return image;
}

}  // namespace facet
