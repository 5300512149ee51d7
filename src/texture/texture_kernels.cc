#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "texture/texture_kernels.cc"
#include "hwy/foreach_target.h"

#include <algorithm>

#include "facet/shader/dispatch.h"
#include "facet/shader/lane-inl.h"
#include "texture/texture_kernels.h"

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace HWY_NAMESPACE {

template <bool kWide>
HWY_INLINE void StoreRowOf(const StoreRowTask& task) {
  constexpr std::int32_t kWords = kWide ? 2 : 1;  // a texel
  const Float scale(kWide ? 65535.0f : 255.0f), half(0.5f);
  const Int full(kWide ? 65535 : 255);
  const auto lanes = static_cast<std::int32_t>(LaneCount());
  for (std::int32_t x = 0; x < task.width; x += lanes) {
    const auto quantised = [&](const float* plane) HWY_ATTR {
      return plane != nullptr ? TruncateToInt(LoadFloat(plane + x) * scale + half) : full;
    };
    const Int r = quantised(task.planes[0]), g = quantised(task.planes[1]), b = quantised(task.planes[2]),
              a = quantised(task.planes[3]);
    const std::int32_t count = std::min(lanes, task.width - x);
    std::int32_t last[kWords * kMaxLanes];
    std::int32_t* words = count == lanes ? task.words + x * kWords : last;
    if constexpr (kWide) {
      hn::StoreInterleaved2((r | ShiftLeft<16>(g)).raw, (b | ShiftLeft<16>(a)).raw, IntTag(), words);
    } else {
      Store(r | ShiftLeft<8>(g) | ShiftLeft<16>(b) | ShiftLeft<24>(a), words);
    }
    if (words == last) std::copy_n(last, count * kWords, task.words + x * kWords);
  }
  std::copy_n(task.words, kWords, task.words + task.width * kWords);
}

void StoreRow(const StoreRowTask& task) { task.wide ? StoreRowOf<true>(task) : StoreRowOf<false>(task); }

// `kTaps`: texels of a row that lie under one of the next.
template <int kTaps>
HWY_INLINE void HalveRowOf(const HalveRowTask& task) {
  const Float total(static_cast<float>(task.n)), one(1.0f);
  for (std::int32_t i = 0; i < task.m; i += static_cast<std::int32_t>(LaneCount())) {
    Float w[3] = {Float(kTaps == 1 ? 1.0f : 0.5f), Float(0.5f), Float(0.0f)};
    if constexpr (kTaps == 3) {
      const Int column = LaneIndex() + Int(i);
      w[0] = ToFloat(Int(task.m) - column) / total;
      w[1] = Float(static_cast<float>(task.m)) / total;
      w[2] = ToFloat(column + Int(1)) / total;
    }
    Float sum(0.0f);
    for (std::int32_t y = 0; y < task.row_count; ++y) {
      const Float wy(task.weights[y]);
      const float* row = task.rows[y] + 2 * i;
      Float c[3], unused;
      hn::LoadInterleaved2(FloatTag(), row, c[0].raw, c[1].raw);
      if constexpr (kTaps == 3) hn::LoadInterleaved2(FloatTag(), row + 1, unused.raw, c[2].raw);
      for (int x = 0; x < kTaps; ++x) sum += wy * w[x] * c[x];
    }
    Store(Min(sum, one), task.out + i);
  }
}

void HalveRow(const HalveRowTask& task) {
  if (task.n == 1) {
    HalveRowOf<1>(task);
  } else if (task.n == 2 * task.m) {
    HalveRowOf<2>(task);
  } else {
    HalveRowOf<3>(task);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace facet
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace facet {

FACET_EXPORT(StoreRow);
FACET_EXPORT(HalveRow);

void StoreRow(const StoreRowTask& task) { FACET_DISPATCH(StoreRow)(task); }
void HalveRow(const HalveRowTask& task) { FACET_DISPATCH(HalveRow)(task); }

}  // namespace facet
#endif
