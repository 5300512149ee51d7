#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "texture/texture_kernels.cc"
#include "hwy/foreach_target.h"

#include <algorithm>
#include <cstring>

#include "facet/shader/dispatch.h"
#include "facet/shader/lane-inl.h"
#include "texture/texture_kernels.h"

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace HWY_NAMESPACE {

// Loads the codes of one vector of pixels, and splits them into one vector per channel.
template <int kChannels, class D>
FACET_INLINE void LoadPixels(D d, const std::uint8_t* p, hn::Vec<D>* v) {
  if constexpr (kChannels == 1) {
    v[0] = hn::LoadU(d, p);
  } else if constexpr (kChannels == 2) {
    hn::LoadInterleaved2(d, p, v[0], v[1]);
  } else if constexpr (kChannels == 3) {
    hn::LoadInterleaved3(d, p, v[0], v[1], v[2]);
  } else {
    hn::LoadInterleaved4(d, p, v[0], v[1], v[2], v[3]);
  }
}

// Equal to code / 255 for all codes from 0 to 255, without a division: 1 / 255 is (257 + 1 / 255) / 65536, and the
// product with 257 / 65536 is exact, so only the sum is rounded.
FACET_INLINE Float DividedBy255(Int code) {
  const Float c = ToFloat(code);
  return c * Float(257.0f / 65536.0f) + c * Float(1.0f / (255.0f * 65536.0f));
}

template <int kChannels>
FACET_INLINE void ExpandRowOf(const ExpandRowTask& task) {
  const hn::Rebind<std::uint8_t, IntTag> d;
  const std::size_t lanes = LaneCount(), width = std::size_t(task.width);
  for (std::size_t x = 0; x < width; x += lanes) {
    const std::uint8_t* p = task.row + x * kChannels;
    std::uint8_t last[4 * kMaxLanes] = {};
    if (x + lanes > width) std::copy(p, task.row + width * kChannels, last), p = last;
    hn::Vec<decltype(d)> pixels[kChannels];
    LoadPixels<kChannels>(d, p, pixels);
    for (int k = 0; k < task.kept; ++k) {
      const Int code = hn::PromoteTo(IntTag(), pixels[task.channel[k]]);
      const float* light = task.light[k];
      Store(light == nullptr      ? DividedBy255(code)
            : All(code == Int(0)) ? Float(light[0])  // common in emission textures; saves the gather
                                  : Gather(light, code),
            task.planes[k] + x);
    }
  }
}

void ExpandRow(const ExpandRowTask& task) {
  switch (task.channels) {
    case 1: return ExpandRowOf<1>(task);
    case 2: return ExpandRowOf<2>(task);
    case 3: return ExpandRowOf<3>(task);
    default: return ExpandRowOf<4>(task);
  }
}

// Stores one vector of texels: their components, one vector each, are interleaved.
template <int kComponents, class D, class V>
FACET_INLINE void StoreTexels(D d, const V* v, hn::TFromD<D>* out) {
  if constexpr (kComponents == 1) {
    hn::StoreU(v[0], d, out);
  } else if constexpr (kComponents == 2) {
    hn::StoreInterleaved2(v[0], v[1], d, out);
  } else if constexpr (kComponents == 3) {
    hn::StoreInterleaved3(v[0], v[1], v[2], d, out);
  } else {
    hn::StoreInterleaved4(v[0], v[1], v[2], v[3], d, out);
  }
}

template <int kComponents, class Component>
FACET_INLINE void StoreRowOf(const StoreRowTask& task) {
  constexpr bool kIs16Bit = sizeof(Component) == 2;
  constexpr std::size_t kTexel = kComponents * sizeof(Component);
  const hn::Rebind<Component, IntTag> d;
  const Float scale(kIs16Bit ? 65535.0f : 255.0f), half(0.5f);
  const Int sign(kIs16Bit && !task.sparse ? 0x8000 : 0);
  const std::size_t lanes = LaneCount(), width = std::size_t(task.width);
  Component first[kComponents * kMaxLanes];
  for (std::size_t x = 0; x < width; x += lanes) {
    hn::Vec<decltype(d)> components[kComponents];
    Int any(0);
    for (int k = 0; k < kComponents; ++k) {
      const Int code = TruncateToInt(LoadFloat(task.planes[k] + x) * scale + half);
      components[k] = hn::DemoteTo(d, (code ^ sign).raw);
      any = any | code;
    }
    if (x == 0) StoreTexels<kComponents>(d, components, first);
    if (task.skip_black && All(any == Int(0))) continue;
    std::uint8_t* out = task.bytes + x * kTexel;
    if (x + lanes <= width) {  // rows begin at a whole texel, so 16-bit components are aligned
      StoreTexels<kComponents>(d, components, reinterpret_cast<Component*>(out));
    } else {
      Component texels[kComponents * kMaxLanes];
      StoreTexels<kComponents>(d, components, texels);
      std::memcpy(out, texels, (width - x) * kTexel);
    }
  }
  if (task.skip_black && std::all_of(first, first + kComponents, [](Component n) { return n == 0; })) return;
  std::memcpy(task.bytes + width * kTexel, first, kTexel);
}

template <class Component>
FACET_INLINE void StoreRowOf(const StoreRowTask& task) {
  switch (task.components) {
    case 1: return StoreRowOf<1, Component>(task);
    case 2: return StoreRowOf<2, Component>(task);
    case 3: return StoreRowOf<3, Component>(task);
    default: return StoreRowOf<4, Component>(task);
  }
}

void StoreRow(const StoreRowTask& task) {
  task.is_16_bit ? StoreRowOf<std::uint16_t>(task) : StoreRowOf<std::uint8_t>(task);
}

// `kTaps`: how many texels of a row contribute to one texel of the next level.
template <int kTaps>
FACET_INLINE void HalveRowOf(const HalveRowTask& task) {
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

FACET_EXPORT(ExpandRow);
FACET_EXPORT(StoreRow);
FACET_EXPORT(HalveRow);

void ExpandRow(const ExpandRowTask& task) { FACET_DISPATCH(ExpandRow)(task); }
void StoreRow(const StoreRowTask& task) { FACET_DISPATCH(StoreRow)(task); }
void HalveRow(const HalveRowTask& task) { FACET_DISPATCH(HalveRow)(task); }

}  // namespace facet
#endif
