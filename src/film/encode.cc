#include <algorithm>
#include <cmath>
#include <string>

#include "base/float_environment.h"
#include "base/number_text.h"
#include "base/pages.h"
#include "base/parallel.h"
#include "facet/error.h"
#include "facet/film.h"
#include "film/encode_pixels.h"
#include "film/hash_film.h"
#include "math/elementary.h"

namespace facet {
namespace {

void CheckRange(double value, double low, double high, const char* what, const char* where) {
  if (value >= low && value <= high) return;
  throw Error(ErrorCode::InvalidUsage,
              std::string(what) + " of " + ShortNumber(value) + " is not in [" + ShortNumber(low) + ", " +
                  ShortNumber(high) + "]",
              where);
}

// The exposure as a factor that neither vanishes nor makes zero light NaN.
float ExposureFactor(const DisplaySettings& settings) {
  double stops = settings.exposure_ev;
  if (!std::isfinite(stops)) throw Error(ErrorCode::InvalidUsage, "the exposure is not a finite number", "exposure");
  if (settings.camera) {
    const CameraExposure& camera = *settings.camera;
    CheckRange(camera.aperture, 0.1, 1000.0, "an aperture", "exposure");
    CheckRange(camera.shutter_seconds, 1e-6, 1e6, "a shutter time", "exposure");
    CheckRange(camera.iso, 1.0, 1e7, "a sensitivity", "exposure");
    stops -= Log2(1.2 * camera.aperture * camera.aperture / camera.shutter_seconds * 100.0 / camera.iso);
  }
  return static_cast<float>(Exp2(std::clamp(stops, -126.0, 126.0)));
}

GradingFactors FactorsOf(const ColorGrading& grading) {
  GradingFactors factors;
  if (grading == ColorGrading()) return factors;
  CheckRange(grading.temperature, -1.0, 1.0, "a temperature", "colour grading");
  CheckRange(grading.tint, -1.0, 1.0, "a tint", "colour grading");
  CheckRange(grading.contrast, 0.0, 2.0, "a contrast", "colour grading");
  CheckRange(grading.saturation, 0.0, 2.0, "a saturation", "colour grading");
  factors.balances_white = grading.temperature != 0.0 || grading.tint != 0.0;
  if (factors.balances_white) SetWhiteBalance(grading.temperature, grading.tint, factors.white_balance);
  factors.contrast = static_cast<float>(grading.contrast);
  factors.saturation = static_cast<float>(grading.saturation);
  const glm::dvec3 one(1.0);
  factors.has_curves = grading.gamma != one || grading.scale != one;
  for (int c = 0; c < 3; ++c) {
    for (const double value : {grading.gamma[c], grading.middle[c], grading.scale[c]}) {
      CheckRange(value, 0.01, 100.0, "a number of a curve", "colour grading");
    }
    factors.gamma[c] = static_cast<float>(grading.gamma[c]);
    factors.middle[c] = static_cast<float>(grading.middle[c]);
    factors.scale[c] = static_cast<float>(grading.scale[c]);
  }
  return factors;
}

float LinearBackground(float encoded, Transfer transfer) {
  if (!(encoded >= 0.0f && encoded <= 1.0f)) {
    throw Error(ErrorCode::InvalidUsage,
                "a component of the background, " + std::to_string(encoded) + ", is not in [0, 1]", "background");
  }
  return transfer == Transfer::Srgb ? SrgbToLinear(encoded) : static_cast<float>(Pow(double{encoded}, 2.2));
}

}  // namespace

EncodeTask MakeEncodeTask(const DisplaySettings& settings, ChannelType type) {
  const FloatEnvironment pinned;
  EncodeTask task;
  task.type = type;
  task.tone_map = settings.tone_map;
  task.transfer = settings.transfer;
  task.grading = FactorsOf(settings.grading);
  task.exposure = ExposureFactor(settings);
  if (settings.background_srgb) {
    task.opaque = true;
    for (int channel = 0; channel < 3; ++channel) {
      task.background_linear[static_cast<std::size_t>(channel)] =
          LinearBackground((*settings.background_srgb)[channel], settings.transfer);
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
