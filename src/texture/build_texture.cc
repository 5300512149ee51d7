#include "texture/build_texture.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>
#include <type_traits>
#include <utility>

#include "color/srgb.h"
#include "facet/error.h"
#include "math/elementary.h"
#include "texture/texture_kernels.h"

namespace facet {
namespace {

int Half(int size) { return std::max(size / 2, 1); }

void LayOut(TextureData& texture, int image_width, int image_height, bool mips) {
  constexpr int kMaxSize = 1 << (kMaxTextureLevels - 1);
  if (image_width > kMaxSize || image_height > kMaxSize ||
      std::size_t(image_width) * std::size_t(image_height) > (std::size_t{1} << 27)) {
    throw Error(ErrorCode::OutOfMemory,
                "a texture of " + std::to_string(image_width) + " x " + std::to_string(image_height) + " texels", {},
                "the limit is 32768 a side and 2^27 texels in all");
  }
  int width = image_width, height = image_height;
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
  texture.bytes.resize(texels * std::size_t(texture.TexelBytes()) + TextureData::kTexelSlack);
  std::fill(texture.bytes.end() - TextureData::kTexelSlack, texture.bytes.end(), std::uint8_t{0});
}

[[noreturn]] void Refuse(const Image& rows, int height) {
  throw Error(ErrorCode::InvalidInput, "a picture of " + std::to_string(rows.width) + " x " + std::to_string(height) +
                                           " pixels with " + std::to_string(rows.channels) + " channels in " +
                                           std::to_string(rows.bytes.size()) + " bytes");
}

}  // namespace

TextureBuilder::TextureBuilder(const Image& form, int height, TextureRole role, bool mips, TexelBits bits, int channels,
                               bool emission)
    : width_(form.width), channels_(form.channels), type_(form.type) {
  const bool sized = width_ >= 1 && height >= 1 && form.height >= 1 && channels_ >= 1 && channels_ <= 4;
  if (!sized || form.bytes.size() / (std::size_t(channels_) * SizeOf(type_)) != form.PixelCount()) Refuse(form, height);
  texture_.is_16_bit =
      bits == TexelBits::Mixed ? role == TextureRole::Color || type_ != ChannelType::U8 : bits == TexelBits::Sixteen;
  ChooseComponents(channels);
  LayOut(texture_, width_, height, mips);
  if (emission) {
    ChooseEmptyCells();
    texture_.sparse = texture_.is_16_bit && texture_.empty_cells.width > 0;
    skip_black_ = texture_.empty_cells.width > 0 && texture_.bytes.size() >= kLargeArray;
    if (skip_black_) PreferSmallPages(texture_.bytes.data(), texture_.bytes.size());
  }
  if (type_ != ChannelType::F32) {
    const int codes = type_ == ChannelType::U8 ? 256 : 65536;
    for (int i = 0; i < codes; ++i) linear_.push_back(static_cast<float>(i) / static_cast<float>(codes - 1));
    color_ = linear_;
    gamma_ = role == TextureRole::Color && form.encoding == Encoding::Srgb;
    if (gamma_) {
      std::transform(linear_.begin(), linear_.end(), color_.begin(), SrgbToLinear);
    }
  }
  for (int l = 0; l < texture_.levels; ++l) {
    rows_.emplace_back(3 * std::size_t(texture_.components) * (std::size_t(texture_.level_width[l]) + kRowSlack));
  }
}

// Decides which channels of the image are stored, and as which component of a texel.
void TextureBuilder::ChooseComponents(int channels) {
  const bool grey = channels_ < 3, has_alpha = channels_ % 2 == 0;
  int component_of_channel[4] = {-1, -1, -1, -1};  // by channel of the image
  for (int c = 0; c < 4; ++c) {
    if ((channels >> c & 1) == 0 || (c == 3 && !has_alpha)) continue;
    const int from = c == 3 ? channels_ - 1 : grey ? 0 : c;
    if (component_of_channel[from] < 0) {
      channel_of_[texture_.components] = from;
      component_of_channel[from] = texture_.components++;
    }
    texture_.component_of[c] = component_of_channel[from];
  }
  if (texture_.components == 0) channel_of_[texture_.components++] = 0;  // only alpha is read, and there is none
  const int size = texture_.is_16_bit ? 2 : 1;
  for (int i = 0; i < 16; ++i) {
    const int component = texture_.component_of[i / 4], texel = i / 2 % 2, byte = i % 2;
    texture_.pair_bytes[i] = component < 0 || byte >= size
                                 ? TextureData::kNoByte
                                 : static_cast<std::uint8_t>((texel * texture_.components + component) * size + byte);
  }
}

float* TextureBuilder::Plane(int level, int y, int component) {
  return rows_[std::size_t(level)].data() +
         std::size_t(y % 3 * texture_.components + component) * (std::size_t(texture_.level_width[level]) + kRowSlack);
}

void TextureBuilder::Add(const Image& rows) {
  const std::size_t row_components = std::size_t(width_) * std::size_t(channels_);
  if (rows.width != width_ || rows.channels != channels_ || rows.type != type_ ||
      rows.height > texture_.level_height[0] - next_row_ ||
      rows.bytes.size() != row_components * std::size_t(rows.height) * SizeOf(type_)) {
    Refuse(rows, rows.height);
  }
  for (int y = 0; y < rows.height; ++y) {
    const std::size_t first = std::size_t(y) * row_components;
    switch (type_) {
      case ChannelType::U8: Expand(rows.As<std::uint8_t>() + first); break;
      case ChannelType::U16: Expand(rows.As<std::uint16_t>() + first); break;
      case ChannelType::F32: Expand(rows.As<float>() + first); break;
    }
    FinishRow(0, next_row_++);
  }
}

// Writes the stored channels of an image's row, in linear light, to the planes of level 0.
void TextureBuilder::Expand(const std::uint8_t* row) {
  ExpandRowTask task{row, channels_, texture_.components, {}, {}, {}, width_};
  for (int k = 0; k < texture_.components; ++k) {
    task.channel[k] = channel_of_[k];
    task.light[k] = IsAlpha(k) || !gamma_ ? nullptr : color_.data();
    task.planes[k] = Plane(0, next_row_, k);
  }
  ExpandRow(task);
}

template <class Component>
void TextureBuilder::Expand(const Component* row) {
  for (int k = 0; k < texture_.components; ++k) {
    const float* const light = (IsAlpha(k) ? linear_ : color_).data();
    float* const plane = Plane(0, next_row_, k);
    const Component* code = row + channel_of_[k];
    for (int x = 0; x < width_; ++x, code += channels_) {
      if constexpr (std::is_same_v<Component, float>) {
        plane[x] = *code > 0.0f ? std::min(*code, 1.0f) : 0.0f;
      } else {
        plane[x] = light[*code];
      }
    }
  }
}

// Stores a row whose planes are filled. If it is the last of the two rows (three where the height is odd) that a row of
// the next level is made from, that row is made as well, and so on down to the smallest level.
void TextureBuilder::FinishRow(int level, int y) {
  StoreRowTask store{{},
                     texture_.components,
                     texture_.level_width[level],
                     texture_.is_16_bit,
                     texture_.sparse,
                     skip_black_,
                     texture_.bytes.data() + texture_.ByteOf(level, y)};
  for (int k = 0; k < texture_.components; ++k) store.planes[k] = Plane(level, y, k);
  StoreRow(store);
  if (level == cell_level_) FindOccupiedCells(y);
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
  for (int k = 0; k < texture_.components; ++k) {
    for (int t = 0; t < taps; ++t) task.rows[t] = Plane(level, 2 * i + t, k);
    task.out = Plane(level + 1, i, k);
    HalveRow(task);
  }
  FinishRow(level + 1, i);
}

// Chooses the level whose texels are the cells. A texel is 0 only if all texels of level 0 that it is the mean of are
// 0, so a cell of 0 is a black area of the texture.
void TextureBuilder::ChooseEmptyCells() {
  constexpr int kMost = EmptyCells::kMaxSide;
  const auto fits = [&](int l) { return texture_.level_width[l] <= kMost && texture_.level_height[l] <= kMost; };
  for (cell_level_ = 0; cell_level_ < texture_.levels && !fits(cell_level_);) ++cell_level_;
  if (cell_level_ == texture_.levels) return;
  const int width = texture_.level_width[cell_level_], height = texture_.level_height[cell_level_];
  // A little less than one cell, so that the rounding of texture coordinates cannot reach beyond a neighbouring cell.
  const float reach = 0.9f * std::min(static_cast<float>(texture_.level_width[0]) / static_cast<float>(width),
                                      static_cast<float>(texture_.level_height[0]) / static_cast<float>(height));
  if (reach < 3.0f) return;  // samples read farther than that, so no texel could be skipped
  texture_.empty_cells = {width, height, reach, std::vector<std::int32_t>(std::size_t(width) * std::size_t(height), 0)};
}

void TextureBuilder::FindOccupiedCells(int y) {
  EmptyCells& empty_cells = texture_.empty_cells;
  for (int x = 0; x < empty_cells.width; ++x) {
    bool lit = false;
    for (int k = 0; k < texture_.components; ++k) lit = lit || Plane(cell_level_, y, k)[x] > 0.0f;
    for (int n = 0; lit && n < 9; ++n) {
      const int row = (y + n / 3 + empty_cells.height - 1) % empty_cells.height,
                column = (x + n % 3 + empty_cells.width - 1) % empty_cells.width;
      empty_cells.occupied[std::size_t(row * empty_cells.width + column)] = 1;
    }
  }
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

TextureData BuildTexture(const Image& image, TextureRole role, bool mips, TexelBits bits, int channels, bool emission) {
  TextureBuilder builder(image, image.height, role, mips, bits, channels, emission);
  builder.Add(image);
  return builder.Finish();
}

void SetTransform(const TextureRef& ref, BoundTexture& texture) {
  const float c = static_cast<float>(Cos(ref.rotation)), s = static_cast<float>(Sin(ref.rotation));
  const float m[6] = {c * ref.scale.x, s * ref.scale.y, ref.offset.x, -s * ref.scale.x, c * ref.scale.y, ref.offset.y};
  std::memcpy(texture.transform, m, sizeof m);
}

}  // namespace facet
