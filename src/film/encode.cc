#include <algorithm>
#include <cmath>
#include <string>

#include "base/float_environment.h"
#include "base/pages.h"
#include "base/parallel.h"
#include "facet/error.h"
#include "facet/film.h"
#include "film/encode_pixels.h"
#include "film/hash_film.h"
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

EncodeTask MakeEncodeTask(const DisplaySettings& settings, ChannelType type) {
  const FloatEnvironment pinned;
  EncodeTask task;
  task.type = type;
  task.tone_map = settings.tone_map;
  task.exposure = ExposureFactor(settings.exposure_ev);
  if (settings.background_srgb) {
    task.opaque = true;
    for (int channel = 0; channel < 3; ++channel) {
      task.background_linear[static_cast<std::size_t>(channel)] =
          LinearBackground((*settings.background_srgb)[channel]);
    }
  }
  if (type == ChannelType::U8) task.tables = &GetSrgbTables();
  if (type == ChannelType::U16) task.thresholds16 = Srgb16Thresholds().data();
  return task;
}

void SizeForTask(const EncodeTask& task, int width, int height, Image& image) {
  image.width = width;
  image.height = height;
  image.channels = task.opaque ? 3 : 4;
  image.type = task.type;
  image.encoding = task.type == ChannelType::F32 ? Encoding::Linear : Encoding::Srgb;
  const std::size_t bytes = image.PixelCount() * task.PixelBytes();
  image.bytes.reserve(bytes);
  PreferHugePages(image.bytes.data(), image.bytes.capacity());
  image.bytes.resize(bytes);
}

Image EncodeFilm(const Film& film, const DisplaySettings& settings, ChannelType type) {
  const FloatEnvironment pinned;
  CheckFilm(film);
  const EncodeTask whole = MakeEncodeTask(settings, type);
  Image image;
  SizeForTask(whole, film.width, film.height, image);
  constexpr std::size_t kPixelsPerTask = 16384;
  ParallelFor(image.PixelCount(), kPixelsPerTask, [&](std::size_t begin, std::size_t end) {
    EncodeTask task = whole;
    task.pixels = &film.pixels[begin].x;
    if (!film.through.empty()) task.through = &film.through[begin].x;
    task.count = end - begin;
    task.out = image.bytes.data() + begin * whole.PixelBytes();
    EncodePixels(task);
  });
  return image;
}

}  // namespace facet
