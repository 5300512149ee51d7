// Comparison of two images.
#pragma once

#include <cstddef>
#include <cstdint>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "facet/image.h"

namespace facet {

// FLIP's default, 67.02: a display that is 3840 pixels and 0.7 m wide, seen from a distance of 0.7 m.
inline constexpr double kDefaultPixelsPerDegree = 3840.0 * std::numbers::pi / 180.0;

struct CompareOptions {
  double pixels_per_degree = kDefaultPixelsPerDegree;  // of the observer's visual field; 1 to 1000
  std::uint64_t memory_limit = 0;  // bytes, without the two images; 0: three quarters of the machine's memory
};

// The result of CompareImages(). `a` is the reference, `b` is the test.
//
// Two integer images of the same encoding are compared by their codes, normalised to [0, 1] (8 bits can be compared
// with 16); all others by linear light. Grey counts as RGB, a missing alpha as 1. If one of the images has alpha, it is
// a fourth channel for `equal`, the differences and the RMSE. SSIM and FLIP measure what is visible: the images are
// composited over black and over white, and the worse result counts. Over a single backdrop, things of its colour would
// be invisible; over both, images look equal only if they are equal, except for the colour of fully transparent pixels.
//
// NaN and infinities are equal only to the same bits. Where they differ, the largest difference and the RMSE are
// infinite, FLIP is 1, and SSIM windows that contain them count as 0.
struct ImageDifference {
  int width = 0, height = 0;  // pixels
  bool equal = false;         // every component has the same bits
  bool linear = false;        // linear light was compared, with HDR-FLIP; false: codes, with LDR-FLIP

  double max_difference = 0.0;          // the largest |a - b| of one channel
  int max_x = 0, max_y = 0;             // its pixel: the first one, row by row from the top
  std::size_t differing_pixels = 0;     // pixels with a component whose bits differ
  std::size_t non_finite_pixels_a = 0;  // pixels with a NaN or an infinity
  std::size_t non_finite_pixels_b = 0;

  double rmse = 0.0;     // root of the mean squared difference over pixels and channels
  double psnr_db = 0.0;  // 10 log10(1 / MSE): the peak is 1, in linear light too; infinite where the RMSE is 0
  // Mean structural similarity: 1 for equal images, -1 at least. Z. Wang, A. C. Bovik, H. R. Sheikh, E. P. Simoncelli,
  // 2004, "Image Quality Assessment: From Error Visibility to Structural Similarity": Gaussian windows of 11 by 11
  // pixels, sigma 1.5, K1 = 0.01, K2 = 0.03, range 1, on luma. As in the paper, only windows that lie within the image
  // count; if a side is shorter than 11 pixels, the window has its length. Luma is 0.2126 R + 0.7152 G + 0.0722 B of
  // the codes (Rec. 709; the paper leaves this open). For linear light it is the luminance, clamped to [0, 1] and sRGB
  // encoded, so SSIM ignores highlights, which the other measures judge.
  double ssim = 1.0;
  // FLIP: 0 for equal images, 1 at most. Mean and maximum of `flip_map`.
  double flip_mean = 0.0, flip_max = 0.0;
  Image flip_map;  // F32, 1 channel
};

// Compares two images of the same size. LDR-FLIP: P. Andersson, J. Nilsson, T. Akenine-Moller, M. Oskarsson, K. Astrom,
// M. D. Fairchild, 2020, "FLIP: A Difference Evaluator for Alternating Images". HDR-FLIP: P. Andersson, J. Nilsson, P.
// Shirley, T. Akenine-Moller, 2021, "Visualizing Errors in Rendered High Dynamic Range Images"; its exposures are
// computed from `a` as proposed there (with the ACES curve), so it is the only measure that is not symmetric. The
// result is the same to the last bit on every machine and for any number of threads. Thread-safe. Throws Error:
// InvalidInput (sizes differ), InvalidUsage (a broken Image, or options out of range).
ImageDifference CompareImages(const Image& a, const Image& b, const CompareOptions& options = {});

// Bounds on a difference. If none is given, the images must be equal.
struct CompareThresholds {
  std::optional<double> max_difference;
  std::optional<std::size_t> max_pixels;  // differing pixels
  std::optional<double> max_rmse;
  std::optional<double> min_psnr_db;
  std::optional<double> min_ssim;
  std::optional<double> max_flip;  // mean
};

// One short line for each bound that is violated, like "FLIP 0.0312 is above 0.01"; empty: none is.
std::vector<std::string> BrokenThresholds(const ImageDifference& difference, const CompareThresholds& thresholds);

// The FLIP map in the colours that FLIP's authors use (matplotlib's magma), from black (equal) to pale yellow. U8,
// sRGB, 3 channels.
Image HeatMap(const ImageDifference& difference);

}  // namespace facet
