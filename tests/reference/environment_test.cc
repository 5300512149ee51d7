// Light from all around in double: the same image as the rasterizer's, and densities that are true.
#include "reference/environment_exact.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "light/environment-inl.h"
#include "reference/sample_sequence.h"

namespace facet {
namespace {

namespace lanes = HWY_NAMESPACE;

constexpr double kPi = 3.14159265358979324;

EnvironmentSettings Painted(int width, int height, const std::function<glm::vec3(int, int)>& pixel) {
  auto image = std::make_shared<Image>();
  image->width = width;
  image->height = height;
  image->channels = 3;
  image->type = ChannelType::F32;
  image->encoding = Encoding::Linear;
  image->bytes.resize(image->PixelCount() * 3 * sizeof(float));
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (int c = 0; c < 3; ++c) image->As<float>()[(y * width + x) * 3 + c] = pixel(x, y)[c];
    }
  }
  EnvironmentSettings settings;
  settings.kind = EnvironmentSettings::Kind::Image;
  settings.image = image;
  return settings;
}

EnvironmentSettings Noise(int width, int height) {
  std::mt19937 random(5);
  return Painted(width, height, [&](int, int) {
    const auto number = [&] { return float(random() >> 8) / 16777216.0f; };
    return glm::vec3(number(), number() * number(), number() < 0.9f ? 0.1f : 30.0f);
  });
}

glm::dvec3 OnSphere(const glm::dvec2& random) {
  const double y = 1.0 - 2.0 * random.y, around = std::sqrt(1.0 - y * y), azimuth = 2.0 * kPi * random.x;
  return {around * std::cos(azimuth), y, around * std::sin(azimuth)};
}

TEST(ExactEnvironment, ReadsTheImageAsTheRasterizerDoes) {
  const EnvironmentSettings settings = Noise(16, 8);
  const ExactEnvironment environment(settings);
  EnvironmentOptions options;
  options.keep_image = true;
  const auto map = PrefilterEnvironment(*settings.image, options);
  const SampleSequence sequence(MixBits(3));
  for (std::uint32_t i = 0; i < 4000; ++i) {
    const glm::dvec3 d = OnSphere(sequence.Point(0, i));
    const auto expected =
        lanes::SampleEquirectangular<float>(map->image_data, 16, 8, {float(d.x), float(d.y), float(d.z)});
    const glm::dvec3 radiance = environment.Toward(d).radiance;
    ASSERT_NEAR(radiance.x, expected.x, 1e-4) << d.x << " " << d.y << " " << d.z;
    ASSERT_NEAR(radiance.y, expected.y, 1e-4);
    ASSERT_NEAR(radiance.z, expected.z, 1e-3);
  }
}

TEST(ExactEnvironment, CentreOfTheImageLiesTowardsPlusX) {
  // One bright column: the third of eight, whose centre is at u = 2.5 / 8, 67.5 degrees before +X about +Y.
  EnvironmentSettings settings = Painted(8, 4, [](int x, int) { return glm::vec3(x == 2 ? 1.0f : 0.0f); });
  const double azimuth = (2.5 / 8.0 - 0.5) * 2.0 * kPi;
  const glm::dvec3 towards(std::cos(azimuth), 0.0, std::sin(azimuth));
  EXPECT_NEAR(ExactEnvironment(settings).Toward(towards).radiance.x, 1.0, 1e-12);
  // Turned counter-clockwise seen from above: +Z goes to +X.
  settings.rotation = 0.5 * kPi;
  settings.intensity = 3.0;
  const ExactEnvironment turned(settings);
  EXPECT_NEAR(turned.Toward({towards.z, 0.0, -towards.x}).radiance.x, 3.0, 1e-12);
  for (std::uint32_t i = 0; i < 64; ++i) {  // samples are where the light is
    const auto light = turned.Sample(SampleSequence(1).Point(0, i));
    EXPECT_GT(light.radiance.x, 0.0);
    EXPECT_NEAR(turned.Toward(light.direction).radiance.x, light.radiance.x, 1e-6);
  }
}

TEST(ExactEnvironment, DensitiesIntegrateToOneAndAreThoseOfSamples) {
  for (const auto& settings : {Noise(16, 8), Noise(5, 1), Noise(1, 3), Noise(32, 2), EnvironmentSettings{}}) {
    const ExactEnvironment environment(settings);
    const SampleSequence sequence(MixBits(9));
    constexpr std::uint32_t kCount = 1u << 16;
    double whole = 0.0, by_sphere[2] = {}, by_samples[2] = {};
    for (std::uint32_t i = 0; i < kCount; ++i) {
      const glm::dvec3 d = OnSphere(sequence.Point(0, i));
      const auto light = environment.Toward(d);
      whole += light.density * 4.0 * kPi / kCount;
      by_sphere[0] += light.radiance.x * 4.0 * kPi / kCount;
      by_sphere[1] += light.radiance.z * (1.0 + d.x + d.y * d.z) * 4.0 * kPi / kCount;
      const auto sample = environment.Sample(sequence.Point(1, i));
      ASSERT_GT(sample.density, 0.0);
      ASSERT_NEAR(glm::length(sample.direction), 1.0, 1e-12);
      ASSERT_NEAR(environment.Toward(sample.direction).density / sample.density, 1.0, 1e-3);
      const glm::dvec3& s = sample.direction;
      by_samples[0] += sample.radiance.x / sample.density / kCount;
      by_samples[1] += sample.radiance.z * (1.0 + s.x + s.y * s.z) / sample.density / kCount;
    }
    EXPECT_NEAR(whole, 1.0, 0.01);
    for (int k = 0; k < 2; ++k) EXPECT_NEAR(by_samples[k] / by_sphere[k], 1.0, 0.02) << k;
  }
}

// A sun of one pixel, a million times as bright as the sky: every other sample hits it, and its power comes out right.
TEST(ExactEnvironment, ASunIsFound) {
  const ExactEnvironment environment(
      Painted(256, 128, [](int x, int y) { return glm::vec3(x == 100 && y == 40 ? 1e6f : 1.0f); }));
  const double polar = kPi * 40.5 / 128, azimuth = 2.0 * kPi * (100.5 / 256 - 0.5);
  const glm::dvec3 sun(std::sin(polar) * std::cos(azimuth), std::cos(polar), std::sin(polar) * std::sin(azimuth));
  int hits = 0;
  double power = 0.0;
  constexpr int kCount = 4096;
  for (std::uint32_t i = 0; i < kCount; ++i) {
    const auto light = environment.Sample(SampleSequence(4).Point(0, i));
    hits += glm::dot(light.direction, sun) > std::cos(0.04);
    power += light.radiance.x / light.density / kCount;
  }
  // The bilinear tent of a pixel has its area.
  const double pixel = std::sin(polar) * (kPi / 128) * (2.0 * kPi / 256);
  EXPECT_NEAR(power, 4.0 * kPi + 1e6 * pixel, 0.01 * power);
  EXPECT_GT(hits, kCount * 0.9);
}

TEST(ExactEnvironment, BlackAndBroken) {
  EXPECT_TRUE(ExactEnvironment(Painted(8, 4, [](int, int) { return glm::vec3(0.0f); })).IsBlack());
  const ExactEnvironment repaired(
      Painted(8, 4, [](int x, int) { return x == 0 ? glm::vec3(NAN, -1.0f, INFINITY) : glm::vec3(0.5f); }));
  EXPECT_FALSE(repaired.IsBlack());
  for (std::uint32_t i = 0; i < 256; ++i) {
    const glm::dvec3 r = repaired.Toward(OnSphere(SampleSequence(2).Point(0, i))).radiance;
    EXPECT_TRUE(r.x >= 0.0 && r.y >= 0.0 && r.z >= 0.0 && r.x < 1e10);
  }
}

}  // namespace
}  // namespace facet
