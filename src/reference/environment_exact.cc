#include "reference/environment_exact.h"

#include <algorithm>
#include <cmath>

#include "base/memory_budget.h"
#include "base/parallel.h"
#include "image/convert.h"
#include "light/environment_source.h"
#include "light/studio.h"
#include "math/elementary.h"

namespace facet {
namespace {

constexpr double kPiDouble = 3.14159265358979324;

double Mix(double a, double b, double t) { return a + (b - a) * t; }

// A sample in [0, 1] whose density is proportional to the linear function from `first` to `last`.
double SampleLinear(double first, double last, double random) {
  const double sum = first + last;
  if (!(sum > 0.0)) return random;
  return std::min(random * sum / (first + std::sqrt(Mix(first * first, last * last, random))), 1.0);
}

// The first entry above `value`, and the position of `value` between the previous entry and this one, in [0, 1].
struct Found {
  int index;
  double fraction;
};
Found FindIn(const double* sums, int count, double value) {
  const int index = std::min(int(std::upper_bound(sums, sums + count, value) - sums), count - 1);
  const double before = index == 0 ? 0.0 : sums[index - 1], share = sums[index] - before;
  return {index, share > 0.0 ? std::clamp((value - before) / share, 0.0, 1.0) : 0.5};
}

}  // namespace

ExactEnvironment::ExactEnvironment(const EnvironmentSettings& settings)
    : cosine_(Cos(settings.rotation)), sine_(Sin(settings.rotation)), intensity_(settings.intensity) {
  const bool is_studio = settings.kind == EnvironmentSettings::Kind::Studio;
  const auto image = is_studio ? nullptr : ImageOf(settings);
  if (!is_studio) CheckImage(*image, "environment");
  const std::size_t pixels = is_studio ? std::size_t(kStudioWidth) * kStudioHeight : image->PixelCount();
  held_ = MemoryLease(pixels, 2 * 3 * sizeof(float) + sizeof(double), "the environment");  // includes a linear copy
  const Image linear = ToLinearRgb32F(is_studio ? StudioImage(kStudioWidth, kStudioHeight) : *image);
  width_ = linear.width;
  height_ = linear.height;
  rgb_.assign(linear.As<float>(), linear.As<float>() + linear.PixelCount() * 3);
  in_band_.resize(std::size_t(width_) * std::size_t(height_ + 1));
  bands_.resize(std::size_t(height_ + 1));
  for (int band = 0; band <= height_; ++band) {
    sine_of_band_.push_back(Sin(kPiDouble * (BandTop(band) + 0.5 * BandHeight(band) + 0.5) / height_));
  }
  ParallelFor(bands_.size(), 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t band = begin; band < end; ++band) {
      double sum = 0.0;
      for (int column = 0; column < width_; ++column) {
        const Patch patch = PatchAt(int(band), column);
        sum += 0.25 * ((patch.Luminance(0) + patch.Luminance(1)) + (patch.Luminance(2) + patch.Luminance(3)));
        in_band_[band * std::size_t(width_) + std::size_t(column)] = sum;
      }
      bands_[band] = sum * BandHeight(int(band)) * sine_of_band_[band];
    }
  });
  for (double& band : bands_) band = total_ += band;
}

double ExactEnvironment::Patch::Luminance(int i) const {
  return (double(corner[i][0]) + double(corner[i][1]) + double(corner[i][2])) / 3.0;
}

ExactEnvironment::Patch ExactEnvironment::PatchAt(int band, int column) const {
  const auto pixel = [&](int row, int x) {
    const std::size_t i = std::size_t(std::clamp(row, 0, height_ - 1)) * std::size_t(width_) + std::size_t(x % width_);
    return rgb_.data() + 3 * i;
  };
  return {{pixel(band - 1, column), pixel(band - 1, column + 1), pixel(band, column), pixel(band, column + 1)}};
}

glm::dvec3 ExactEnvironment::ToWorld(const glm::dvec3& d) const {
  return {cosine_ * d.x + sine_ * d.z, d.y, cosine_ * d.z - sine_ * d.x};
}

// `x` and `y`: position in the patch, in [0, 1]^2. The caller sets the direction.
ExactEnvironment::Light ExactEnvironment::Read(int band, int column, double x, double y, double sine_of_polar) const {
  const Patch patch = PatchAt(band, column);
  Light light;
  for (int c = 0; c < 3; ++c) {
    light.radiance[c] = Mix(Mix(double(patch.corner[0][c]), double(patch.corner[1][c]), x),
                            Mix(double(patch.corner[2][c]), double(patch.corner[3][c]), x), y);
  }
  const double luminance = (light.radiance.x + light.radiance.y + light.radiance.z) / 3.0;
  light.radiance *= intensity_;
  if (IsBlack()) return light;
  const double pixel_angle = 2.0 * kPiDouble * kPiDouble / (double(width_) * double(height_)) * sine_of_polar;
  light.density = luminance * sine_of_band_[std::size_t(band)] / (total_ * std::max(pixel_angle, 1e-300));
  return light;
}

ExactEnvironment::Light ExactEnvironment::Toward(const glm::dvec3& direction) const {
  const glm::dvec3 d(cosine_ * direction.x - sine_ * direction.z, direction.y,
                     sine_ * direction.x + cosine_ * direction.z);
  const double u = 0.5 + Atan2(d.z, d.x) / (2.0 * kPiDouble), v = Acos(std::clamp(d.y, -1.0, 1.0)) / kPiDouble;
  double x = u * width_ - 0.5;
  x = std::clamp(x < 0.0 ? x + width_ : x, 0.0, double(width_));
  const double y = std::clamp(v * height_ - 0.5, -0.5, height_ - 0.5);
  const int band = y < 0.0 ? 0 : std::min(int(y) + 1, height_), column = std::min(int(x), width_ - 1);
  const double sine = std::sqrt(d.x * d.x + d.z * d.z);
  Light light = Read(band, column, x - column, (y - BandTop(band)) / BandHeight(band), sine);
  light.direction = direction;
  return light;
}

ExactEnvironment::Light ExactEnvironment::Sample(const glm::dvec2& random) const {
  const Found band = FindIn(bands_.data(), height_ + 1, random.y * total_);
  const double* sums = in_band_.data() + std::size_t(band.index) * std::size_t(width_);
  const Found column = FindIn(sums, width_, random.x * sums[width_ - 1]);
  const Patch patch = PatchAt(band.index, column.index);
  const double corner[4] = {patch.Luminance(0), patch.Luminance(1), patch.Luminance(2), patch.Luminance(3)};
  const double y = SampleLinear(corner[0] + corner[1], corner[2] + corner[3], band.fraction);
  const double x = SampleLinear(Mix(corner[0], corner[2], y), Mix(corner[1], corner[3], y), column.fraction);
  const double up = Cos(kPiDouble * (BandTop(band.index) + BandHeight(band.index) * y + 0.5) / height_);
  const double turn = (column.index + x + 0.5) / width_ - 0.5;  // the azimuth in full turns
  const double around = std::sqrt(std::max(1.0 - up * up, 0.0)), cosine = Cos(2.0 * kPiDouble * turn);
  const double sine = std::copysign(std::sqrt(std::max(1.0 - cosine * cosine, 0.0)), turn > 0.5 ? -1.0 : turn);
  Light light = Read(band.index, column.index, x, y, around);
  light.direction = ToWorld({around * cosine, up, around * sine});
  return light;
}

}  // namespace facet
