#include "film/encode_pixels.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "film/encode_pixels.cc"
#include "hwy/foreach_target.h"

#include "color/grading-inl.h"
#include "color/gt7_curve-inl.h"
#include "color/tone_curve-inl.h"
#include "color/transfer-inl.h"
#include "facet/shader/dispatch.h"
#include "facet/shader/lane-inl.h"
#include "facet/shader/vec-inl.h"

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace HWY_NAMESPACE {

// Curves that few ask for are not inlined, nor is grading: the kernel would compile for minutes.
HWY_NOINLINE Vec3<Float> ApplyRareToneMap(ToneMap tone_map, Vec3<Float> light) {
  switch (tone_map) {
    case ToneMap::Filmic: return FilmicCurve(light);
    case ToneMap::Generic: return GenericCurve(light);
    case ToneMap::Gt7: return Gt7Curve(light);
    case ToneMap::AgXGolden: return AgXCurve(light, kAgXGolden);
    default: return AgXCurve(light, kAgXPunchy);
  }
}
HWY_NOINLINE Vec3<Float> ApplyGrading(const GradingFactors& grading, Vec3<Float> light) {
  return Grade(grading, light);
}

FACET_INLINE Vec3<Float> ApplyToneMap(ToneMap tone_map, Vec3<Float> light) {
  switch (tone_map) {
    case ToneMap::Reinhard: return ReinhardCurve(light);
    case ToneMap::Aces: return AcesCurve(light);
    case ToneMap::AgX: return AgXCurve(light);
    case ToneMap::Neutral: return NeutralCurve(light);
    default: return ClampCurve(light);
  }
}

// Straight (not premultiplied), exposed light; alpha in [0, 1]. Pixels that are not finite are empty.
FACET_INLINE Vec4<Float> ExposedLight(const EncodeTask& task, const float* pixels) {
  Float r, g, b, a;
  hn::LoadInterleaved4(FloatTag(), pixels, r.raw, g.raw, b.raw, a.raw);
  const Vec4<Float> p{r, g, b, a};
  const Float zero(0.0f);
  const Mask seen = IsFinite(p.x) & IsFinite(p.y) & IsFinite(p.z) & IsFinite(p.w) & (p.w > zero);
  const Float alpha = Select(seen, Min(p.w, Float(1.0f)), zero);
  const Float divisor = Select(seen, p.w, Float(1.0f));
  const Float exposure(task.exposure);
  Vec3<Float> straight = Xyz(p);
  if (!All(divisor == Float(1.0f))) straight = straight / divisor;
  const auto expose = [&](Float c) HWY_ATTR { return Select(seen, c * exposure, zero); };
  return {expose(straight.x), expose(straight.y), expose(straight.z), alpha};
}

// LaneCount() pixels.
struct Packet {
  const float* pixels;
  const float* through;  // may be null
};

// Whether a task needs more than a curve that many ask for and a background behind all channels alike. Others have a
// kernel of their own.
bool IsRare(const EncodeTask& task) {
  return !task.grading.ChangesNothing() || task.transfer != Transfer::Srgb || task.tone_map > ToneMap::Neutral || task.through != nullptr;
}

// Composites light over the background. Behind an empty pixel a background of exactly 1 stays exactly 1.
template <bool kIsRare>
FACET_INLINE Vec3<Float> InFront(const EncodeTask& task, const Packet& packet, Vec3<Float> light, Float alpha) {
  const Float one(1.0f), by_alpha = one - alpha;
  Vec3<Float> through{by_alpha, by_alpha, by_alpha};
  if (kIsRare && packet.through != nullptr) {
    Float r, g, b;
    hn::LoadInterleaved3(FloatTag(), packet.through, r.raw, g.raw, b.raw);
    through =
        Select<Float>(alpha > Float(0.0f), Clamp(Vec3<Float>{r, g, b}, Float(0.0f), one), Vec3<Float>{one, one, one});
  }
  const auto& back = task.background_linear;
  return {light.x * alpha + Float(back[0]) * through.x, light.y * alpha + Float(back[1]) * through.y,
          light.z * alpha + Float(back[2]) * through.z};
}

struct Codes {
  Int r, g, b, a;
};

// `kIsRare`: IsRare(task).
template <bool kIsRare>
FACET_INLINE Codes EncodeCodes(const EncodeTask& task, const Packet& packet) {
  const Vec4<Float> light = ExposedLight(task, packet.pixels);
  Vec3<Float> shown = Xyz(light);
  if (kIsRare && !task.grading.ChangesNothing()) shown = ApplyGrading(task.grading, shown);
  shown = kIsRare && task.tone_map > ToneMap::Neutral ? ApplyRareToneMap(task.tone_map, shown)
                                                      : ApplyToneMap(task.tone_map, shown);
  if (task.opaque) shown = InFront<kIsRare>(task, packet, shown, light.w);
  if (kIsRare && task.transfer == Transfer::Gamma) {
    // The light whose sRGB code is that of the power.
    const auto as_srgb = [](Float c) HWY_ATTR {
      return SrgbToLinear(Pow(Clamp(c, Float(0.0f), Float(1.0f)), Float(1.0f / 2.2f)));
    };
    shown = {as_srgb(shown.x), as_srgb(shown.y), as_srgb(shown.z)};
  }
  const Float largest(task.type == ChannelType::U8 ? 255.0f : 65535.0f);
  // Wholly transparent pixels have no colour.
  const Mask colored = task.opaque ? light.w == light.w : light.w > Float(0.0f);
  const auto encode = [&](Float c) HWY_ATTR {
    return Select(colored,
                  task.type == ChannelType::U8 ? NearestSrgb8(c, *task.tables) : NearestSrgb16(c, task.thresholds16),
                  Int(0));
  };
  return {encode(shown.x), encode(shown.y), encode(shown.z), TruncateToInt(light.w * largest + Float(0.5f))};
}

// Stores LaneCount() pixels of four or three bytes; `room` pixels may be written.
FACET_INLINE void StoreBytes(const Codes& codes, bool opaque, std::size_t room, std::byte* out) {
  static_assert(std::endian::native == std::endian::little, "the packing below puts red first");
  const Int packed = codes.r | ShiftLeft<8>(codes.g) | ShiftLeft<16>(codes.b) | ShiftLeft<24>(codes.a);
  std::int32_t pixels[kMaxLanes];
  Store(packed, pixels);
  const std::size_t count = std::min(LaneCount(), room);
  if (!opaque) {
    std::memcpy(out, pixels, 4 * count);
    return;
  }
  // Four bytes at a time, the last of which the next pixel overwrites.
  for (std::size_t i = 0; i + 1 < count; ++i) std::memcpy(out + 3 * i, &pixels[i], 4);
  std::memcpy(out + 3 * (count - 1), &pixels[count - 1], 3);
}

template <class Number, class Value>
FACET_INLINE void StoreEach(const Value (&values)[4][kMaxLanes], bool opaque, std::size_t room, std::byte* out) {
  const std::size_t channels = opaque ? 3 : 4;
  const std::size_t count = std::min(LaneCount(), room);
  Number packed[4 * kMaxLanes];
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t channel = 0; channel < channels; ++channel) {
      packed[channels * i + channel] = static_cast<Number>(values[channel][i]);
    }
  }
  std::memcpy(out, packed, count * channels * sizeof(Number));
}

FACET_INLINE void StoreWords(const Codes& codes, bool opaque, std::size_t room, std::byte* out) {
  std::int32_t values[4][kMaxLanes];
  Store(codes.r, values[0]);
  Store(codes.g, values[1]);
  Store(codes.b, values[2]);
  Store(codes.a, values[3]);
  StoreEach<std::uint16_t>(values, opaque, room, out);
}

template <bool kIsRare>
FACET_INLINE void EncodeLinear(const EncodeTask& task, const Packet& packet, std::size_t room, std::byte* out) {
  const Vec4<Float> light = ExposedLight(task, packet.pixels);
  constexpr float kMax = std::numeric_limits<float>::max();
  Vec3<Float> shown = Clamp(Xyz(light), Float(-kMax), Float(kMax));
  if (task.opaque) shown = Clamp(InFront<kIsRare>(task, packet, shown, light.w), Float(-kMax), Float(kMax));
  if (!task.opaque && room >= LaneCount()) {
    // The image's bytes come from operator new, which aligns them for float.
    hn::StoreInterleaved4(shown.x.raw, shown.y.raw, shown.z.raw, light.w.raw, FloatTag(),
                          reinterpret_cast<float*>(out));
    return;
  }
  float values[4][kMaxLanes];
  Store(shown.x, values[0]);
  Store(shown.y, values[1]);
  Store(shown.z, values[2]);
  Store(light.w, values[3]);
  StoreEach<float>(values, task.opaque, room, out);
}

// Pixels, of which `room` may be written.
template <bool kIsRare>
FACET_INLINE void EncodePacket(const EncodeTask& task, const Packet& packet, std::size_t room, std::byte* out) {
  switch (task.type) {
    case ChannelType::U8: return StoreBytes(EncodeCodes<kIsRare>(task, packet), task.opaque, room, out);
    case ChannelType::U16: return StoreWords(EncodeCodes<kIsRare>(task, packet), task.opaque, room, out);
    case ChannelType::F32: return EncodeLinear<kIsRare>(task, packet, room, out);
  }
}

// True if all components of the packet are zero, as often in images without a background.
FACET_INLINE bool IsEmpty(const float* pixels) {
  Int bits(0);
  for (std::size_t i = 0; i < 4; ++i) bits = bits | BitsOf(LoadFloat(pixels + i * LaneCount()));
  return All(bits == Int(0));
}

template <bool kIsRare>
void EncodeRows(const EncodeTask& task) {
  const std::size_t lanes = LaneCount(), pixel_size = task.PixelBytes();
  alignas(64) std::byte empty[4 * kMaxLanes * sizeof(float)];  // a packet of empty pixels
  const float zeros[4 * kMaxLanes] = {};
  EncodePacket<kIsRare>(task, {zeros, nullptr}, lanes, empty);
  for (std::size_t y = 0; y < task.rows; ++y) {
    for (std::size_t x = 0; x < task.count; x += lanes) {
      const std::size_t count = std::min(lanes, task.count - x);
      const std::size_t first = y * task.pixel_stride + x;
      Packet packet{task.pixels + 4 * first, kIsRare && task.through != nullptr ? task.through + 3 * first : nullptr};
      float padded[4 * kMaxLanes], padded_through[3 * kMaxLanes];
      if (count < lanes) {
        std::fill(std::begin(padded), std::end(padded), 0.0f);
        std::copy_n(packet.pixels, 4 * count, padded);
        packet.pixels = padded;
        if (kIsRare && packet.through != nullptr) {
          std::fill(std::begin(padded_through), std::end(padded_through), 0.0f);
          std::copy_n(packet.through, 3 * count, padded_through);
          packet.through = padded_through;
        }
      }
      std::byte* out = task.out + (y * task.out_stride + x) * pixel_size;
      if (IsEmpty(packet.pixels)) {
        std::memcpy(out, empty, count * pixel_size);
      } else {
        EncodePacket<kIsRare>(task, packet, count, out);
      }
    }
  }
}

void EncodePixels(const EncodeTask& task) { IsRare(task) ? EncodeRows<true>(task) : EncodeRows<false>(task); }

}  // namespace HWY_NAMESPACE
}  // namespace facet
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace facet {

FACET_EXPORT(EncodePixels);
void EncodePixels(const EncodeTask& task) { FACET_DISPATCH(EncodePixels)(task); }

}  // namespace facet
#endif
