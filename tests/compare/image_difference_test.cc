// Equality, differences, RMSE, PSNR and SSIM; what is no finite number, alpha, and errors.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include "base/parallel.h"
#include "color/srgb.h"
#include "compare/formula_images.h"
#include "facet/compare.h"
#include "facet/error.h"

namespace facet::test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

template <class T>
Image MakeImage(int width, int height, int channels, const std::vector<T>& numbers) {
  constexpr ChannelType kType = sizeof(T) == 1 ? ChannelType::U8 : sizeof(T) == 2 ? ChannelType::U16 : ChannelType::F32;
  Image image = Blank(width, height, channels, kType, sizeof(T) == 4 ? Encoding::Linear : Encoding::Srgb);
  EXPECT_EQ(image.bytes.size(), numbers.size() * sizeof(T));
  std::memcpy(image.bytes.data(), numbers.data(), image.bytes.size());
  return image;
}

template <class T>
Image Filled(int width, int height, const std::vector<T>& pixel) {
  std::vector<T> numbers;
  for (int i = 0; i < width * height; ++i) numbers.insert(numbers.end(), pixel.begin(), pixel.end());
  return MakeImage(width, height, static_cast<int>(pixel.size()), numbers);
}

using Bytes = std::vector<std::uint8_t>;
using Words = std::vector<std::uint16_t>;
using Floats = std::vector<float>;

void ExpectEqualImages(const Image& a, const Image& b) {
  const ImageDifference d = CompareImages(a, b);
  EXPECT_TRUE(d.equal);
  EXPECT_EQ(d.max_difference, 0.0);
  EXPECT_EQ(d.differing_pixels, 0u);
  EXPECT_EQ(d.rmse, 0.0);
  EXPECT_EQ(d.psnr_db, kInfinity);
  EXPECT_EQ(d.ssim, 1.0);
  EXPECT_EQ(d.flip_mean, 0.0);
  EXPECT_EQ(d.flip_max, 0.0);
  EXPECT_EQ(d.flip_map.PixelCount(), a.PixelCount());
}

TEST(ImageDifference, EqualNumbersAreEqualInEveryForm) {
  const Image rgb = Filled<std::uint8_t>(5, 4, {17, 17, 17});
  ExpectEqualImages(rgb, rgb);
  ExpectEqualImages(rgb, Filled<std::uint8_t>(5, 4, {17}));       // grey
  ExpectEqualImages(rgb, Filled<std::uint8_t>(5, 4, {17, 255}));  // opaque
  ExpectEqualImages(rgb, Filled<std::uint8_t>(5, 4, {17, 17, 17, 255}));
  ExpectEqualImages(rgb, Filled<std::uint16_t>(5, 4, {17 * 257, 17 * 257, 17 * 257}));
  ExpectEqualImages(rgb, Filled<float>(5, 4, {Srgb8ToLinearTable()[17]}));  // the same light
  for (int code = 0; code < 256; ++code) {
    const auto byte = static_cast<std::uint8_t>(code);
    const auto word = static_cast<std::uint16_t>(code * 257);
    EXPECT_TRUE(CompareImages(MakeImage(1, 1, 1, Bytes{byte}), MakeImage(1, 1, 1, Words{word})).equal) << code;
  }
}

TEST(ImageDifference, SaysWhereAndHowMuch) {
  Image a = Filled<std::uint8_t>(6, 4, {100, 100, 100}), b = a;
  b.As<std::uint8_t>()[(2 * 6 + 5) * 3 + 1] = 90;
  b.As<std::uint8_t>()[(3 * 6 + 1) * 3 + 2] = 110;  // as much, but later
  b.As<std::uint8_t>()[(1 * 6 + 1) * 3 + 0] = 101;
  const ImageDifference d = CompareImages(a, b);
  EXPECT_FALSE(d.equal);
  EXPECT_FALSE(d.linear);
  EXPECT_DOUBLE_EQ(d.max_difference, 10.0 / 255.0);
  EXPECT_EQ(d.max_x, 5);
  EXPECT_EQ(d.max_y, 2);
  EXPECT_EQ(d.differing_pixels, 3u);
  EXPECT_DOUBLE_EQ(d.rmse, std::sqrt((100.0 + 100.0 + 1.0) / (6 * 4 * 3)) / 255.0);
  const ImageDifference deeper = CompareImages(MakeImage(1, 1, 1, Bytes{7}), MakeImage(1, 1, 1, Words{7 * 257 + 1}));
  EXPECT_NEAR(deeper.max_difference, 1.0 / 65535.0, 1e-16);
}

TEST(ImageDifference, RmseAndPsnrOfKnownNoise) {
  const Image a = Filled<std::uint8_t>(40, 30, {100, 120, 140});
  Image b = a;
  int sign = 1;
  for (std::size_t i = 0; i < b.bytes.size(); ++i, sign = -sign) {
    b.As<std::uint8_t>()[i] = static_cast<std::uint8_t>(b.As<std::uint8_t>()[i] + 5 * sign);
  }
  const ImageDifference d = CompareImages(a, b);
  EXPECT_NEAR(d.rmse, 5.0 / 255.0, 1e-15);
  EXPECT_NEAR(d.psnr_db, 20.0 * std::log10(51.0), 1e-12);
  const ImageDifference light = CompareImages(Filled<float>(9, 9, {2.0f}), Filled<float>(9, 9, {12.0f}));
  EXPECT_TRUE(light.linear);
  EXPECT_DOUBLE_EQ(light.rmse, 10.0);
  EXPECT_NEAR(light.psnr_db, -20.0, 1e-12);
}

TEST(ImageDifference, SsimOfConstantsFollowsTheClosedForm) {
  for (const auto& [width, height] : {std::pair{32, 20}, {11, 11}, {10, 3}, {1, 40}, {1, 1}}) {
    const ImageDifference d =
        CompareImages(Filled<std::uint8_t>(width, height, {51}), Filled<std::uint8_t>(width, height, {204}));
    const double a = 0.2, b = 0.8, c1 = 1e-4;
    EXPECT_NEAR(d.ssim, (2 * a * b + c1) / (a * a + b * b + c1), 1e-12) << width << "x" << height;
  }
}

TEST(ImageDifference, SsimOfASideShorterThanTheWindow) {
  const double side = std::exp(-1.0 / 4.5), sum = 1.0 + 2.0 * side;  // three weights of a Gaussian of sigma 1.5
  const double weights[3] = {side / sum, 1.0 / sum, side / sum};
  const std::uint8_t a[3] = {10, 200, 90}, b[3] = {60, 30, 250};
  double ma = 0, mb = 0, aa = 0, bb = 0, ab = 0;
  for (int i = 0; i < 3; ++i) {
    const double p = a[i] / 255.0, q = b[i] / 255.0;
    ma += weights[i] * p;
    mb += weights[i] * q;
    aa += weights[i] * p * p;
    bb += weights[i] * q * q;
    ab += weights[i] * p * q;
  }
  const double c1 = 1e-4, c2 = 9e-4;
  const double expected =
      (2 * ma * mb + c1) * (2 * (ab - ma * mb) + c2) / ((ma * ma + mb * mb + c1) * (aa - ma * ma + bb - mb * mb + c2));
  const Bytes numbers_a(a, a + 3), numbers_b(b, b + 3);
  EXPECT_NEAR(CompareImages(MakeImage(3, 1, 1, numbers_a), MakeImage(3, 1, 1, numbers_b)).ssim, expected, 1e-12);
  EXPECT_NEAR(CompareImages(MakeImage(1, 3, 1, numbers_a), MakeImage(1, 3, 1, numbers_b)).ssim, expected, 1e-12);
}

// Figures: scikit-image 0.19.3, structural_similarity(luma a, luma b, data_range=1, gaussian_weights=True, sigma=1.5,
// use_sample_covariance=False) with luma 0.2126 R + 0.7152 G + 0.0722 B; numpy for the RMSE.
TEST(ImageDifference, AgreesWithScikitImage) {
  struct Case {
    int width, height;
    double ssim, rmse;
  };
  for (const Case& c : {Case{96, 64, 0.623014328818, 0.106597584225}, Case{40, 200, 0.697833739448, 0.075953206184},
                        Case{300, 20, 0.328237431120, 0.162581428055}}) {
    const ImageDifference d = CompareImages(ByteImage(c.width, c.height, false), ByteImage(c.width, c.height, true));
    EXPECT_NEAR(d.ssim, c.ssim, 1e-11);
    EXPECT_NEAR(d.rmse, c.rmse, 1e-11);
  }
}

TEST(ImageDifference, SsimOfLightIsThatOfItsDisplay) {
  // Greys: the luminance's code is the grey's.
  Image a = Blank(30, 20, 1, ChannelType::U8), b = a;
  Image light_a = Blank(30, 20, 1, ChannelType::F32, Encoding::Linear), light_b = light_a;
  for (std::size_t i = 0; i < a.PixelCount(); ++i) {
    a.As<std::uint8_t>()[i] = static_cast<std::uint8_t>(i * 37 % 256);
    b.As<std::uint8_t>()[i] = static_cast<std::uint8_t>(i * 37 % 256 / 2 + i % 9);
    light_a.As<float>()[i] = Srgb8ToLinearTable()[a.As<std::uint8_t>()[i]];
    light_b.As<float>()[i] = Srgb8ToLinearTable()[b.As<std::uint8_t>()[i]];
  }
  EXPECT_NEAR(CompareImages(a, b).ssim, CompareImages(light_a, light_b).ssim, 1e-6);
}

TEST(ImageDifference, SymmetricButForHdrFlip) {
  for (const bool light : {false, true}) {
    const Image a = light ? FloatImage(60, 40, false) : ByteImage(60, 40, false);
    const Image b = light ? FloatImage(60, 40, true) : ByteImage(60, 40, true);
    const ImageDifference ab = CompareImages(a, b), ba = CompareImages(b, a);
    EXPECT_EQ(ab.max_difference, ba.max_difference);
    EXPECT_EQ(ab.rmse, ba.rmse);
    EXPECT_EQ(ab.ssim, ba.ssim);
    EXPECT_EQ(light, ab.flip_map.bytes != ba.flip_map.bytes);
  }
}

TEST(ImageDifference, SameBitsForAnyNumberOfThreads) {
  for (const bool light : {false, true}) {
    const Image a = light ? FloatImage(290, 150, false) : ByteImage(290, 150, false);
    const Image b = light ? FloatImage(290, 150, true) : ByteImage(290, 150, true);
    ImageDifference one, eight;
    RunWithThreads(1, [&] { one = CompareImages(a, b); });
    RunWithThreads(8, [&] { eight = CompareImages(a, b); });
    EXPECT_EQ(one.rmse, eight.rmse);
    EXPECT_EQ(one.ssim, eight.ssim);
    EXPECT_EQ(one.flip_mean, eight.flip_mean);
    EXPECT_EQ(one.flip_map.bytes, eight.flip_map.bytes);
    EXPECT_EQ(one.max_x, eight.max_x);
    EXPECT_EQ(one.max_y, eight.max_y);
  }
}

// ---- Alpha ---------------------------------------------------------------------------------------------------------

TEST(ImageDifferenceAlpha, IsAChannelOfDifferencesAndRmse) {
  const ImageDifference d =
      CompareImages(Filled<std::uint8_t>(12, 12, {50, 60, 70, 255}), Filled<std::uint8_t>(12, 12, {50, 60, 70, 204}));
  EXPECT_DOUBLE_EQ(d.max_difference, 0.2);
  EXPECT_NEAR(d.rmse, 0.2 / 2.0, 1e-15);  // one of four channels
  EXPECT_EQ(d.differing_pixels, 144u);
  // Against an image without alpha it is as if that were opaque.
  const ImageDifference other =
      CompareImages(Filled<std::uint8_t>(12, 12, {50, 60, 70}), Filled<std::uint8_t>(12, 12, {50, 60, 70, 204}));
  EXPECT_EQ(other.rmse, d.rmse);
  EXPECT_EQ(other.flip_mean, d.flip_mean);
}

TEST(ImageDifferenceAlpha, ColoursOfTheTransparentAreNotSeen) {
  const ImageDifference d =
      CompareImages(Filled<std::uint8_t>(12, 12, {255, 0, 0, 0}), Filled<std::uint8_t>(12, 12, {0, 255, 0, 0}));
  EXPECT_FALSE(d.equal);
  EXPECT_EQ(d.max_difference, 1.0);
  EXPECT_EQ(d.flip_max, 0.0);
  EXPECT_EQ(d.ssim, 1.0);
}

TEST(ImageDifferenceAlpha, NoBackdropHidesATransparentImage) {
  for (const int code : {0, 128, 255}) {
    const auto grey = static_cast<std::uint8_t>(code);
    const ImageDifference d = CompareImages(Filled<std::uint8_t>(12, 12, {grey, grey, grey, 0}),
                                            Filled<std::uint8_t>(12, 12, {grey, grey, grey, 255}));
    EXPECT_GT(d.flip_mean, 0.5) << code;
    EXPECT_LT(d.ssim, 0.9) << code;
  }
}

TEST(ImageDifferenceAlpha, FlipTakesTheWorseOfBlackAndWhite) {
  // White light of half coverage over black is 0.5, over white nothing is to be seen.
  const ImageDifference d =
      CompareImages(Filled<float>(12, 12, {1.0f, 1.0f, 1.0f, 1.0f}), Filled<float>(12, 12, {1.0f, 1.0f, 1.0f, 0.5f}));
  const ImageDifference over_black = CompareImages(Filled<float>(12, 12, {1.0f}), Filled<float>(12, 12, {0.5f}));
  EXPECT_GT(d.flip_mean, 0.0);
  EXPECT_NEAR(d.flip_mean, over_black.flip_mean, 1e-7);
  EXPECT_NEAR(d.ssim, over_black.ssim, 1e-7);
}

// ---- Not finite ----------------------------------------------------------------------------------------------------

TEST(ImageDifferenceNonFinite, SameBitsAreEqual) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  const Image a = MakeImage(2, 2, 1, Floats{1.0f, nan, inf, -inf});
  ExpectEqualImages(a, a);
  EXPECT_EQ(CompareImages(a, a).non_finite_pixels_a, 3u);
  EXPECT_EQ(CompareImages(a, a).non_finite_pixels_b, 3u);
}

TEST(ImageDifferenceNonFinite, CountsAndBreaksEveryBound) {
  const float values[] = {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                          -std::numeric_limits<float>::infinity()};
  for (const float value : values) {
    const Image a = Filled<float>(20, 20, {0.0f, 0.0f, 0.0f});
    Image b = a;
    b.As<float>()[(7 * 20 + 4) * 3 + 2] = value;
    for (const bool swapped : {false, true}) {
      const ImageDifference d = swapped ? CompareImages(b, a) : CompareImages(a, b);
      EXPECT_FALSE(d.equal);
      EXPECT_EQ(swapped ? d.non_finite_pixels_a : d.non_finite_pixels_b, 1u);
      EXPECT_EQ(swapped ? d.non_finite_pixels_b : d.non_finite_pixels_a, 0u);
      EXPECT_EQ(d.differing_pixels, 1u);
      EXPECT_EQ(d.max_difference, kInfinity);
      EXPECT_EQ(d.max_x, 4);
      EXPECT_EQ(d.max_y, 7);
      EXPECT_EQ(d.rmse, kInfinity);
      EXPECT_EQ(d.psnr_db, -kInfinity);
      EXPECT_EQ(d.flip_max, 1.0);
      EXPECT_NEAR(d.flip_mean, 1.0 / 400.0, 1e-12);
      // 10 x 10 windows; those that cover (4, 7) have their left edge at 0 to 4 and their top edge at 0 to 7.
      EXPECT_NEAR(d.ssim, 1.0 - 40.0 / 100.0, 1e-12);
    }
  }
}

TEST(ImageDifferenceNonFinite, HugeAndNegativeLightIsMeasured) {
  const float huge = std::numeric_limits<float>::max();
  const ImageDifference d = CompareImages(Filled<float>(5, 5, {huge}), Filled<float>(5, 5, {-huge}));
  EXPECT_DOUBLE_EQ(d.max_difference, 2.0 * static_cast<double>(huge));
  EXPECT_TRUE(std::isfinite(d.rmse));
  EXPECT_GT(d.flip_mean, 0.9);
  EXPECT_LE(d.flip_max, 1.0);
  EXPECT_GE(d.ssim, -1.0);
  // Zero has two bit patterns.
  const ImageDifference zeros = CompareImages(Filled<float>(5, 5, {0.0f}), Filled<float>(5, 5, {-0.0f}));
  EXPECT_FALSE(zeros.equal);
  EXPECT_EQ(zeros.max_difference, 0.0);
  EXPECT_EQ(zeros.flip_max, 0.0);
}

// ---- Errors --------------------------------------------------------------------------------------------------------

ErrorCode CodeOf(const Image& a, const Image& b, const CompareOptions& options = {}) {
  try {
    CompareImages(a, b, options);
  } catch (const Error& error) {
    return error.code();
  }
  ADD_FAILURE() << "accepted";
  return ErrorCode::Internal;
}

TEST(ImageDifferenceErrors, NamesBothSizes) {
  try {
    CompareImages(Filled<std::uint8_t>(3, 4, {1}), Filled<std::uint8_t>(4, 3, {1}));
    ADD_FAILURE() << "accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::InvalidInput);
    EXPECT_NE(error.message().find("3x4"), std::string::npos) << error.what();
    EXPECT_NE(error.message().find("4x3"), std::string::npos) << error.what();
  }
}

TEST(ImageDifferenceErrors, KeepsTheMemoryLimit) {
  const Image a = Filled<std::uint8_t>(100, 100, {1}), b = Filled<std::uint8_t>(100, 100, {2});
  CompareOptions options;
  options.memory_limit = 100 * 100 * 64;
  EXPECT_FALSE(CompareImages(a, b, options).equal);
  --options.memory_limit;
  try {
    CompareImages(a, b, options);
    ADD_FAILURE() << "accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::OutOfMemory);
    EXPECT_NE(error.message().find("for comparing images of 100x100 pixels"), std::string::npos) << error.what();
  }
}

TEST(ImageDifferenceErrors, RefusesWhatIsNoImageAndOptionsOutOfRange) {
  const Image a = Filled<std::uint8_t>(3, 3, {1});
  Image cut = a;
  cut.bytes.pop_back();
  EXPECT_EQ(CodeOf(a, cut), ErrorCode::InvalidUsage);
  EXPECT_EQ(CodeOf(Image{}, Image{}), ErrorCode::InvalidUsage);
  for (const double bad : {0.0, 0.5, 1001.0, std::nan("")}) EXPECT_EQ(CodeOf(a, a, {bad}), ErrorCode::InvalidUsage);
}

// ---- Thresholds ----------------------------------------------------------------------------------------------------

TEST(CompareThresholds, WithoutAnyOnlyEqualImagesAreWithin) {
  const Image a = Filled<std::uint8_t>(4, 4, {9}), b = Filled<std::uint8_t>(4, 4, {10});
  EXPECT_TRUE(BrokenThresholds(CompareImages(a, a), {}).empty());
  EXPECT_EQ(BrokenThresholds(CompareImages(a, b), {}), std::vector<std::string>{"the pictures differ"});
}

TEST(CompareThresholds, AllMustBeKeptAndBoundsAreInclusive) {
  ImageDifference d;
  d.max_difference = 0.5;
  d.differing_pixels = 7;
  d.rmse = 0.25;
  d.psnr_db = 30.0;
  d.ssim = 0.75;
  d.flip_mean = 0.125;
  const CompareThresholds kept{0.5, 7, 0.25, 30.0, 0.75, 0.125};
  EXPECT_TRUE(BrokenThresholds(d, kept).empty());
  const CompareThresholds none{0.4, 6, 0.2, 31.0, 0.8, 0.1};
  EXPECT_EQ(BrokenThresholds(d, none),
            (std::vector<std::string>{"the largest difference 0.5 is above 0.4",
                                      "the number of differing pixels 7 is above 6", "RMSE 0.25 is above 0.2",
                                      "PSNR 30 is below 31", "SSIM 0.75 is below 0.8", "FLIP 0.125 is above 0.1"}));
  CompareThresholds one = kept;
  one.min_ssim = 0.9;
  EXPECT_EQ(BrokenThresholds(d, one).size(), 1u);
  d.rmse = std::nan("");
  EXPECT_EQ(BrokenThresholds(d, kept).size(), 1u);
}

}  // namespace
}  // namespace facet::test
