// FLIP against closed forms, its properties, and figures of its authors' own program.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <vector>

#include "color/srgb.h"
#include "compare/flip.h"
#include "compare/formula_images.h"
#include "facet/compare.h"

namespace facet::test {
namespace {

float ErrorAt(const ImageDifference& d, int x, int y) {
  return d.flip_map.As<float>()[static_cast<std::size_t>(y) * d.width + x];
}

Image Grey(int width, int height, std::uint8_t code) {
  Image image = Blank(width, height, 1, ChannelType::U8);
  std::memset(image.bytes.data(), code, image.bytes.size());
  return image;
}

Image Coloured(int width, int height, std::array<std::uint8_t, 3> rgb) {
  Image image = Blank(width, height, 3, ChannelType::U8);
  for (std::size_t i = 0; i < image.bytes.size(); ++i) image.As<std::uint8_t>()[i] = rgb[i % 3];
  return image;
}

Image Crop(const Image& image, int left, int top, int width, int height) {
  Image crop = Blank(width, height, image.channels, image.type, image.encoding);
  const std::size_t pixel = crop.bytes.size() / crop.PixelCount();
  for (int y = 0; y < height; ++y) {
    std::memcpy(crop.bytes.data() + static_cast<std::size_t>(y) * width * pixel,
                image.bytes.data() + (static_cast<std::size_t>(top + y) * image.width + left) * pixel, width * pixel);
  }
  return crop;
}

// L* of a grey's linear light.
double Lightness(double y) { return y > 216.0 / 24389.0 ? 116.0 * std::cbrt(y) - 16.0 : y * 24389.0 / 27.0; }

// What the paper's section 4.1.3 makes of a difference in lightness alone.
double ErrorOfLightness(double difference) {
  const auto hunt_lab = [](double x, double y, double z) {
    const auto f = [](double t) { return t > 216.0 / 24389.0 ? std::cbrt(t) : t * 841.0 / 108.0 + 4.0 / 29.0; };
    const double l = 116.0 * f(y) - 16.0;
    return std::array{l, 0.01 * l * 500.0 * (f(x) - f(y)), 0.01 * l * 200.0 * (f(y) - f(z))};
  };
  // X, Y, Z of sRGB's green and blue over those of white, from IEC 61966-2-1's four-digit matrix.
  const auto green = hunt_lab(0.3576 / 0.9505, 0.7152, 0.1192 / 1.0890);
  const auto blue = hunt_lab(0.1805 / 0.9505, 0.0722, 0.9505 / 1.0890);
  const double largest =
      std::pow(std::abs(green[0] - blue[0]) + std::hypot(green[1] - blue[1], green[2] - blue[2]), 0.7);
  const double power = std::pow(difference, 0.7), knee = 0.4 * largest;
  return power < knee ? 0.95 * power / knee : 0.95 + 0.05 * (power - knee) / (largest - knee);
}

TEST(Flip, ConstantGreysFollowTheClosedForm) {
  for (const auto& [a, b] : {std::pair{0, 255}, {0, 1}, {100, 101}, {128, 153}, {10, 200}, {255, 254}}) {
    const auto lightness = [](int code) {
      return Lightness(static_cast<double>(Srgb8ToLinearTable()[static_cast<std::size_t>(code)]));
    };
    const double expected = ErrorOfLightness(std::abs(lightness(a) - lightness(b)));
    for (const auto& [width, height] : {std::pair{150, 20}, {1, 1}, {1, 33}}) {
      const ImageDifference d = CompareImages(Grey(width, height, static_cast<std::uint8_t>(a)),
                                              Grey(width, height, static_cast<std::uint8_t>(b)));
      EXPECT_NEAR(d.flip_mean, expected, 1e-4) << a << " " << b;
      EXPECT_NEAR(d.flip_max, expected, 1e-4) << a << " " << b;
    }
  }
}

TEST(Flip, GreenAgainstBlueIsTheLargestDifference) {
  const Image green = Coloured(20, 20, {0, 255, 0}), blue = Coloured(20, 20, {0, 0, 255});
  EXPECT_NEAR(CompareImages(green, blue).flip_mean, 1.0, 1e-6);
  EXPECT_LE(CompareImages(green, blue).flip_max, 1.0);
}

// Figures: NVlabs/flip 1.6 at 1eb247c (src/cpp/FLIP.h, compiled with GCC 12; means in double), which computes in float.
// At 67 and 20 pixels per degree tests/engines/metrics.py gives the same means to 1e-9.
struct Official {
  int width, height;
  bool light;
  double pixels_per_degree, mean, max, at_right;  // at_right: error of pixel (width - 2, height / 2)
};
constexpr Official kOfficial[] = {
    {96, 64, false, kDefaultPixelsPerDegree, 0.275214285, 0.988773286, 0.1378644},
    {40, 200, false, kDefaultPixelsPerDegree, 0.187778988, 0.989054024, 0.1862740},
    {96, 64, false, 20.0, 0.277139516, 0.993479371, 0.1784266},
    {300, 20, false, 150.0, 0.587388073, 0.971146643, 0.5852925},
    {96, 64, true, kDefaultPixelsPerDegree, 0.204823201, 0.952255487, 0.0534707},
    {200, 50, true, 30.0, 0.239219823, 0.977157831, 0.1131310},
};

TEST(Flip, AgreesWithItsAuthorsProgram) {
  for (const Official& o : kOfficial) {
    const Image a = o.light ? FloatImage(o.width, o.height, false) : ByteImage(o.width, o.height, false);
    const Image b = o.light ? FloatImage(o.width, o.height, true) : ByteImage(o.width, o.height, true);
    const ImageDifference d = CompareImages(a, b, {o.pixels_per_degree});
    EXPECT_EQ(d.linear, o.light);
    EXPECT_NEAR(d.flip_mean, o.mean, 3e-7);
    EXPECT_NEAR(d.flip_max, o.max, 1e-6);
    EXPECT_NEAR(ErrorAt(d, o.width - 2, o.height / 2), o.at_right, 5e-6);
    EXPECT_GE(*std::min_element(d.flip_map.As<float>(), d.flip_map.As<float>() + d.flip_map.PixelCount()), 0.0f);
  }
}

// Tiles and the repeated border: inside, a crop has the errors of the whole.
TEST(Flip, ErrorsDependOnTheNeighbourhoodAlone) {
  const Image a = ByteImage(330, 150, false), b = ByteImage(330, 150, true);
  const ImageDifference whole = CompareImages(a, b);
  constexpr int kLeft = 57, kTop = 3, kWidth = 200, kHeight = 140, kReach = 10;
  const ImageDifference crop =
      CompareImages(Crop(a, kLeft, kTop, kWidth, kHeight), Crop(b, kLeft, kTop, kWidth, kHeight));
  for (int y = kReach; y < kHeight - kReach; ++y) {
    for (int x = kReach; x < kWidth - kReach; ++x) {
      ASSERT_EQ(ErrorAt(crop, x, y), ErrorAt(whole, kLeft + x, kTop + y)) << x << "," << y;
    }
  }
}

TEST(Flip, OneOddPixelIsSeenAroundItAndNowhereElse) {
  const Image a = Grey(300, 280, 90);
  Image b = a;
  b.As<std::uint8_t>()[130 * 300 + 127] = 250;  // at the corner of a tile
  const ImageDifference d = CompareImages(a, b);
  for (int y = 0; y < 280; ++y) {
    for (int x = 0; x < 300; ++x) {
      const int distance = std::max(std::abs(x - 127), std::abs(y - 130));
      if (distance > 10) {
        ASSERT_EQ(ErrorAt(d, x, y), 0.0f) << x << "," << y;
      }
      if (distance <= 4) {
        ASSERT_GT(ErrorAt(d, x, y), 0.0f) << x << "," << y;
      }
    }
  }
  EXPECT_EQ(ErrorAt(d, 127, 130), d.flip_max);
}

TEST(Flip, FineNoiseVanishesFromAfar) {
  const Image grey = Grey(64, 64, 128);
  Image noisy = grey;
  for (std::size_t i = 0; i < noisy.bytes.size(); ++i) {
    noisy.As<std::uint8_t>()[i] = (i % 64 + i / 64) % 2 == 0 ? 118 : 138;
  }
  EXPECT_LT(CompareImages(grey, noisy, {200.0}).flip_mean, 0.3 * CompareImages(grey, noisy, {5.0}).flip_mean);
}

// The exposures follow the reference's light.
TEST(HdrFlip, IsBlindToTheUnitOfLight) {
  const Image a = FloatImage(60, 40, false), b = FloatImage(60, 40, true);
  const auto scaled = [](Image image) {
    for (std::size_t i = 0; i < image.PixelCount() * 3; ++i) image.As<float>()[i] *= 0x1p-20f;
    return image;
  };
  EXPECT_NEAR(CompareImages(a, b).flip_mean, CompareImages(scaled(a), scaled(b)).flip_mean, 1e-7);
}

Image Light(std::vector<float> greys) {
  Image image = Blank(static_cast<int>(greys.size()), 1, 4, ChannelType::F32, Encoding::Linear);
  for (std::size_t i = 0; i < greys.size() * 4; ++i) image.As<float>()[i] = i % 4 == 3 ? 1.0f : greys[i / 4];
  return image;
}

TEST(HdrFlip, ExposuresRunFromTheBrightestPixelToTheMedian) {
  // Narkowicz' curve, less its exposure of 0.6, is 0.85 at x: 0.16002 x^2 - 0.2829 x - 0.119 = 0.
  const double x = (0.2829 + std::sqrt(0.2829 * 0.2829 + 4 * 0.16002 * 0.119)) / (2 * 0.16002);
  const std::vector<double> exposures = FlipExposures(Light({0.5f, 32.0f, 1.0f, 0.25f, 2.0f}), 0.0f);
  ASSERT_EQ(exposures.size(), 5u);  // five stops
  EXPECT_NEAR(exposures.front(), std::log2(x / 32.0), 1e-6);
  EXPECT_NEAR(exposures.back(), std::log2(x / 1.0), 1e-6);
  EXPECT_NEAR(exposures[1] - exposures[0], 1.25, 1e-6);
}

TEST(HdrFlip, DarkAndConstantReferencesHaveExposuresToo) {
  EXPECT_EQ(FlipExposures(Light({0.0f, 0.0f}), 0.0f), std::vector<double>{0.0});
  EXPECT_EQ(FlipExposures(Light({-1.0f, -2.0f}), 0.0f), std::vector<double>{0.0});
  EXPECT_EQ(FlipExposures(Light({3.0f, 3.0f}), 0.0f).size(), 1u);
  EXPECT_EQ(FlipExposures(Light({0.0f, 0.0f, 0.0f, 1.0f, 8.0f}), 0.0f),
            FlipExposures(Light({1.0f, 8.0f}), 0.0f));  // black is left out where it is the median
  EXPECT_GT(CompareImages(Light({0.0f, 0.0f}), Light({1.0f, 1.0f})).flip_mean, 0.5);
}

TEST(HeatMap, RunsFromBlackToPaleYellow) {
  ImageDifference d;
  d.width = 3;
  d.height = 1;
  d.flip_map = Blank(3, 1, 1, ChannelType::F32, Encoding::Linear);
  d.flip_map.As<float>()[1] = 0.5f;
  d.flip_map.As<float>()[2] = 1.0f;
  const Image map = HeatMap(d);
  ASSERT_EQ(map.bytes.size(), 9u);
  EXPECT_EQ(map.encoding, Encoding::Srgb);
  const std::vector<int> rgb(map.As<std::uint8_t>(), map.As<std::uint8_t>() + 9);
  EXPECT_EQ(rgb, (std::vector<int>{0, 0, 4, 183, 55, 121, 252, 253, 191}));  // matplotlib's magma 0, 128 and 255
}

}  // namespace
}  // namespace facet::test
