#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>

#include "base/parallel.h"
#include "color/srgb.h"
#include "facet/error.h"
#include "math/elementary.h"
#include "texture/texture.h"

namespace facet {
namespace {

struct Rgba {
  float r, g, b, a;
};

// A picture's texels as linear numbers in [0, 1], row by row.
class TexelReader {
 public:
  TexelReader(const Image& image, TextureRole role) : image_(image) {
    const bool srgb = role == TextureRole::Color && image.encoding == Encoding::Srgb && image.type != ChannelType::F32;
    if (image.type == ChannelType::U8) {
      for (int i = 0; i < 256; ++i)
        color8_[i] = srgb ? SrgbToLinear(static_cast<float>(i) / 255.0f) : static_cast<float>(i) / 255.0f;
    } else if (image.type == ChannelType::U16 && srgb) {
      color16_.resize(65536);
      for (int i = 0; i < 65536; ++i) color16_[std::size_t(i)] = SrgbToLinear(static_cast<float>(i) / 65535.0f);
    }
  }

  void Row(int y, Rgba* out) const {
    const std::size_t first = std::size_t(y) * std::size_t(image_.width) * std::size_t(image_.channels);
    switch (image_.type) {
      case ChannelType::U8: {
        const std::uint8_t* p = image_.As<std::uint8_t>() + first;
        Expand(
            out, [&](int i) { return color8_[p[i]]; }, [&](int i) { return static_cast<float>(p[i]) / 255.0f; });
        break;
      }
      case ChannelType::U16: {
        const std::uint16_t* p = image_.As<std::uint16_t>() + first;
        const auto data = [&](int i) { return static_cast<float>(p[i]) / 65535.0f; };
        if (color16_.empty())
          Expand(out, data, data);
        else
          Expand(
              out, [&](int i) { return color16_[p[i]]; }, data);
        break;
      }
      case ChannelType::F32: {
        const float* p = image_.As<float>() + first;
        const auto data = [&](int i) { return p[i] > 0.0f ? std::min(p[i], 1.0f) : 0.0f; };
        Expand(out, data, data);
        break;
      }
    }
  }

 private:
  template <class Color, class Alpha>
  void Expand(Rgba* out, const Color& color, const Alpha& alpha) const {
    const int n = image_.width, c = image_.channels;
    if (c == 1)
      for (int x = 0; x < n; ++x) {
        const float v = color(x);
        out[x] = {v, v, v, 1.0f};
      }
    if (c == 2)
      for (int x = 0; x < n; ++x) {
        const float v = color(2 * x);
        out[x] = {v, v, v, alpha(2 * x + 1)};
      }
    if (c == 3)
      for (int x = 0; x < n; ++x) out[x] = {color(3 * x), color(3 * x + 1), color(3 * x + 2), 1.0f};
    if (c == 4) {
      for (int x = 0; x < n; ++x) out[x] = {color(4 * x), color(4 * x + 1), color(4 * x + 2), alpha(4 * x + 3)};
    }
  }

  const Image& image_;
  float color8_[256];
  std::vector<float> color16_;
};

std::int32_t Quantize(float value, float scale) { return static_cast<std::int32_t>(value * scale + 0.5f); }

void StoreRow(TextureData& texture, int level, int y, const Rgba* row) {
  const int width = texture.level_width[level];
  const std::size_t base = std::size_t(texture.level_offset[level]) +
                           std::size_t(y / 4) * std::size_t(texture.level_pitch[level]) * 16 + std::size_t(y % 4) * 4;
  for (int x = 0; x < width; ++x) {
    const std::size_t texel = base + std::size_t(x / 4) * 16 + std::size_t(x % 4);
    const Rgba& c = row[x];
    if (texture.wide) {
      texture.words[2 * texel] = Quantize(c.r, 65535.0f) |
                                 static_cast<std::int32_t>(static_cast<std::uint32_t>(Quantize(c.g, 65535.0f)) << 16);
      texture.words[2 * texel + 1] =
          Quantize(c.b, 65535.0f) |
          static_cast<std::int32_t>(static_cast<std::uint32_t>(Quantize(c.a, 65535.0f)) << 16);
    } else {
      texture.words[texel] = Quantize(c.r, 255.0f) | Quantize(c.g, 255.0f) << 8 | Quantize(c.b, 255.0f) << 16 |
                             static_cast<std::int32_t>(static_cast<std::uint32_t>(Quantize(c.a, 255.0f)) << 24);
    }
  }
}

// How much of the three texels from 2 * i onwards lies under texel i of the next level: its area is
// [i * n / m, (i + 1) * n / m] with n = 2 m or 2 m + 1 texels becoming m (Guthe and Heckbert 2005, "Non-power-of-two
// mipmapping": a polyphase box). Where n is even that is two halves.
struct BoxWeights {
  float w[3];
};
BoxWeights WeightsOf(int i, int n, int m) {
  if (n == 1) return {{1.0f, 0.0f, 0.0f}};
  if (n == 2 * m) return {{0.5f, 0.5f, 0.0f}};
  const float total = static_cast<float>(n);
  return {{static_cast<float>(m - i) / total, static_cast<float>(m) / total, static_cast<float>(i + 1) / total}};
}

// One row of the next level from up to three rows above it, already weighted by the caller.
void HalveRow(const Rgba* const rows[3], const BoxWeights& wy, int n, int m, Rgba* out) {
  const int taps_y = wy.w[2] != 0.0f ? 3 : wy.w[1] != 0.0f ? 2 : 1;
  for (int i = 0; i < m; ++i) {
    const BoxWeights wx = WeightsOf(i, n, m);
    const int taps_x = wx.w[2] != 0.0f ? 3 : wx.w[1] != 0.0f ? 2 : 1;
    Rgba sum{0, 0, 0, 0};
    for (int ty = 0; ty < taps_y; ++ty) {
      for (int tx = 0; tx < taps_x; ++tx) {
        const Rgba& c = rows[ty][2 * i + tx];
        const float w = wy.w[ty] * wx.w[tx];
        sum = {sum.r + w * c.r, sum.g + w * c.g, sum.b + w * c.b, sum.a + w * c.a};
      }
    }
    out[i] = {std::min(sum.r, 1.0f), std::min(sum.g, 1.0f), std::min(sum.b, 1.0f), std::min(sum.a, 1.0f)};
  }
}

int Half(int size) { return std::max(size / 2, 1); }

void LayOut(TextureData& texture, const Image& image, bool mips) {
  constexpr int kMaxSize = 1 << (kMaxTextureLevels - 1);
  if (image.width > kMaxSize || image.height > kMaxSize || image.PixelCount() > (std::size_t{1} << 27)) {
    throw Error(ErrorCode::OutOfMemory,
                "a texture of " + std::to_string(image.width) + " x " + std::to_string(image.height) + " texels", {},
                "the limit is 32768 a side and 2^27 in all");
  }
  int width = image.width, height = image.height;
  std::size_t texels = 0;
  for (texture.levels = 0;; width = Half(width), height = Half(height)) {
    const int l = texture.levels++;
    texture.level_offset[l] = static_cast<std::int32_t>(texels);
    texture.level_width[l] = width;
    texture.level_height[l] = height;
    texture.level_pitch[l] = (width + 3) / 4;
    texels += std::size_t(texture.level_pitch[l]) * std::size_t((height + 3) / 4) * 16;
    if (!mips || (width == 1 && height == 1)) break;
  }
  texture.words.resize(texels * (texture.wide ? 2 : 1));
}

}  // namespace

TextureData BuildTexture(const Image& image, TextureRole role, bool mips, TexelBits bits) {
  const bool sized = image.width >= 1 && image.height >= 1 && image.channels >= 1 && image.channels <= 4;
  if (!sized || image.bytes.size() / image.PixelCount() != std::size_t(image.channels) * SizeOf(image.type)) {
    throw Error(ErrorCode::InvalidInput,
                "a picture of " + std::to_string(image.width) + " x " + std::to_string(image.height) + " pixels with " +
                    std::to_string(image.channels) + " channels in " + std::to_string(image.bytes.size()) + " bytes");
  }
  TextureData texture;
  texture.wide = bits == TexelBits::Mixed ? role == TextureRole::Color || image.type != ChannelType::U8
                                          : bits == TexelBits::Sixteen;
  LayOut(texture, image, mips);
  const TexelReader reader(image, role);

  // Level 0 is stored, and reduced to level 1, in one pass over the file's rows; two rows make one of level 1 (three at
  // odd heights).
  const int n = image.width, nh = image.height, m = Half(n), mh = Half(nh);
  std::vector<Rgba> above;
  if (texture.levels > 1) above.resize(std::size_t(m) * std::size_t(mh));
  constexpr std::size_t kRows = 16;  // of level 1
  ParallelFor(std::size_t(mh), kRows, [&](std::size_t begin, std::size_t end) {
    std::vector<Rgba> buffer(std::size_t(n) * 3);
    const Rgba* const rows[3] = {buffer.data(), buffer.data() + n, buffer.data() + 2 * std::size_t(n)};
    for (std::size_t i = begin; i < end; ++i) {
      const int taps = nh == 1 ? 1 : nh == 2 * mh ? 2 : 3;
      for (int t = 0; t < taps; ++t)
        reader.Row(static_cast<int>(2 * i) + t, buffer.data() + std::size_t(t) * std::size_t(n));
      const int own =
          static_cast<int>(i) + 1 == mh ? taps : std::min(taps, 2);  // the third row is the next one's first
      for (int t = 0; t < own; ++t) StoreRow(texture, 0, static_cast<int>(2 * i) + t, rows[t]);
      if (above.empty()) continue;
      Rgba* out = above.data() + i * std::size_t(m);
      HalveRow(rows, WeightsOf(static_cast<int>(i), nh, mh), n, m, out);
      StoreRow(texture, 1, static_cast<int>(i), out);
    }
  });

  for (int level = 2; level < texture.levels; ++level) {
    const int pn = texture.level_width[level - 1], ph = texture.level_height[level - 1];
    const int w = texture.level_width[level], h = texture.level_height[level];
    std::vector<Rgba> next(std::size_t(w) * std::size_t(h));
    for (int i = 0; i < h; ++i) {
      const auto row = [&](int y) { return above.data() + std::size_t(std::min(y, ph - 1)) * std::size_t(pn); };
      const Rgba* const rows[3] = {row(2 * i), row(2 * i + 1), row(2 * i + 2)};
      HalveRow(rows, WeightsOf(i, ph, h), pn, w, next.data() + std::size_t(i) * std::size_t(w));
      StoreRow(texture, level, i, next.data() + std::size_t(i) * std::size_t(w));
    }
    above.swap(next);
  }
  return texture;
}

void SetTransform(const TextureRef& ref, TextureSlot& slot) {
  const float c = static_cast<float>(Cos(ref.rotation)), s = static_cast<float>(Sin(ref.rotation));
  const float m[6] = {c * ref.scale.x, s * ref.scale.y, ref.offset.x, -s * ref.scale.x, c * ref.scale.y, ref.offset.y};
  std::memcpy(slot.transform, m, sizeof m);
}

}  // namespace facet
