#include "reference/texture_exact.h"

#include <algorithm>
#include <cmath>

#include "image/convert.h"
#include "math/elementary.h"

namespace facet {
namespace {

// IEC 61966-2-1:1999.
double DecodeSrgb(double encoded) { return encoded <= 0.04045 ? encoded / 12.92 : Pow((encoded + 0.055) / 1.055, 2.4); }

// The two texels around a position on one axis, and how far it lies towards the second.
struct AxisTexels {
  int first, second;
  double fraction;
};

AxisTexels FindTexels(double position, Wrap wrap, Filter filter, int size) {
  if (!std::isfinite(position)) position = 0.0;
  switch (wrap) {
    case Wrap::Repeat: position -= std::floor(position); break;
    case Wrap::MirroredRepeat:
      position -= 2.0 * std::floor(0.5 * position);
      if (position > 1.0) position = 2.0 - position;
      break;
    case Wrap::ClampToEdge: position = std::clamp(position, 0.0, 1.0); break;
  }
  const double texel = position * size - (filter == Filter::Linear ? 0.5 : 0.0);
  const int whole = int(std::floor(texel));
  const auto inside = [&](int i) { return wrap == Wrap::Repeat ? (i + size) % size : std::clamp(i, 0, size - 1); };
  return {inside(whole), inside(whole + 1), filter == Filter::Linear ? texel - whole : 0.0};
}

}  // namespace

ExactTexels::ExactTexels(std::shared_ptr<const Image> image, TextureRole role) : image_(std::move(image)) {
  CheckImage(*image_, "texture");
  if (role != TextureRole::Color || image_->encoding != Encoding::Srgb || image_->type == ChannelType::F32) return;
  const int last = image_->type == ChannelType::U8 ? 255 : 65535;
  for (int code = 0; code <= last; ++code) linear_.push_back(DecodeSrgb(double(code) / last));
}

double ExactTexels::Channel(std::size_t index, bool is_color) const {
  const bool decode = is_color && !linear_.empty();
  switch (image_->type) {
    case ChannelType::U8: {
      const std::uint8_t code = image_->As<std::uint8_t>()[index];
      return decode ? linear_[code] : code / 255.0;
    }
    case ChannelType::U16: {
      const std::uint16_t code = image_->As<std::uint16_t>()[index];
      return decode ? linear_[code] : code / 65535.0;
    }
    case ChannelType::F32: break;
  }
  const double value = double(image_->As<float>()[index]);
  return value > 0.0 ? std::min(value, 1.0) : 0.0;  // a NaN becomes 0
}

glm::dvec4 ExactTexels::Texel(int x, int y) const {
  const int channels = image_->channels;
  const std::size_t i = (std::size_t(y) * std::size_t(image_->width) + std::size_t(x)) * std::size_t(channels);
  const double first = Channel(i, true);
  const double alpha = channels == 2 || channels == 4 ? Channel(i + std::size_t(channels) - 1, false) : 1.0;
  if (channels < 3) return {first, first, first, alpha};
  return {first, Channel(i + 1, true), Channel(i + 2, true), alpha};
}

glm::dvec4 ExactTexels::Sample(const glm::dvec2& uv, const Sampler& sampler) const {
  const Filter filter = sampler.magnification;
  const AxisTexels u = FindTexels(uv.x, sampler.wrap_u, filter, image_->width);
  const AxisTexels v = FindTexels(uv.y, sampler.wrap_v, filter, image_->height);
  if (filter == Filter::Nearest) return Texel(u.first, v.first);
  const glm::dvec4 top = glm::mix(Texel(u.first, v.first), Texel(u.second, v.first), u.fraction);
  const glm::dvec4 bottom = glm::mix(Texel(u.first, v.second), Texel(u.second, v.second), u.fraction);
  return glm::mix(top, bottom, v.fraction);
}

UvTransform::UvTransform(const TextureRef& ref)
    : offset_(ref.offset), scale_(ref.scale), cosine_(Cos(double(ref.rotation))), sine_(Sin(double(ref.rotation))) {}

glm::dvec2 UvTransform::operator()(const glm::dvec2& uv) const {
  const glm::dvec2 scaled = scale_ * uv;
  return offset_ + glm::dvec2(cosine_ * scaled.x + sine_ * scaled.y, cosine_ * scaled.y - sine_ * scaled.x);
}

}  // namespace facet
