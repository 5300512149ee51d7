#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include "base/float_environment.h"
#include "base/memory_budget.h"
#include "base/parallel.h"
#include "color/srgb.h"
#include "compare/flip.h"
#include "compare/ssim.h"
#include "compare/tone_light.h"
#include "facet/compare.h"
#include "facet/error.h"
#include "image/convert.h"
#include "math/elementary.h"

namespace facet {
namespace {

constexpr std::size_t kRowsPerTask = 16;

bool HasAlpha(const Image& image) { return image.channels == 2 || image.channels == 4; }

bool AreIntegersOfOneEncoding(const Image& a, const Image& b) {
  return a.type != ChannelType::F32 && b.type != ChannelType::F32 && a.encoding == b.encoding;
}

// One image in the two forms that the measures need.
struct Side {
  Image numbers;  // RGBA components to compare; empty if those are the linear light
  Image light;    // RGBA, linear, F32

  const Image& Compared() const { return numbers.bytes.empty() ? light : numbers; }
};

Side MakeSide(const Image& image, bool linear) {
  Side side;
  if (!linear) side.numbers = WithChannels(image, 4);
  side.light = ToLinearRgba32F(image);
  return side;
}

template <class T>
void CopyRow(const Image& rgba, int y, double scale, std::vector<double>& row) {
  const T* from = rgba.As<T>() + static_cast<std::size_t>(y) * row.size();
  for (std::size_t i = 0; i < row.size(); ++i) row[i] = static_cast<double>(from[i]) / scale;
}

// Reads a row of an RGBA image. Integer codes become fractions, so that equal values of 8 and 16 bits are equal.
void ReadRow(const Image& rgba, int y, std::vector<double>& row) {
  row.resize(static_cast<std::size_t>(rgba.width) * 4);
  if (rgba.type == ChannelType::U8) return CopyRow<std::uint8_t>(rgba, y, 255.0, row);
  if (rgba.type == ChannelType::U16) return CopyRow<std::uint16_t>(rgba, y, 65535.0, row);
  CopyRow<float>(rgba, y, 1.0, row);
}

bool IsFinite(const double* rgba) {
  return std::isfinite(rgba[0]) && std::isfinite(rgba[1]) && std::isfinite(rgba[2]) && std::isfinite(rgba[3]);
}

bool SameBits(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); }

// Per-pixel measures, summed up over one row or the image.
struct Sums {
  double max_difference = -1.0;
  int max_x = 0, max_y = 0;
  std::size_t differing = 0, non_finite_a = 0, non_finite_b = 0;
  double squares = 0.0;

  void Add(const Sums& next) {
    if (next.max_difference > max_difference) {
      max_difference = next.max_difference;
      max_x = next.max_x;
      max_y = next.max_y;
    }
    differing += next.differing;
    non_finite_a += next.non_finite_a;
    non_finite_b += next.non_finite_b;
    squares += next.squares;
  }
};

// The difference of two fractions of ReadRow as if their integer codes were subtracted, so that equal steps of codes
// give equal differences anywhere in the range.
double CodeDifference(double a, double b) { return std::floor(std::abs(a - b) * 65535.0 + 0.5) / 65535.0; }

// `broken`: one flag per pixel of the row, set to 1 if the pixels differ and one of them is not finite.
Sums SumRow(const std::vector<double>& a, const std::vector<double>& b, int y, int channels, bool codes,
            std::uint8_t* broken) {
  Sums sums;
  for (std::size_t x = 0; x < a.size() / 4; ++x) {
    const double *p = &a[x * 4], *q = &b[x * 4];
    const bool finite_a = IsFinite(p), finite_b = IsFinite(q);
    bool differs = false;
    for (int channel = 0; channel < channels; ++channel) {
      if (SameBits(p[channel], q[channel])) continue;
      differs = true;
      double difference = codes ? CodeDifference(p[channel], q[channel]) : std::abs(p[channel] - q[channel]);
      if (!std::isfinite(difference)) difference = std::numeric_limits<double>::infinity();
      sums.squares += difference * difference;
      if (difference > sums.max_difference) {
        sums.max_difference = difference;
        sums.max_x = static_cast<int>(x);
        sums.max_y = y;
      }
    }
    sums.differing += differs;
    sums.non_finite_a += !finite_a;
    sums.non_finite_b += !finite_b;
    broken[x] = differs && !(finite_a && finite_b);
  }
  return sums;
}

Sums SumPixels(const Image& a, const Image& b, int channels, std::vector<std::uint8_t>& broken) {
  std::vector<Sums> rows(static_cast<std::size_t>(a.height));
  ParallelFor(rows.size(), kRowsPerTask, [&](std::size_t begin, std::size_t end) {
    std::vector<double> row_a, row_b;
    for (std::size_t y = begin; y < end; ++y) {
      ReadRow(a, static_cast<int>(y), row_a);
      ReadRow(b, static_cast<int>(y), row_b);
      std::uint8_t* broken_row = broken.data() + y * static_cast<std::size_t>(a.width);
      rows[y] = SumRow(row_a, row_b, static_cast<int>(y), channels, a.type != ChannelType::F32, broken_row);
    }
  });
  Sums all;  // summed row by row, in an order that does not depend on threads
  for (const Sums& row : rows) all.Add(row);
  return all;
}

LumaPlane MakeLuma(const Side& side, double backdrop) {
  const Image& image = side.Compared();
  const bool linear = &image == &side.light;
  LumaPlane luma{image.width, image.height, std::vector<double>(image.PixelCount())};
  ParallelFor(static_cast<std::size_t>(image.height), kRowsPerTask, [&](std::size_t begin, std::size_t end) {
    std::vector<double> row;
    for (std::size_t y = begin; y < end; ++y) {
      ReadRow(image, static_cast<int>(y), row);
      double* out = luma.values.data() + y * static_cast<std::size_t>(image.width);
      for (std::size_t x = 0; x < row.size() / 4; ++x) {
        const double value = Rec709Luma(OverBackdrop(&row[x * 4], backdrop));
        out[x] = linear ? LinearToSrgb(static_cast<float>(std::clamp(value, 0.0, 1.0))) : value;
      }
    }
  });
  return luma;
}

bool IsOpaque(const Image& light) {
  const float* pixels = light.As<float>();
  for (std::size_t i = 0; i < light.PixelCount(); ++i) {
    if (pixels[i * 4 + 3] != 1.0f) return false;
  }
  return true;
}

// Computes SSIM and FLIP over each backdrop and keeps the worse value.
void Judge(const Side& a, const Side& b, double pixels_per_degree, const std::vector<std::uint8_t>& broken,
           ImageDifference& result) {
  std::vector<float> backdrops = {0.0f};
  if (!IsOpaque(a.light) || !IsOpaque(b.light)) backdrops.push_back(1.0f);
  float* errors = result.flip_map.As<float>();
  for (const float backdrop : backdrops) {
    result.ssim = std::min(result.ssim, MeanSsim(MakeLuma(a, backdrop), MakeLuma(b, backdrop), broken));
    FlipSettings settings{pixels_per_degree, backdrop, {}};
    if (result.linear) settings.exposures_ev = FlipExposures(a.light, backdrop);
    const std::vector<float> over = FlipErrors(a.light, b.light, settings);
    for (std::size_t i = 0; i < over.size(); ++i) errors[i] = std::max(errors[i], over[i]);
  }
  double sum = 0.0;
  for (std::size_t i = 0; i < result.flip_map.PixelCount(); ++i) {
    if (!broken.empty() && broken[i] != 0) errors[i] = 1.0f;
    sum += static_cast<double>(errors[i]);
    result.flip_max = std::max(result.flip_max, static_cast<double>(errors[i]));
  }
  result.flip_mean = sum / static_cast<double>(result.flip_map.PixelCount());
}

Image BlankMap(int width, int height) {
  Image map;
  map.width = width;
  map.height = height;
  map.channels = 1;
  map.type = ChannelType::F32;
  map.encoding = Encoding::Linear;
  map.bytes.resize(map.PixelCount() * sizeof(float));
  return map;
}

std::string SizeText(const Image& image) { return std::to_string(image.width) + "x" + std::to_string(image.height); }

}  // namespace

ImageDifference CompareImages(const Image& a, const Image& b, const CompareOptions& options) {
  const FloatEnvironment pinned;
  CheckImage(a, "the first picture");
  CheckImage(b, "the second picture");
  if (!(options.pixels_per_degree >= 1.0 && options.pixels_per_degree <= 1000.0)) {
    throw Error(ErrorCode::InvalidUsage, "the number of pixels per degree is not in 1 to 1000", "pixels per degree");
  }
  if (a.width != b.width || a.height != b.height) {
    throw Error(ErrorCode::InvalidInput, "the pictures have different sizes, " + SizeText(a) + " and " + SizeText(b));
  }
  ImageDifference result;
  result.width = a.width;
  result.height = a.height;
  result.linear = !AreIntegersOfOneEncoding(a, b);
  // The peak memory of the planes of SSIM and FLIP besides the two images, measured at 2048 x 2048.
  constexpr std::uint64_t kBytesPerPixel = 64, kBytesPerLinearPixel = 88;
  MemoryBudget budget(options.memory_limit);
  const MemoryBudget::Scope scope(budget);
  budget.Charge(a.PixelCount(), result.linear ? kBytesPerLinearPixel : kBytesPerPixel,
                "comparing images of " + SizeText(a) + " pixels", {}, "compare them in parts");
  result.flip_map = BlankMap(a.width, a.height);

  const Side side_a = MakeSide(a, result.linear), side_b = MakeSide(b, result.linear);
  const int channels = HasAlpha(a) || HasAlpha(b) ? 4 : 3;
  std::vector<std::uint8_t> broken(a.PixelCount());
  const Sums sums = SumPixels(side_a.Compared(), side_b.Compared(), channels, broken);
  if (std::find(broken.begin(), broken.end(), 1) == broken.end()) broken.clear();

  result.equal = sums.differing == 0;
  result.max_difference = std::max(sums.max_difference, 0.0);
  result.max_x = sums.max_x;
  result.max_y = sums.max_y;
  result.differing_pixels = sums.differing;
  result.non_finite_pixels_a = sums.non_finite_a;
  result.non_finite_pixels_b = sums.non_finite_b;
  const double mse = sums.squares / (static_cast<double>(a.PixelCount()) * channels);
  result.rmse = std::sqrt(mse);
  result.psnr_db = -10.0 * Log2(mse) / Log2(10.0);
  if (!result.equal) Judge(side_a, side_b, options.pixels_per_degree, broken, result);
  return result;
}

}  // namespace facet
