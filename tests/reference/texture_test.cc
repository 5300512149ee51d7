// Textures without mip levels: texels, wraps, filters and transforms in closed form.
#include "reference/texture_exact.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "render/hand_built.h"

namespace facet {
namespace {

double Decode(double s) { return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4); }

std::shared_ptr<const Image> Gradient() {
  return std::make_shared<const Image>(
      MakeImage(4, 2, [](int x, int y) { return glm::u8vec4(60 * x, 100 * y, 7, 255 - 50 * x); }));
}

Sampler With(Wrap u, Wrap v, Filter filter) {
  Sampler sampler;
  sampler.wrap_u = u;
  sampler.wrap_v = v;
  sampler.magnification = filter;
  return sampler;
}

TEST(ExactTexels, TexelsAreTheFilesNumbers) {
  const ExactTexels color(Gradient(), TextureRole::Color), data(Gradient(), TextureRole::Data);
  for (const Filter filter : {Filter::Nearest, Filter::Linear}) {
    const Sampler sampler = With(Wrap::Repeat, Wrap::Repeat, filter);
    for (int y = 0; y < 2; ++y) {
      for (int x = 0; x < 4; ++x) {
        const glm::dvec2 centre((x + 0.5) / 4, (y + 0.5) / 2);
        const glm::dvec4 c = color.Sample(centre, sampler), d = data.Sample(centre, sampler);
        EXPECT_NEAR(c.x, Decode(60 * x / 255.0), 1e-14);
        EXPECT_NEAR(c.y, Decode(100 * y / 255.0), 1e-14);
        EXPECT_NEAR(c.w, (255 - 50 * x) / 255.0, 1e-15);  // alpha is linear
        EXPECT_NEAR(d.x, 60 * x / 255.0, 1e-15);
        EXPECT_NEAR(d.z, 7 / 255.0, 1e-15);
      }
    }
  }
}

TEST(ExactTexels, BilinearInLinearLightAndWrapped) {
  const ExactTexels color(Gradient(), TextureRole::Color);
  const auto red = [&](double u, Wrap wrap, Filter filter = Filter::Linear) {
    return color.Sample({u, 0.25}, With(wrap, Wrap::ClampToEdge, filter)).x;
  };
  const double r[4] = {0.0, Decode(60 / 255.0), Decode(120 / 255.0), Decode(180 / 255.0)};
  EXPECT_NEAR(red(0.25 + 0.125 * 0.3, Wrap::Repeat), 0.35 * r[0] + 0.65 * r[1], 1e-14);
  EXPECT_NEAR(red(0.0, Wrap::Repeat), 0.5 * (r[3] + r[0]), 1e-14);
  EXPECT_NEAR(red(1.0, Wrap::Repeat), 0.5 * (r[3] + r[0]), 1e-14);
  EXPECT_NEAR(red(-7.0 + 0.375, Wrap::Repeat), r[1], 1e-14);
  EXPECT_NEAR(red(0.0, Wrap::ClampToEdge), r[0], 1e-14);
  EXPECT_NEAR(red(1e9, Wrap::ClampToEdge), r[3], 1e-14);
  EXPECT_NEAR(red(1.0, Wrap::MirroredRepeat), r[3], 1e-14);
  EXPECT_NEAR(red(1.375, Wrap::MirroredRepeat), r[2], 1e-14);
  EXPECT_NEAR(red(-0.375, Wrap::MirroredRepeat), r[1], 1e-14);
  EXPECT_EQ(red(0.2499, Wrap::Repeat, Filter::Nearest), r[0]);
  EXPECT_EQ(red(0.2501, Wrap::Repeat, Filter::Nearest), r[1]);
  EXPECT_EQ(red(1.0, Wrap::MirroredRepeat, Filter::Nearest), r[3]);
  EXPECT_EQ(red(1.0, Wrap::ClampToEdge, Filter::Nearest), r[3]);
  const double infinity = std::numeric_limits<double>::infinity();
  for (double u : {infinity, -infinity, std::nan(""), 1e300}) EXPECT_TRUE(std::isfinite(red(u, Wrap::Repeat))) << u;
}

TEST(ExactTexels, OtherDepthsAndChannels) {
  Image grey{2, 1, 2, ChannelType::U16, Encoding::Srgb, std::vector<std::byte>(8)};
  const std::uint16_t codes[4] = {1234, 65535, 54321, 300};
  std::memcpy(grey.bytes.data(), codes, sizeof codes);
  const ExactTexels color(std::make_shared<const Image>(grey), TextureRole::Color);
  const glm::dvec4 texel = color.Sample({0.75, 0.5}, With(Wrap::Repeat, Wrap::Repeat, Filter::Nearest));
  EXPECT_NEAR(texel.x, Decode(54321 / 65535.0), 1e-14);
  EXPECT_EQ(texel.x, texel.z);
  EXPECT_NEAR(texel.w, 300 / 65535.0, 1e-15);

  Image real{2, 1, 3, ChannelType::F32, Encoding::Linear, std::vector<std::byte>(24)};
  const float values[6] = {0.25f, NAN, -1.0f, 7.0f, 0.5f, 1.0f};
  std::memcpy(real.bytes.data(), values, sizeof values);
  const ExactTexels floats(std::make_shared<const Image>(real), TextureRole::Color);
  EXPECT_EQ(floats.Sample({0.25, 0.5}, {}), glm::dvec4(0.25, 0.0, 0.0, 1.0));
  EXPECT_EQ(floats.Sample({0.75, 0.5}, {}), glm::dvec4(1.0, 0.5, 1.0, 1.0));
}

// KHR_texture_transform's own example: translation * rotation * scale, with its matrix as the extension writes it.
TEST(UvTransform, IsTheExtensionsMatrix) {
  TextureRef ref;
  ref.offset = {0.5f, -0.25f};
  ref.scale = {2.0f, 3.0f};
  ref.rotation = 0.7f;
  const glm::dvec2 uv(0.3, 0.8), out = UvTransform(ref)(uv);
  const double c = std::cos(double(0.7f)), s = std::sin(double(0.7f));
  EXPECT_NEAR(out.x, 0.5 + c * 2.0 * uv.x + s * 3.0 * uv.y, 1e-14);
  EXPECT_NEAR(out.y, -0.25 - s * 2.0 * uv.x + c * 3.0 * uv.y, 1e-14);
}

}  // namespace
}  // namespace facet
