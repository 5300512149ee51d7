#include "texture/build_texture.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>
#include <utility>

#include "color/srgb.h"
#include "facet/error.h"
#include "math/elementary.h"
#include "texture/texture_kernels.h"

namespace facet {
namespace {

int Half(int size) { return std::max(size / 2, 1); }

void LayOut(TextureData& texture, int picture_width, int picture_height, bool mips) {
  constexpr int kMaxSize = 1 << (kMaxTextureLevels - 1);
  if (picture_width > kMaxSize || picture_height > kMaxSize ||
      std::size_t(picture_width) * std::size_t(picture_height) > (std::size_t{1} << 27)) {
    throw Error(ErrorCode::OutOfMemory,
                "a texture of " + std::to_string(picture_width) + " x " + std::to_string(picture_height) + " texels", {},
                "the limit is 32768 a side and 2^27 in all");
  }
  int width = picture_width, height = picture_height;
  std::size_t texels = 0;
  for (texture.levels = 0;; width = Half(width), height = Half(height)) {
    const int l = texture.levels++;
    texture.level_offset[l] = static_cast<std::int32_t>(texels);
    texture.level_width[l] = width;
    texture.level_height[l] = height;
    texture.level_pitch[l] = width + 1;
    texels += std::size_t(texture.level_pitch[l]) * std::size_t(height);
    if (!mips || (width == 1 && height == 1)) break;
  }
  texture.words.resize(texels * (texture.wide ? 2 : 1));
}

[[noreturn]] void Refuse(const Image& rows, int height) {
  throw Error(ErrorCode::InvalidInput, "a picture of " + std::to_string(rows.width) + " x " + std::to_string(height) +
                                           " pixels with " + std::to_string(rows.channels) + " channels in " +
                                           std::to_string(rows.bytes.size()) + " bytes");
}

template <int kChannels, class Number, class Color, class Alpha>
void Expand(const Number* p, int width, const Color& color, const Alpha& alpha, float* const* planes) {
  constexpr int kColors = kChannels - (kChannels % 2 == 0 ? 1 : 0);
  for (int x = 0; x < width; ++x, p += kChannels) {
    for (int c = 0; c < kColors; ++c) planes[c][x] = color(p[c]);
    if constexpr (kColors < kChannels) planes[kColors][x] = alpha(p[kColors]);
  }
}

template <class Number, class Color, class Alpha>
void Expand(int channels, const Number* p, int width, const Color& color, const Alpha& alpha, float* const* planes) {
  switch (channels) {
    case 1: return Expand<1>(p, width, color, alpha, planes);
    case 2: return Expand<2>(p, width, color, alpha, planes);
    case 3: return Expand<3>(p, width, color, alpha, planes);
    default: return Expand<4>(p, width, color, alpha, planes);
  }
}

}  // namespace

TextureBuilder::TextureBuilder(const Image& form, int height, TextureRole role, bool mips, TexelBits bits)
    : width_(form.width), channels_(form.channels), type_(form.type) {
  const bool sized = width_ >= 1 && height >= 1 && form.height >= 1 && channels_ >= 1 && channels_ <= 4;
  if (!sized || form.bytes.size() / (std::size_t(channels_) * SizeOf(type_)) != form.PixelCount()) Refuse(form, height);
  texture_.wide = bits == TexelBits::Mixed ? role == TextureRole::Color || type_ != ChannelType::U8
                                           : bits == TexelBits::Sixteen;
  LayOut(texture_, width_, height, mips);
  if (type_ != ChannelType::F32) {
    const int codes = type_ == ChannelType::U8 ? 256 : 65536;
    for (int i = 0; i < codes; ++i) linear_.push_back(static_cast<float>(i) / static_cast<float>(codes - 1));
    color_ = linear_;
    if (role == TextureRole::Color && form.encoding == Encoding::Srgb) {
      std::transform(linear_.begin(), linear_.end(), color_.begin(), SrgbToLinear);
    }
  }
  for (int l = 0; l < texture_.levels; ++l) {
    rows_.emplace_back(3 * std::size_t(channels_) * (std::size_t(texture_.level_width[l]) + kRowSlack));
  }
}

float* TextureBuilder::Plane(int level, int y, int channel) {
  return rows_[std::size_t(level)].data() +
         std::size_t(y % 3 * channels_ + channel) * (std::size_t(texture_.level_width[level]) + kRowSlack);
}

void TextureBuilder::Add(const Image& rows) {
  const std::size_t row_numbers = std::size_t(width_) * std::size_t(channels_);
  if (rows.width != width_ || rows.channels != channels_ || rows.type != type_ ||
      rows.height > texture_.level_height[0] - next_row_ ||
      rows.bytes.size() != row_numbers * std::size_t(rows.height) * SizeOf(type_)) {
    Refuse(rows, rows.height);
  }
  for (int y = 0; y < rows.height; ++y) {
    const std::size_t first = std::size_t(y) * row_numbers;
    float* planes[4];
    for (int c = 0; c < channels_; ++c) planes[c] = Plane(0, next_row_, c);
    const auto color = [this](auto code) { return color_[code]; };
    const auto linear = [this](auto code) { return linear_[code]; };
    const auto clamped = [](float value) { return value > 0.0f ? std::min(value, 1.0f) : 0.0f; };
    switch (type_) {
      case ChannelType::U8:
        Expand(channels_, rows.As<std::uint8_t>() + first, width_, color, linear, planes);
        break;
      case ChannelType::U16:
        Expand(channels_, rows.As<std::uint16_t>() + first, width_, color, linear, planes);
        break;
      case ChannelType::F32:
        Expand(channels_, rows.As<float>() + first, width_, clamped, clamped, planes);
        break;
    }
    FinishRow(0, next_row_++);
  }
}

// Stores a row whose planes are filled, and makes the row of the next level that it completes: of two rows, three where
// a height is odd.
void TextureBuilder::FinishRow(int level, int y) {
  const bool grey = channels_ < 3, alpha = channels_ % 2 == 0;
  StoreRow({{Plane(level, y, 0), Plane(level, y, grey ? 0 : 1), Plane(level, y, grey ? 0 : 2),
             alpha ? Plane(level, y, channels_ - 1) : nullptr},
            texture_.level_width[level],
            texture_.wide,
            texture_.words.data() + texture_.WordOf(level, y)});
  if (level + 1 == texture_.levels) return;
  const int h = texture_.level_height[level], half = Half(h);
  const int taps = h == 1 ? 1 : h == 2 * half ? 2 : 3;
  const int i = (y + 1 - taps) / 2;
  if (y + 1 < taps || 2 * i + taps != y + 1 || i == half) return;
  HalveRowTask task{};
  task.row_count = taps;
  task.n = texture_.level_width[level];
  task.m = texture_.level_width[level + 1];
  const float total = static_cast<float>(h);
  const float weights[3][3] = {
      {1.0f},
      {0.5f, 0.5f},
      {static_cast<float>(half - i) / total, static_cast<float>(half) / total, static_cast<float>(i + 1) / total}};
  std::copy_n(weights[taps - 1], 3, task.weights);
  for (int c = 0; c < channels_; ++c) {
    for (int t = 0; t < taps; ++t) task.rows[t] = Plane(level, 2 * i + t, c);
    task.out = Plane(level + 1, i, c);
    HalveRow(task);
  }
  FinishRow(level + 1, i);
}

TextureData TextureBuilder::Finish() {
  if (next_row_ != texture_.level_height[0]) {
    throw Error(ErrorCode::InvalidInput, "a picture of " + std::to_string(texture_.level_height[0]) +
                                             " rows of which only " + std::to_string(next_row_) + " are there");
  }
  return std::move(texture_);
}

std::size_t TexelCount(int width, int height, bool mips) {
  for (std::size_t texels = 0;; width = Half(width), height = Half(height)) {
    texels += (std::size_t(width) + 1) * std::size_t(height);
    if (!mips || (width == 1 && height == 1)) return texels;
  }
}

TextureData BuildTexture(const Image& image, TextureRole role, bool mips, TexelBits bits) {
  TextureBuilder builder(image, image.height, role, mips, bits);
  builder.Add(image);
  return builder.Finish();
}

void SetTransform(const TextureRef& ref, TextureSlot& slot) {
  const float c = static_cast<float>(Cos(ref.rotation)), s = static_cast<float>(Sin(ref.rotation));
  const float m[6] = {c * ref.scale.x, s * ref.scale.y, ref.offset.x, -s * ref.scale.x, c * ref.scale.y, ref.offset.y};
  std::memcpy(slot.transform, m, sizeof m);
}

}  // namespace facet
