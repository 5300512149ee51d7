#include "roofline_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "roofline_kernels.cc"
#include "hwy/foreach_target.h"
// Must come after foreach_target.h.
#include "facet/shader/dispatch.h"
#include "facet/shader/lane-inl.h"

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace HWY_NAMESPACE {

// Sums of 16-byte entries, so that no read can be left out.
class Reader {
 public:
  HWY_INLINE void Read(const std::int32_t* p) {
    for (std::size_t i = 0; i < kParts; ++i) sum_[i] = hn::Add(sum_[i], hn::LoadU(Tag(), p + i * (4 / kParts)));
  }
  HWY_INLINE std::int64_t Sum() const {
    std::int64_t sum = 0;
    for (std::size_t i = 0; i < kParts; ++i) sum += hn::GetLane(sum_[i]);
    return sum;
  }

 private:
  using Tag = hn::CappedTag<std::int32_t, 4>;
  static constexpr std::size_t kParts = 4 / hn::MaxLanes(Tag());
  hn::Vec<Tag> sum_[kParts] = {};
};

std::int64_t TapsKernel(const std::uint32_t* taps, std::size_t count, const std::int32_t* texels,
                        const std::int32_t* pitch) {
  Reader reader;
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t texel = taps[i] & ((1u << kTapLevelShift) - 1u);
    const std::int32_t* p = texels + std::size_t(texel) * 4;
    const std::ptrdiff_t right = (texel & 3u) == 3u ? 4 * 13 : 4 * 1;
    const std::ptrdiff_t below =
        (texel & 12u) == 12u ? 4 * (std::ptrdiff_t(pitch[taps[i] >> kTapLevelShift]) * 16 - 12) : 4 * 4;
    reader.Read(p);
    reader.Read(p + right);
    reader.Read(p + below);
    reader.Read(p + below + right);
  }
  return reader.Sum();
}

std::int64_t TableKernel(const std::int32_t* table, int bits, std::size_t count, int reads) {
  Reader reader;
  const std::size_t mask = (std::size_t{1} << bits) - 1;
  for (std::size_t i = 0; i < count; ++i) {
    for (int k = 0; k < reads; ++k) reader.Read(table + ((i + std::size_t(k) * 4099) & mask) * 4);
  }
  return reader.Sum();
}

std::int64_t ImageKernel(const std::int32_t* image, std::size_t pixels, std::size_t width, std::size_t count,
                         float scale) {
  Reader reader;
  const std::size_t last = pixels - width - 2;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t at = std::size_t(float(i) / (scale * scale));
    const std::int32_t* p = image + (at < last ? at : last) * 4;
    reader.Read(p);
    reader.Read(p + 4);
    reader.Read(p + 4 * width);
    reader.Read(p + 4 * width + 4);
  }
  return reader.Sum();
}

float ComputeKernel(const OperationCounts& of_each, std::size_t fragments) {
  constexpr int kChains = 6;  // of additions, and as many of multiplications: more than any processor has under way
  Float sums[kChains], products[kChains], quotients[kChains], roots[kChains];
  for (int i = 0; i < kChains; ++i) {
    sums[i] = products[i] = quotients[i] = roots[i] = Float(1.0f + 0.01f * static_cast<float>(i));
  }
  const Float more(0.001f), less(0.99999f);
  const double packets = double(fragments) / double(LaneCount());
  const auto rounds = [&](double operations, int each)
                          HWY_ATTR { return static_cast<std::size_t>(packets * operations / each + 0.5); };
  const std::size_t simple = rounds(of_each.simple, 2 * kChains), divisions = rounds(of_each.divisions, kChains),
                    square_roots = rounds(of_each.roots, kChains);
  // Spread evenly, as in a shader: a division waits while simpler ones go on.
  const std::size_t slow = divisions + square_roots;
  std::size_t due = 0, done = 0;
  for (std::size_t i = 0; i < simple; ++i) {
    HWY_UNROLL(kChains) for (int k = 0; k < kChains; ++k) {
      sums[k] = sums[k] + more;
      products[k] = products[k] * less;
    }
    due += slow;
    while (due >= simple) {
      due -= simple;
      if (done++ < divisions) {
        HWY_UNROLL(kChains) for (int k = 0; k < kChains; ++k) quotients[k] = less / quotients[k];
      } else {
        HWY_UNROLL(kChains) for (int k = 0; k < kChains; ++k) roots[k] = Sqrt(roots[k]);
      }
    }
  }
  Float total(0.0f);
  for (int k = 0; k < kChains; ++k) total = total + sums[k] + products[k] + quotients[k] + roots[k];
  return hn::GetLane(total.raw);
}

void PixelsKernel(float* film, std::size_t pixels) {
  const Float one(1.0f);
  const std::size_t n = pixels * 4 / LaneCount() * LaneCount();
  for (std::size_t i = 0; i < n; i += LaneCount()) Store(one, film + i);
}

}  // namespace HWY_NAMESPACE
}  // namespace facet
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace facet {

FACET_EXPORT(TapsKernel);
FACET_EXPORT(TableKernel);
FACET_EXPORT(ImageKernel);
FACET_EXPORT(ComputeKernel);
FACET_EXPORT(PixelsKernel);

std::int64_t ReadTaps(const std::uint32_t* taps, std::size_t count, const std::int32_t* texels,
                      const std::int32_t* pitch) {
  return FACET_DISPATCH(TapsKernel)(taps, count, texels, pitch);
}
std::int64_t ReadTable(const std::int32_t* table, int bits, std::size_t count, int reads) {
  return FACET_DISPATCH(TableKernel)(table, bits, count, reads);
}
std::int64_t ReadImage(const std::int32_t* image, std::size_t pixels, std::size_t width, std::size_t count,
                       float scale) {
  return FACET_DISPATCH(ImageKernel)(image, pixels, width, count, scale);
}
float Compute(const OperationCounts& of_each, std::size_t fragments) {
  return FACET_DISPATCH(ComputeKernel)(of_each, fragments);
}
void WritePixels(float* film, std::size_t pixels) { FACET_DISPATCH(PixelsKernel)(film, pixels); }

}  // namespace facet
#endif
