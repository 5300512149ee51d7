#include "compare/flip.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <numbers>

#include "base/parallel.h"
#include "compare/tone_light.h"
#include "math/elementary.h"

namespace facet {
namespace {

// ---- Colour --------------------------------------------------------------------------------------------------------

using Triple = std::array<double, 3>;
using Matrix = std::array<Triple, 3>;

constexpr Triple operator*(const Matrix& m, const Triple& v) {
  Triple result{};
  for (std::size_t row = 0; row < 3; ++row) result[row] = m[row][0] * v[0] + m[row][1] * v[1] + m[row][2] * v[2];
  return result;
}

// Converts linear Rec. 709 light to X, Y, Z relative to white (D65): the rows of the matrix of the sRGB primaries, each
// scaled to the sum 1.
constexpr Matrix WhiteRelativeFromRgb() {
  Matrix m = {{{10135552.0 / 24577794.0, 8788810.0 / 24577794.0, 4435075.0 / 24577794.0},
               {2613072.0 / 12288897.0, 8788810.0 / 12288897.0, 887015.0 / 12288897.0},
               {1425312.0 / 73733382.0, 8788810.0 / 73733382.0, 70074185.0 / 73733382.0}}};
  for (Triple& row : m) {
    const double white = row[0] + row[1] + row[2];
    for (double& value : row) value /= white;
  }
  return m;
}

constexpr Matrix Inverse(const Matrix& m) {
  Matrix cofactors{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      const std::size_t i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      cofactors[i][j] = m[i1][j1] * m[i2][j2] - m[i1][j2] * m[i2][j1];
    }
  }
  const double determinant = m[0][0] * cofactors[0][0] + m[0][1] * cofactors[0][1] + m[0][2] * cofactors[0][2];
  Matrix inverse{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) inverse[i][j] = cofactors[j][i] / determinant;
  }
  return inverse;
}

constexpr Matrix kXyzFromRgb = WhiteRelativeFromRgb();
constexpr Matrix kRgbFromXyz = Inverse(kXyzFromRgb);

// The cube root of a normal number with a relative error of 1e-14: two Halley steps from an estimate that divides the
// exponent by 3 in the bits (W. Kahan, 1991, "Computing a Real Cube Root"). Each pixel needs six cube roots, and
// facet's own Cbrt, which is accurate to the last bit, takes ten times as long.
double CubeRoot(double x) {
  double root = std::bit_cast<double>(std::bit_cast<std::uint64_t>(x) / 3 + (std::uint64_t(0x2A9F7893) << 32));
  for (int step = 0; step < 2; ++step) {
    const double cube = root * root * root;
    root *= (cube + 2.0 * x) / (2.0 * cube + x);
  }
  return root;
}

// CIELAB of linear RGB, with chroma scaled by lightness to account for the Hunt effect: section 4.1.2.
Triple HuntLab(const Triple& rgb) {
  constexpr double kDelta = 6.0 / 29.0;
  Triple f = kXyzFromRgb * rgb;
  for (double& x : f) x = x > kDelta * kDelta * kDelta ? CubeRoot(x) : x / (3.0 * kDelta * kDelta) + 4.0 / 29.0;
  const double lightness = 116.0 * f[1] - 16.0;
  return {lightness, 0.01 * lightness * 500.0 * (f[0] - f[1]), 0.01 * lightness * 200.0 * (f[1] - f[2])};
}

// HyAB distance: city block in lightness, Euclidean in chroma (I. Abasi and others, 2020, "Distance Metrics for Very
// Large Color Differences").
double HyAb(const Triple& p, const Triple& q) {
  const double a = p[1] - q[1], b = p[2] - q[2];
  return std::abs(p[0] - q[0]) + std::sqrt(a * a + b * b);
}

// ---- Filters -------------------------------------------------------------------------------------------------------

struct Kernel {
  std::vector<double> weights;  // 2 * radius + 1
  int radius() const { return static_cast<int>(weights.size() / 2); }
};

Kernel MakeKernel(int radius, auto&& weight) {
  Kernel kernel;
  for (int i = -radius; i <= radius; ++i) kernel.weights.push_back(weight(static_cast<double>(i)));
  return kernel;
}

// Scales the weights so that the positive ones add up to `sum`, and the negative ones to -`sum`.
Kernel Normalised(Kernel kernel, double sum = 1.0) {
  double positive = 0.0, negative = 0.0;
  for (const double w : kernel.weights) (w > 0.0 ? positive : negative) += w;
  for (double& w : kernel.weights) w *= w > 0.0 ? sum / positive : -sum / negative;
  return kernel;
}

// The eye's contrast sensitivity as Gaussians, table 1: a1 = 1, b1 = 0.0047 for lightness, 0.0053 for red-green, and a
// sum of two Gaussians for blue-yellow, each of which is separable.
struct Filters {
  Kernel lightness, red_green, blue_yellow1, blue_yellow2;  // along x, and along y except:
  Kernel blue_yellow1_y, blue_yellow2_y;                    // scaled by their weights in the sum
  Kernel gauss, edge, point;                                // section 4.2: derivatives of one Gaussian
  int radius = 0;                                           // the largest of all kernels

  explicit Filters(double pixels_per_degree) {
    constexpr double kPiSquared = std::numbers::pi * std::numbers::pi;
    constexpr double kLargestB = 0.04;
    const int eye = static_cast<int>(std::ceil(3.0 * std::sqrt(kLargestB / (2.0 * kPiSquared)) * pixels_per_degree));
    const auto sensitivity = [&](double b) {
      return MakeKernel(eye, [&](double i) {
        const double degrees = i / pixels_per_degree;
        return Exp(-kPiSquared * degrees * degrees / b);
      });
    };
    lightness = Normalised(sensitivity(0.0047));
    red_green = Normalised(sensitivity(0.0053));
    const auto volume = [](double a, double b, const Kernel& kernel) {
      double sum = 0.0;
      for (const double w : kernel.weights) sum += w;
      return a * std::sqrt(std::numbers::pi / b) * sum * sum;
    };
    const Kernel wide = sensitivity(0.04), narrow = sensitivity(0.025);
    const double share1 = volume(34.1, 0.04, wide), share2 = volume(13.5, 0.025, narrow);
    blue_yellow1 = Normalised(wide);
    blue_yellow2 = Normalised(narrow);
    blue_yellow1_y = Normalised(wide, share1 / (share1 + share2));
    blue_yellow2_y = Normalised(narrow, share2 / (share1 + share2));

    constexpr double kFeatureWidthDegrees = 0.082;
    const double deviation = 0.5 * kFeatureWidthDegrees * pixels_per_degree;
    const int feature = static_cast<int>(std::ceil(3.0 * deviation));
    const auto bell = [&](double i) { return Exp(-i * i / (2.0 * deviation * deviation)); };
    gauss = Normalised(MakeKernel(feature, bell));
    edge = Normalised(MakeKernel(feature, [&](double i) { return -i * bell(i); }));
    point =
        Normalised(MakeKernel(feature, [&](double i) { return (i * i / (deviation * deviation) - 1.0) * bell(i); }));
    radius = std::max(eye, feature);
  }
};

struct Plane {
  int width = 0, height = 0;
  std::vector<double> values;

  void Reset(int new_width, int new_height) {
    width = new_width;
    height = new_height;
    values.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0.0);
  }
  double* Row(int y) { return values.data() + static_cast<std::ptrdiff_t>(y) * width; }
  const double* Row(int y) const { return values.data() + static_cast<std::ptrdiff_t>(y) * width; }
};

void AddScaled(const double* in, double weight, int count, double* __restrict out) {
  for (int i = 0; i < count; ++i) out[i] += weight * in[i];
}

// `out` is narrower than `in` by `margin` pixels on either side; the kernel's radius is at most `margin`.
void FilterAlongX(const Plane& in, const Kernel& kernel, int margin, Plane& out) {
  out.Reset(in.width - 2 * margin, in.height);
  const int first = margin - kernel.radius();
  for (int y = 0; y < out.height; ++y) {
    for (std::size_t i = 0; i < kernel.weights.size(); ++i) {
      AddScaled(in.Row(y) + first + static_cast<int>(i), kernel.weights[i], out.width, out.Row(y));
    }
  }
}

// The same along y, but adds to `out`, which already has the right size.
void AddFilteredAlongY(const Plane& in, const Kernel& kernel, int margin, Plane& out) {
  const int first = margin - kernel.radius();
  for (int y = 0; y < out.height; ++y) {
    for (std::size_t i = 0; i < kernel.weights.size(); ++i) {
      AddScaled(in.Row(y + first + static_cast<int>(i)), kernel.weights[i], out.width, out.Row(y));
    }
  }
}

// ---- One tile of one image ---------------------------------------------------------------------------------------

struct Tile {
  int x = 0, y = 0, width = 0, height = 0;  // pixels
};

// Whether all pixels that a filtered tile depends on have the same bits in both images, so that its errors are 0. This
// is true for most tiles of images that are expected to be equal.
bool AreSameAround(const Tile& tile, int margin, const Image& a, const Image& b) {
  const int left = std::max(tile.x - margin, 0), right = std::min(tile.x + tile.width + margin, a.width);
  const int top = std::max(tile.y - margin, 0), bottom = std::min(tile.y + tile.height + margin, a.height);
  for (int y = top; y < bottom; ++y) {
    const std::size_t first = (static_cast<std::size_t>(y) * a.width + left) * 4;
    const std::size_t bytes = static_cast<std::size_t>(right - left) * 4 * sizeof(float);
    if (std::memcmp(a.As<float>() + first, b.As<float>() + first, bytes) != 0) return false;
  }
  return true;
}

// How light is converted for display at one exposure.
struct Viewing {
  float backdrop = 0.0f;
  bool tone_mapped = false;
  double factor = 1.0;
};

class TileView {
 public:
  // Filters `tile` of the image; pixels beyond its borders repeat those at the border.
  void Look(const Image& image, const Tile& tile, const Filters& filters, const Viewing& viewing) {
    Load(image, tile, filters.radius, viewing);
    const int margin = filters.radius;
    for (Plane* plane : {&lightness_, &red_green_, &blue_yellow_, &edge_x_, &edge_y_, &point_x_, &point_y_}) {
      plane->Reset(tile.width, tile.height);
    }
    const auto filter = [&](const Plane& in, const Kernel& x, const Kernel& y, Plane& out) {
      FilterAlongX(in, x, margin, row_filtered_);
      AddFilteredAlongY(row_filtered_, y, margin, out);
    };
    filter(y_, filters.lightness, filters.lightness, lightness_);
    filter(x_minus_y_, filters.red_green, filters.red_green, red_green_);
    filter(y_minus_z_, filters.blue_yellow1, filters.blue_yellow1_y, blue_yellow_);
    filter(y_minus_z_, filters.blue_yellow2, filters.blue_yellow2_y, blue_yellow_);
    filter(y_, filters.edge, filters.gauss, edge_x_);
    filter(y_, filters.point, filters.gauss, point_x_);
    FilterAlongX(y_, filters.gauss, margin, row_filtered_);
    AddFilteredAlongY(row_filtered_, filters.edge, margin, edge_y_);
    AddFilteredAlongY(row_filtered_, filters.point, margin, point_y_);
  }

  Triple Lab(std::size_t i) const {
    const double y = lightness_.values[i];
    Triple rgb = kRgbFromXyz * Triple{y + red_green_.values[i], y, y - blue_yellow_.values[i]};
    for (double& value : rgb) value = std::clamp(value, 0.0, 1.0);
    return HuntLab(rgb);
  }
  double Edge(std::size_t i) const { return Length(edge_x_.values[i], edge_y_.values[i]); }
  double Point(std::size_t i) const { return Length(point_x_.values[i], point_y_.values[i]); }

 private:
  static double Length(double x, double y) { return std::sqrt(x * x + y * y); }

  // The opponent channels YCxCz without their constant factors, which cancel since filtering is linear.
  void Load(const Image& image, const Tile& tile, int margin, const Viewing& viewing) {
    for (Plane* plane : {&y_, &x_minus_y_, &y_minus_z_}) {
      plane->Reset(tile.width + 2 * margin, tile.height + 2 * margin);
    }
    const float* pixels = image.As<float>();
    for (int row = 0; row < y_.height; ++row) {
      const int from_y = std::clamp(tile.y + row - margin, 0, image.height - 1);
      for (int column = 0; column < y_.width; ++column) {
        const int from_x = std::clamp(tile.x + column - margin, 0, image.width - 1);
        const float* pixel = pixels + (static_cast<std::size_t>(from_y) * image.width + from_x) * 4;
        Triple rgb = OverBackdrop(pixel, viewing.backdrop);
        for (double& value : rgb) {
          // The tone curve is defined only from 0.
          if (viewing.tone_mapped) value = FlipToneCurve(std::max(value, 0.0) * viewing.factor);
          value = std::clamp(value, 0.0, 1.0);
        }
        const Triple xyz = kXyzFromRgb * rgb;
        y_.Row(row)[column] = xyz[1];
        x_minus_y_.Row(row)[column] = xyz[0] - xyz[1];
        y_minus_z_.Row(row)[column] = xyz[1] - xyz[2];
      }
    }
  }

  Plane y_, x_minus_y_, y_minus_z_, row_filtered_;
  Plane lightness_, red_green_, blue_yellow_, edge_x_, edge_y_, point_x_, point_y_;
};

// ---- Errors --------------------------------------------------------------------------------------------------------

class ErrorScale {
 public:
  // Sections 4.1.3, 4.2 and 4.3: `distance` is the HyAB distance, `feature` the larger difference of edges and points.
  double Error(double distance, double feature) const {
    if (distance == 0.0) return 0.0;
    const double strength = std::sqrt(std::min(feature / std::numbers::sqrt2, 1.0));
    return Exp2((1.0 - strength) * Log2OfColourError(distance));
  }

 private:
  static constexpr double kPower = 0.7, kKnee = 0.4, kKneeError = 0.95;

  // Nearly all pixels are below the knee, where one logarithm replaces two powers.
  double Log2OfColourError(double distance) const {
    const double log2_power = kPower * Log2(distance);
    if (log2_power < log2_knee_) return log2_power + log2_slope_;
    const double power = Exp2(log2_power);
    return Log2(std::min(kKneeError + (power - knee_) / (largest_ - knee_) * (1.0 - kKneeError), 1.0));
  }

  double largest_ = Pow(HyAb(HuntLab({0.0, 1.0, 0.0}), HuntLab({0.0, 0.0, 1.0})), kPower);  // green to blue
  double knee_ = kKnee * largest_;
  double log2_knee_ = Log2(knee_);
  double log2_slope_ = Log2(kKneeError / knee_);
};

// Raises the per-pixel `errors` of the image to those of a tile where these are larger.
void RaiseErrors(const TileView& reference, const TileView& test, const Tile& tile, const ErrorScale& scale,
                 int image_width, std::vector<float>& errors) {
  std::size_t i = 0;
  for (int y = 0; y < tile.height; ++y) {
    float* out = errors.data() + static_cast<std::size_t>(tile.y + y) * image_width + tile.x;
    for (int x = 0; x < tile.width; ++x, ++i, ++out) {
      const double feature =
          std::max(std::abs(reference.Edge(i) - test.Edge(i)), std::abs(reference.Point(i) - test.Point(i)));
      const double error = scale.Error(HyAb(reference.Lab(i), test.Lab(i)), feature);
      *out = std::max(*out, static_cast<float>(error));
    }
  }
}

}  // namespace

std::vector<float> FlipErrors(const Image& reference, const Image& test, const FlipSettings& settings) {
  const Filters filters(settings.pixels_per_degree);
  const ErrorScale scale;
  std::vector<Viewing> viewings;
  for (const double stops : settings.exposures_ev) viewings.push_back({settings.backdrop, true, Exp2(stops)});
  if (viewings.empty()) viewings.push_back({settings.backdrop, false, 1.0});

  std::vector<float> errors(reference.PixelCount(), 0.0f);
  // Tiles grow with the filters; otherwise most of the work would be spent on margins.
  const int side = std::max(128, 4 * filters.radius);
  const int columns = (reference.width + side - 1) / side, rows = (reference.height + side - 1) / side;
  const std::size_t tiles = static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
  ParallelFor(tiles, 1, [&](std::size_t index, std::size_t) {
    Tile tile{static_cast<int>(index) % columns * side, static_cast<int>(index) / columns * side, 0, 0};
    tile.width = std::min(side, reference.width - tile.x);
    tile.height = std::min(side, reference.height - tile.y);
    if (AreSameAround(tile, filters.radius, reference, test)) return;
    TileView reference_view, test_view;
    for (const Viewing& viewing : viewings) {
      reference_view.Look(reference, tile, filters, viewing);
      test_view.Look(test, tile, filters, viewing);
      RaiseErrors(reference_view, test_view, tile, scale, reference.width, errors);
    }
  });
  return errors;
}

}  // namespace facet
