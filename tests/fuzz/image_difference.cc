// Two pictures made of the input's bytes, compared.
#include <fuzzer/FuzzedDataProvider.h>

#include <array>
#include <cmath>
#include <cstring>
#include <vector>

#include "facet/compare.h"
#include "fuzz/fuzz.h"

namespace facet::fuzz {
namespace {

// Its kind, and pixels that are the input's bytes again and again.
Image MakeImage(FuzzedDataProvider& input, int width, int height) {
  Image image{.width = width, .height = height};
  image.channels = input.ConsumeIntegralInRange(1, 4);
  image.type = input.PickValueInArray({ChannelType::U8, ChannelType::U16, ChannelType::F32});
  image.encoding = input.PickValueInArray({Encoding::Srgb, Encoding::Linear});
  const std::vector<std::uint8_t> pattern = input.ConsumeBytes<std::uint8_t>(input.ConsumeIntegralInRange(0, 512));
  image.bytes.resize(image.PixelCount() * std::size_t(image.channels) * SizeOf(image.type));
  if (pattern.empty()) return image;
  for (std::size_t i = 0; i < image.bytes.size(); ++i) image.bytes[i] = std::byte{pattern[i % pattern.size()]};
  return image;
}

bool IsIn(double value, double low, double high) { return value >= low && value <= high; }

void CheckDifference(const ImageDifference& d) {
  const std::size_t pixels = std::size_t(d.width) * std::size_t(d.height);
  Check(d.equal == (d.differing_pixels == 0), "equal pictures that differ");
  Check(!d.equal || (d.max_difference == 0.0 && d.rmse == 0.0 && d.flip_max == 0.0 && d.psnr_db > 1e300),
        "equal pictures have a difference");
  Check(d.differing_pixels <= pixels && d.non_finite_pixels_a <= pixels && d.non_finite_pixels_b <= pixels,
        "more pixels than there are");
  Check(d.max_difference >= 0.0 && d.rmse >= 0.0 && !std::isnan(d.psnr_db), "a difference is no number");
  Check(IsIn(d.ssim, -1.0, 1.0), "SSIM is out of range");
  Check(IsIn(d.flip_mean, 0.0, d.flip_max) && d.flip_max <= 1.0, "FLIP is out of range");
  Check(d.max_x >= 0 && d.max_x < d.width && d.max_y >= 0 && d.max_y < d.height, "a pixel outside of the picture");
  Check(d.flip_map.bytes.size() == pixels * sizeof(float), "the map has another size");
}

}  // namespace

void Run(std::span<const std::byte> input) {
  FuzzedDataProvider provider(reinterpret_cast<const std::uint8_t*>(input.data()), input.size());
  const int width = provider.ConsumeIntegralInRange(1, 48), height = provider.ConsumeIntegralInRange(1, 24);
  CompareOptions options;
  options.memory_limit = kMemoryLimit;
  if (provider.ConsumeBool()) options.pixels_per_degree = provider.ConsumeFloatingPointInRange(1.0, 1000.0);
  const bool same = provider.ConsumeBool();
  const Image a = MakeImage(provider, width, height);
  const Image b = same ? a : MakeImage(provider, width, height);
  CompareThresholds thresholds;
  thresholds.max_difference = provider.ConsumeFloatingPoint<double>();
  thresholds.min_ssim = provider.ConsumeFloatingPoint<double>();
  thresholds.max_flip = provider.ConsumeFloatingPoint<double>();
  Try([&] {
    const ImageDifference difference = CompareImages(a, b, options);
    CheckDifference(difference);
    Check(!same || difference.equal, "a picture is not equal to itself");
    BrokenThresholds(difference, thresholds);
    HeatMap(difference);
  });
}

}  // namespace facet::fuzz
