#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <random>

#include "base/parallel.h"
#include "color/srgb.h"
#include "facet/error.h"
#include "facet/film.h"
#include "facet/shader/dispatch.h"

namespace facet {
namespace {

Film OnePixel(glm::vec4 pixel) { return Film{1, 1, {pixel}}; }

DisplaySettings Display(ToneMap tone_map, double exposure_ev = 0.0, std::optional<glm::vec3> background = {}) {
  DisplaySettings settings;
  settings.tone_map = tone_map;
  settings.exposure_ev = exposure_ev;
  settings.background_srgb = background;
  return settings;
}

template <class Number>
std::vector<int> Numbers(const Image& image) {
  const Number* p = image.As<Number>();
  return std::vector<int>(p, p + image.PixelCount() * static_cast<std::size_t>(image.channels));
}

std::vector<int> Bytes(const Film& film, const DisplaySettings& settings) {
  return Numbers<std::uint8_t>(EncodeFilm(film, settings, ChannelType::U8));
}

// An image with everything in it that could go wrong.
Film WildFilm(int width, int height) {
  Film film{width, height, {}};
  std::mt19937 random(5);
  const float special[] = {0.0f, -0.0f, -1.0f, 1.0f, NAN, HUGE_VALF, -HUGE_VALF, 3e38f, 1e-44f, 0.5f};
  const auto channel = [&] {
    const auto bits = static_cast<std::uint32_t>(random());
    if (bits % 32 == 0) return special[(bits >> 8) % std::size(special)];
    return std::ldexp(static_cast<float>(bits) * 0x1p-32f, static_cast<int>(bits % 16) - 10);
  };
  for (int i = 0; i < width * height; ++i) {
    const float alpha = i % 3 == 0 ? 1.0f : static_cast<float>(random()) * 0x1p-32f;
    film.pixels.push_back({channel(), channel(), channel(), i % 101 == 0 ? channel() : alpha});
  }
  return film;
}

// Whole packets of empty pixels are not computed: what stands there is what a single empty pixel becomes.
TEST(EncodeFilm, EmptyPixelsAreWhatEachIsAlone) {
  Film film{203, 1, {}};
  for (int i = 0; i < 203; ++i) {
    const bool seen = i / 40 % 2 == 1 && i % 7 != 0;
    film.pixels.emplace_back(seen ? glm::vec4(0.01f * static_cast<float>(i), 0.5f, 0.25f, 0.75f) : glm::vec4(0.0f));
  }
  const std::optional<glm::vec3> backgrounds[] = {std::nullopt, glm::vec3(0.0f), glm::vec3(0.2f, 0.5f, 1.0f)};
  for (const Target target : {Target::Scalar, Target::Sse4, Target::Avx2, Target::Avx3, Target::Neon}) {
    if (!TargetIsAvailable(target)) continue;
    const ScopedTarget scoped(target);
    for (const ToneMap map : {ToneMap::None, ToneMap::Neutral, ToneMap::AgX}) {
      for (const auto& background : backgrounds) {
        for (const ChannelType type : {ChannelType::U8, ChannelType::U16, ChannelType::F32}) {
          const Image all = EncodeFilm(film, Display(map, 1.0, background), type);
          const std::size_t size = all.bytes.size() / 203;
          for (std::size_t i = 0; i < 203; ++i) {
            const Image one = EncodeFilm(OnePixel(film.pixels[i]), Display(map, 1.0, background), type);
            ASSERT_EQ(std::memcmp(all.bytes.data() + i * size, one.bytes.data(), size), 0)
                << TargetName(target) << ", pixel " << i;
          }
        }
      }
    }
  }
}

TEST(EncodeFilm, CodesOfAByteImageSurvive) {
  Film film{256, 1, {}};
  for (const float light : Srgb8ToLinearTable()) film.pixels.push_back({light, light, light, 1.0f});
  const std::vector<int> bytes = Bytes(film, Display(ToneMap::None));
  for (int code = 0; code < 256; ++code) {
    for (int channel = 0; channel < 3; ++channel) EXPECT_EQ(bytes[static_cast<std::size_t>(4 * code + channel)], code);
    EXPECT_EQ(bytes[static_cast<std::size_t>(4 * code + 3)], 255);
  }
}

TEST(EncodeFilm, EveryCodeIsTheNearest) {
  const Film film = WildFilm(301, 97);
  const Image bytes = EncodeFilm(film, Display(ToneMap::None), ChannelType::U8);
  const Image words = EncodeFilm(film, Display(ToneMap::None), ChannelType::U16);
  for (std::size_t i = 0; i < film.pixels.size(); ++i) {
    const glm::vec4 p = film.pixels[i];
    const bool finite = std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z) && std::isfinite(p.w);
    const bool seen = finite && p.w > 0.0f;
    for (int channel = 0; channel < 3; ++channel) {
      const float light = seen ? p[channel] / p.w : 0.0f;
      const std::size_t at = 4 * i + static_cast<std::size_t>(channel);
      ASSERT_EQ(bytes.As<std::uint8_t>()[at], LinearToSrgb8(light)) << light;
      ASSERT_EQ(words.As<std::uint16_t>()[at], LinearToSrgb16(light)) << light;
    }
    const float alpha = seen ? std::min(p.w, 1.0f) : 0.0f;
    ASSERT_EQ(bytes.As<std::uint8_t>()[4 * i + 3], int(alpha * 255.0f + 0.5f));
    ASSERT_EQ(words.As<std::uint16_t>()[4 * i + 3], int(alpha * 65535.0f + 0.5f));
  }
}

TEST(EncodeFilm, AlphaIsStraight) {
  // Half-covered light of 0.5: the colour in the file is that of 0.5.
  const std::vector<int> bytes = Bytes(OnePixel({0.25f, 0.25f, 0.25f, 0.5f}), Display(ToneMap::None));
  EXPECT_EQ(bytes, (std::vector<int>{188, 188, 188, 128}));
  EXPECT_EQ(Bytes(OnePixel({0.0f, 0.0f, 0.0f, 0.0f}), Display(ToneMap::AgX)), (std::vector<int>{0, 0, 0, 0}));
}

TEST(EncodeFilm, BackgroundIsExactForEveryToneMapAndExposure) {
  for (const ToneMap tone_map :
       {ToneMap::None, ToneMap::Reinhard, ToneMap::Aces, ToneMap::AgX, ToneMap::Neutral, ToneMap::Filmic,
        ToneMap::Generic, ToneMap::Gt7, ToneMap::AgXGolden, ToneMap::AgXPunchy}) {
    for (const double exposure : {-3.0, 0.0, 5.0}) {
      for (int code = 0; code < 256; ++code) {
        const float c = static_cast<float>(code) / 255.0f;
        const auto settings = Display(tone_map, exposure, glm::vec3(c, 1.0f, 0.0f));
        ASSERT_EQ(Bytes(OnePixel({0, 0, 0, 0}), settings), (std::vector<int>{code, 255, 0}));
      }
    }
  }
}

TEST(EncodeFilm, BackgroundIsMixedInDisplayLinearLight) {
  // Black over half of white: 0.5 in linear light, which is code 188.
  EXPECT_EQ(Bytes(OnePixel({0, 0, 0, 0.5f}), Display(ToneMap::Reinhard, 0.0, glm::vec3(1.0f))),
            (std::vector<int>{188, 188, 188}));
  // Light of 1 becomes 0.5 by the curve; three quarters of it and a quarter of white are 0.625, code 207.
  EXPECT_EQ(Bytes(OnePixel({0.75f, 0.75f, 0.75f, 0.75f}), Display(ToneMap::Reinhard, 0.0, glm::vec3(1.0f))),
            (std::vector<int>{207, 207, 207}));
}

TEST(EncodeFilm, ExposureIsInStops) {
  EXPECT_EQ(Bytes(OnePixel({0.05f, 0.1f, 0.2f, 1.0f}), Display(ToneMap::Neutral, 2.0)),
            Bytes(OnePixel({0.2f, 0.4f, 0.8f, 1.0f}), Display(ToneMap::Neutral)));
  const Image image = EncodeFilm(OnePixel({1.0f, 2.0f, 4.0f, 1.0f}), Display(ToneMap::Aces, -1.0), ChannelType::F32);
  EXPECT_EQ(image.encoding, Encoding::Linear);
  ASSERT_EQ(image.channels, 4);
  EXPECT_EQ(image.As<float>()[0], 0.5f);
  EXPECT_EQ(image.As<float>()[1], 1.0f);
  EXPECT_EQ(image.As<float>()[2], 2.0f);
  EXPECT_EQ(image.As<float>()[3], 1.0f);
}

TEST(EncodeFilm, FloatImagesHaveTheBackgroundInLinearLight) {
  const auto settings = Display(ToneMap::Aces, 1.0, glm::vec3(1.0f, 0.0f, 0.5f));
  const Image image = EncodeFilm(OnePixel({0.5f, 0.5f, 0.5f, 0.5f}), settings, ChannelType::F32);
  ASSERT_EQ(image.channels, 3);
  EXPECT_EQ(image.As<float>()[0], 1.5f);
  EXPECT_EQ(image.As<float>()[1], 1.0f);
  EXPECT_FLOAT_EQ(image.As<float>()[2], 1.0f + 0.5f * 0.21404114f);
}

TEST(EncodeFilm, WhatIsNotFiniteIsEmpty) {
  for (const float bad : {NAN, HUGE_VALF, -HUGE_VALF}) {
    for (int channel = 0; channel < 4; ++channel) {
      glm::vec4 pixel(0.5f, 0.5f, 0.5f, 1.0f);
      pixel[channel] = bad;
      EXPECT_EQ(Bytes(OnePixel(pixel), Display(ToneMap::Neutral)), (std::vector<int>{0, 0, 0, 0}));
    }
  }
  // What overflows on the way does not become a hole.
  EXPECT_EQ(Bytes(OnePixel({3e38f, 0.0f, 0.0f, 1e-3f}), Display(ToneMap::None, 100.0)),
            (std::vector<int>{255, 0, 0, 0}));
  const Image image = EncodeFilm(OnePixel({3e38f, 0, 0, 0.5f}), Display(ToneMap::None, 100.0), ChannelType::F32);
  EXPECT_EQ(image.As<float>()[0], std::numeric_limits<float>::max());
}

TEST(EncodeFilm, SameBytesOnEveryTargetAndThreadCount) {
  const Film film = WildFilm(131, 127);  // two tasks, the last with a rest of a vector
  for (const ToneMap tone_map :
       {ToneMap::None, ToneMap::Reinhard, ToneMap::Aces, ToneMap::AgX, ToneMap::Neutral, ToneMap::Filmic,
        ToneMap::Generic, ToneMap::Gt7, ToneMap::AgXGolden, ToneMap::AgXPunchy}) {
    for (const ChannelType type : {ChannelType::U8, ChannelType::U16, ChannelType::F32}) {
      for (const bool opaque : {false, true}) {
        auto settings = Display(tone_map, 0.37);
        if (opaque) settings.background_srgb = glm::vec3(0.2f, 0.9f, 0.4f);
        std::vector<std::byte> expected;
        for (const Target target : {Target::Scalar, Target::Sse4, Target::Avx2, Target::Avx3, Target::Neon}) {
          if (!TargetIsAvailable(target)) continue;
          const ScopedTarget scoped(target);
          for (const int threads : {1, 3}) {
            RunWithThreads(threads, [&] {
              const Image image = EncodeFilm(film, settings, type);
              if (expected.empty()) expected = image.bytes;
              EXPECT_TRUE(image.bytes == expected) << TargetName(target) << ", " << threads << " threads";
            });
          }
        }
      }
    }
  }
}

TEST(EncodeFilm, RefusesSettingsThatMeanNothing) {
  EXPECT_THROW(EncodeFilm(OnePixel({}), Display(ToneMap::None, NAN)), Error);
  EXPECT_THROW(EncodeFilm(OnePixel({}), Display(ToneMap::None, 0.0, glm::vec3(1.5f, 0.0f, 0.0f))), Error);
  EXPECT_THROW(EncodeFilm(Film{2, 2, {}}, Display(ToneMap::None)), Error);
  const Image empty = EncodeFilm(Film{}, Display(ToneMap::None));
  EXPECT_EQ(empty.bytes.size(), 0u);
}

TEST(EncodeFilm, ACamerasExposureMakesSunnySixteenMiddleGrey) {
  DisplaySettings display = Display(ToneMap::None);
  display.camera = CameraExposure{16.0, 1 / 128.0, 100.0};  // EV100 = 15: 1.2 * 2^15 cd/m2 are white
  const float white = 1.2f * 32768.0f;
  EXPECT_EQ(Bytes(OnePixel({white, white / 4, 0.0f, 1.0f}), display), (std::vector<int>{255, 137, 0, 255}));
  display.exposure_ev = 1.0;
  EXPECT_EQ(Bytes(OnePixel({white / 2, white / 8, 0.0f, 1.0f}), display), (std::vector<int>{255, 137, 0, 255}));
  display.camera->aperture = 0.0;
  EXPECT_THROW(EncodeFilm(OnePixel({}), display), Error);
}

TEST(EncodeFilm, GammaIsAPowerAndKeepsTheBackground) {
  DisplaySettings display = Display(ToneMap::None, 0.0, glm::vec3(0.25f, 0.5f, 0.75f));
  display.transfer = Transfer::Gamma;
  const auto code = [](double light) { return static_cast<int>(std::lround(255.0 * std::pow(light, 1 / 2.2))); };
  EXPECT_EQ(Bytes(OnePixel({0.5f, 0.18f, 0.01f, 1.0f}), display),
            (std::vector<int>{code(0.5), code(0.18), code(0.01)}));
  EXPECT_EQ(Bytes(OnePixel({0.0f, 0.0f, 0.0f, 0.0f}), display), (std::vector<int>{64, 128, 191}));
}

TEST(EncodeFilm, GradingIsBeforeTheToneCurve) {
  DisplaySettings display = Display(ToneMap::Reinhard);
  display.grading.saturation = 0.0;
  const std::vector<int> grey = Bytes(OnePixel({0.9f, 0.1f, 0.4f, 1.0f}), display);
  EXPECT_EQ(grey[0], grey[1]);
  EXPECT_EQ(grey[1], grey[2]);
  const float luminance = 0.2126f * 0.9f + 0.7152f * 0.1f + 0.0722f * 0.4f;
  EXPECT_EQ(grey, Bytes(OnePixel({luminance, luminance, luminance, 1.0f}), Display(ToneMap::Reinhard)));
  display.grading.contrast = 3.0;
  EXPECT_THROW(EncodeFilm(OnePixel({}), display), Error);
}

}  // namespace
}  // namespace facet
