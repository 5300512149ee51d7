// Environments: directions, closed forms of irradiance, prefiltering against brute force, hostile input.
#include "light/environment.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include "base/parallel.h"
#include "facet/error.h"
#include "facet/shader/dispatch.h"
#include "light/lighting-inl.h"
#include "light/studio.h"

namespace facet {
namespace {

namespace lanes = HWY_NAMESPACE;
using lanes::Vec3;

constexpr double kPi = 3.14159265358979324;

Vec3<double> DirectionOfPixel(int x, int y, int width, int height) {
  const double angle = ((x + 0.5) / width - 0.5) * 2.0 * kPi, theta = (y + 0.5) / height * kPi;
  return {std::sin(theta) * std::cos(angle), std::cos(theta), std::sin(theta) * std::sin(angle)};
}

Image Paint(int width, int height, const std::function<double(Vec3<double>)>& radiance) {
  Image image{width, height, 3, ChannelType::F32, Encoding::Linear, {}};
  image.bytes.resize(image.PixelCount() * 3 * sizeof(float));
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double value = radiance(DirectionOfPixel(x, y, width, height));
      for (int c = 0; c < 3; ++c) image.As<float>()[(std::size_t(y) * width + x) * 3 + c] = float(value * (c + 1));
    }
  }
  return image;
}

std::vector<Vec3<double>> SomeDirections(int count) {
  std::mt19937 random(11);
  const auto uniform = [&] { return double(random()) / 4294967296.0; };
  std::vector<Vec3<double>> result = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  for (int i = 0; i < count; ++i) {
    const double z = 2.0 * uniform() - 1.0, phi = 2.0 * kPi * uniform(), s = std::sqrt(1.0 - z * z);
    result.push_back({s * std::cos(phi), z, s * std::sin(phi)});
  }
  return result;
}

TEST(Octahedron, RoundTrip) {
  for (Vec3<double> d : SomeDirections(500)) {
    const auto uv = lanes::OctahedronFromDirection(d * 7.0);
    EXPECT_TRUE(uv.x >= 0.0 && uv.x <= 1.0 && uv.y >= 0.0 && uv.y <= 1.0);
    const Vec3<double> back = lanes::DirectionFromOctahedron(uv);
    EXPECT_NEAR(Dot(back, d), 1.0, 1e-12);
  }
}

TEST(Environment, ConstantStaysConstant) {
  const auto map = PrefilterEnvironment(Paint(128, 64, [](Vec3<double>) { return 0.7; }));
  for (Vec3<double> d : SomeDirections(200)) {
    for (double roughness : {0.0, 0.1, 0.3, 0.5, 0.8, 1.0}) {
      EXPECT_NEAR(lanes::PrefilteredRadiance(*map, d, roughness).y, 1.4, 2e-5);
    }
    EXPECT_NEAR(lanes::IrradianceOverPi(*map, d).z, 2.1, 3e-5);
  }
}

// The convention: column u, row v show u = 0.5 + atan2(z, x) / (2 pi), v = acos(y) / pi.
TEST(Environment, CentreIsPlusXAndThreeQuartersIsPlusZ) {
  const int width = 256, height = 128;
  const auto lit_at = [&](double u, double v) {
    Image image = Paint(width, height, [](Vec3<double>) { return 0.0; });
    for (int y = int(v * height) - 6; y < int(v * height) + 6; ++y) {
      for (int x = int(u * width) - 6; x < int(u * width) + 6; ++x) {
        if (y < 0 || y >= height) continue;
        image.As<float>()[(std::size_t(y) * width + std::size_t((x + width) % width)) * 3] = 1.0f;
      }
    }
    return image;
  };
  const struct {
    double u, v;
    Vec3<double> direction;
  } cases[] = {{0.5, 0.5, {1, 0, 0}}, {0.75, 0.5, {0, 0, 1}}, {0.0, 0.5, {-1, 0, 0}}, {0.25, 0.5, {0, 0, -1}},
               {0.5, 0.25, {0.70710678, 0.70710678, 0}}};
  for (const auto& c : cases) {
    for (bool keep : {false, true}) {
      const auto map = PrefilterEnvironment(lit_at(c.u, c.v), {.keep_image = keep, .max_size = 512});
      EXPECT_NEAR(lanes::SharpRadiance(*map, c.direction).x, 1.0, 1e-6) << c.u << " " << c.v;
      EXPECT_NEAR(lanes::SharpRadiance(*map, -c.direction).x, 0.0, 1e-6) << c.u << " " << c.v;
    }
  }
}

TEST(Environment, RotationIsCounterClockwiseSeenFromAbove) {
  const auto map = PrefilterEnvironment(Paint(256, 128, [](Vec3<double> d) { return std::exp(20.0 * (d.x - 1.0)); }));
  const LightingData data = MakeLightingData({}, map.get(), kPi / 2, 2.0);
  const lanes::LightingView<double> lighting(data);
  // What lay towards +X now lies towards -Z.
  EXPECT_NEAR(lighting.Prefiltered({0, 0, -1}, 0.0).x, 2.0, 0.02);
  EXPECT_NEAR(lighting.Background({0, 0, -1}).x, 2.0, 0.02);
  EXPECT_LT(lighting.Prefiltered({1, 0, 0}, 0.0).x, 1e-6);
  EXPECT_GT(lighting.Irradiance({0, 0, -1}).x, 10.0 * lighting.Irradiance({0.8, 0, 0.6}).x);
}

// The map is continuous over its folds and true to the image.
TEST(Environment, LevelZeroIsTheImage) {
  const auto radiance = [](Vec3<double> d) { return 1.0 + 0.5 * d.x - 0.3 * d.y + 0.2 * d.z + 0.4 * d.x * d.z; };
  const auto map = PrefilterEnvironment(Paint(512, 256, radiance), {.keep_image = true, .max_size = 512});
  for (Vec3<double> d : SomeDirections(3000)) {
    EXPECT_NEAR(lanes::PrefilteredRadiance(*map, d, 0.0).x, radiance(d), 0.002);
    EXPECT_NEAR(lanes::SharpRadiance(*map, d).x, radiance(d), 0.004);  // a pole's row stands for half a pixel around it
  }
}

TEST(Environment, IrradianceOfHalfASky) {
  const auto map = PrefilterEnvironment(Paint(256, 128, [](Vec3<double> d) { return d.y > 0.0 ? 1.0 : 0.0; }));
  for (Vec3<double> n : SomeDirections(300)) {
    EXPECT_NEAR(lanes::IrradianceOverPi(*map, n).x, 0.5 * (1.0 + n.y), 0.004);
  }
}

TEST(Environment, IrradianceOfAGradient) {
  // The cosine lobe's mean of a linear function f(d) = 1 + d.a is 1 + 2/3 n.a.
  const auto map = PrefilterEnvironment(Paint(256, 128, [](Vec3<double> d) { return 1.0 + 0.6 * d.x - 0.5 * d.z; }));
  for (Vec3<double> n : SomeDirections(300)) {
    EXPECT_NEAR(lanes::IrradianceOverPi(*map, n).x, 1.0 + 2.0 / 3.0 * (0.6 * n.x - 0.5 * n.z), 0.004);
  }
}

// A degree-2 sky is all that nine numbers hold; of f = 2 + d.a + d.x d.y + d.z^2 the cosine lobe keeps 2/3 of degree 1 and
// 1/4 of degree 2.
TEST(Environment, IrradianceByHarmonicsIsExactUpToDegreeTwo) {
  const auto map = PrefilterEnvironment(
      Paint(256, 128, [](Vec3<double> d) { return 2.0 + 0.6 * d.x - 0.5 * d.y + d.x * d.y + d.z * d.z; }),
      {.irradiance = IrradianceMethod::SphericalHarmonics});
  for (Vec3<double> n : SomeDirections(300)) {
    const double degree2 = n.x * n.y + (n.z * n.z - 1.0 / 3.0);
    const double expected = 2.0 + 1.0 / 3.0 + 2.0 / 3.0 * (0.6 * n.x - 0.5 * n.y) + 0.25 * degree2;
    // As above 0.4 % of the mean, for the source's 64 x 64 texels and reading between the map's 32 x 32.
    EXPECT_NEAR(lanes::IrradianceOverPi(*map, n).x, expected, 0.004 * 2.33);
    EXPECT_NEAR(lanes::IrradianceOverPi(*map, n).z, 3.0 * expected, 0.012 * 2.33);
  }
}

// A small sun: what the harmonics ring below zero never becomes negative light.
TEST(Environment, IrradianceByHarmonicsIsNeverNegative) {
  const auto map = PrefilterEnvironment(Paint(256, 128, [](Vec3<double> d) { return d.y > 0.99 ? 1000.0 : 0.0; }),
                                        {.irradiance = IrradianceMethod::SphericalHarmonics});
  double smallest = 1.0;
  for (Vec3<double> n : SomeDirections(300)) smallest = std::min(smallest, lanes::IrradianceOverPi(*map, n).x);
  EXPECT_EQ(smallest, 0.0);
}

// Brute force over incoming directions of L n_dot_l D(h), view = normal = reflection (Karis, 2013).
double Prefilter(const std::function<double(Vec3<double>)>& radiance, Vec3<double> n, double alpha) {
  const Vec3<double> helper = std::fabs(n.y) < 0.9 ? Vec3<double>{0, 1, 0} : Vec3<double>{1, 0, 0};
  Vec3<double> t = lanes::Cross(helper, n);
  t = t / std::sqrt(Dot(t, t));
  const Vec3<double> b = lanes::Cross(n, t);
  double sum = 0.0, weight_sum = 0.0;
  constexpr int kPolar = 250, kAzimuth = 96;
  const double low = std::log(alpha * 1e-2);
  const double high = std::log(std::tan(kPi / 4));  // half vectors to 45 degrees: light to the horizon
  for (int i = 0; i < kPolar; ++i) {
    const double step = (high - low) / kPolar;
    const double theta = std::atan(std::exp(low + (i + 0.5) * step));  // of the half vector
    const double s = std::sin(2.0 * theta), c = std::cos(2.0 * theta);
    const double d = lanes::DistributionGgx(std::cos(theta), std::sin(theta) * std::sin(theta), alpha);
    const double weight = d * c * s * 2.0 * std::sin(theta) * std::cos(theta) * step;
    for (int j = 0; j < kAzimuth; ++j) {
      const double phi = 2.0 * kPi * (j + 0.5) / kAzimuth;
      sum += weight * radiance(t * (s * std::cos(phi)) + b * (s * std::sin(phi)) + n * c);
      weight_sum += weight;
    }
  }
  return sum / weight_sum;
}

TEST(Environment, PrefilteringAgreesWithBruteForce) {
  // Three lamps of different sharpness over a dim ground: detail at every scale of the levels.
  const auto radiance = [](Vec3<double> d) {
    const auto lamp = [&](Vec3<double> axis, double sharpness, double peak) {
      return peak * std::exp(sharpness * (Dot(d, axis) - 1.0));
    };
    return 0.2 + lamp({0.6, 0.0, 0.8}, 400.0, 8.0) + lamp({0.0, 1.0, 0.0}, 30.0, 3.0) +
           lamp({-0.8, -0.6, 0.0}, 150.0, 5.0);
  };
  const auto map = PrefilterEnvironment(Paint(1024, 512, radiance), {.samples = 48});
  for (int level = 1; level < EnvironmentMap::kLevels; ++level) {
    const double roughness = double(level) / (EnvironmentMap::kLevels - 1);
    double error2 = 0.0, total2 = 0.0, worst = 0.0;
    std::vector<Vec3<double>> directions = SomeDirections(16);
    for (Vec3<double> lamp : {Vec3<double>{0.6, 0.0, 0.8}, {-0.8, -0.6, 0.0}, {0.65, 0.05, 0.7582875}}) {
      directions.push_back(lamp);
    }
    for (Vec3<double> n : directions) {
      const double exact = Prefilter(radiance, n, roughness * roughness);
      const double error = lanes::PrefilteredRadiance(*map, n, roughness).x - exact;
      error2 += error * error;
      total2 += exact * exact;
      worst = std::max(worst, std::fabs(error) / (exact + 0.2));
    }
    EXPECT_LT(std::sqrt(error2 / total2), 0.03) << "level " << level;
    EXPECT_LT(worst, 0.05) << "level " << level;
  }
}

// A sun anywhere in a cell of the coarse source shines from its own place: up to a factor (the octahedral map keeps the
// energy of a single pixel to some percent only) its irradiance is the clamped cosine.
TEST(Environment, RoughLevelsKnowWhereASunStands) {
  for (const auto& [x, y] : {std::pair{700, 150}, {333, 201}, {12, 260}, {509, 330}, {900, 77}}) {
    Image image = Paint(1024, 512, [](Vec3<double>) { return 0.0; });
    for (int c = 0; c < 3; ++c) image.As<float>()[(std::size_t(y) * 1024 + std::size_t(x)) * 3 + std::size_t(c)] = 1e6f;
    const auto map = PrefilterEnvironment(image);
    const Vec3<double> sun = DirectionOfPixel(x, y, 1024, 512);
    double product = 0.0, cosine2 = 0.0, found2 = 0.0;
    for (Vec3<double> n : SomeDirections(300)) {
      const double cosine = std::max(Dot(n, sun), 0.0), found = lanes::IrradianceOverPi(*map, n).x;
      product += cosine * found;
      cosine2 += cosine * cosine;
      found2 += found * found;
    }
    // The sine of the angle between the two, as vectors of 306 numbers.
    EXPECT_LT(std::sqrt(1.0 - product * product / (cosine2 * found2)), 0.015) << x << " " << y;
  }
}

TEST(Environment, EnergyOfASunIsKept) {
  // One pixel of radiance 1e6 above the horizon: its irradiance is radiance * solid angle * cosine.
  Image image = Paint(1024, 512, [](Vec3<double>) { return 0.0; });
  const int x = 700, y = 150;
  for (int c = 0; c < 3; ++c) image.As<float>()[(std::size_t(y) * 1024 + x) * 3 + c] = 1e6f;
  const auto map = PrefilterEnvironment(image);
  const Vec3<double> sun = DirectionOfPixel(x, y, 1024, 512);
  const double solid_angle = 2.0 * kPi / 1024 * (std::cos(kPi * y / 512) - std::cos(kPi * (y + 1) / 512));
  EXPECT_NEAR(lanes::IrradianceOverPi(*map, sun).x * kPi / (1e6 * solid_angle), 1.0, 0.05);
  for (float texel : map->texels) ASSERT_TRUE(std::isfinite(texel) && texel >= 0.0f);
}

TEST(Environment, HostilePixelsAreRepaired) {
  Image image = Paint(64, 32, [](Vec3<double>) { return 1.0; });
  const float inf = std::numeric_limits<float>::infinity();
  const float bad[] = {std::nanf(""), inf, -inf, -1.0f, 3.4e38f};
  for (int i = 0; i < 5; ++i) image.As<float>()[300 * (i + 1)] = bad[i];
  const auto map = PrefilterEnvironment(image, {.keep_image = true, .max_size = 512});
  EXPECT_EQ(map->repaired_values, 5u);
  for (float texel : map->texels) ASSERT_TRUE(std::isfinite(texel) && texel >= 0.0f);
}

TEST(Environment, AnySizeAndType) {
  for (auto [width, height] : {std::pair{1, 1}, {2, 1}, {3, 5}, {7, 300}, {2048, 16}}) {
    Image image{width, height, 4, ChannelType::U8, Encoding::Srgb, {}};
    image.bytes.assign(image.PixelCount() * 4, std::byte(255));
    const auto map = PrefilterEnvironment(image, {.keep_image = true, .max_size = 1024});
    for (Vec3<double> d : SomeDirections(50)) {
      EXPECT_NEAR(lanes::SharpRadiance(*map, d).x, 1.0, 1e-5);
      EXPECT_NEAR(lanes::PrefilteredRadiance(*map, d, 0.3).y, 1.0, 1e-5);
    }
  }
  EXPECT_THROW(PrefilterEnvironment(Image{}), Error);
}

// Before anything is read: such an image has more pixels than 32 bits count numbers of.
TEST(Environment, PicturesBeyondTheLimitsAreRefused) {
  for (const auto& [width, height] :
       {std::pair(32768, 16384), {32768, 32768}, {32769, 1}, {1, 32769}, {1 << 30, 1 << 30}}) {
    Image image;  // without its bytes, which would be gigabytes
    image.width = width, image.height = height, image.channels = 3;
    try {
      PrefilterEnvironment(image);
      FAIL() << width << " x " << height << " was taken";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::OutOfMemory);
      EXPECT_NE(std::string(error.what()).find(std::to_string(width) + " x " + std::to_string(height)),
                std::string::npos)
          << error.what();
    }
  }
}

TEST(Environment, SameBitsOnEveryInstructionSetAndThreadCount) {
  const Image image = Paint(256, 128, [](Vec3<double> d) { return std::exp(3.0 * d.x) + d.z * d.z; });
  PageVector<float> scalar;
  {
    const ScopedTarget forced(Target::Scalar);
    RunWithThreads(1, [&] { scalar = PrefilterEnvironment(image)->texels; });
  }
  for (Target target : {Target::Sse4, Target::Avx2, Target::Avx3, Target::Neon}) {
    if (!TargetIsAvailable(target)) continue;
    const ScopedTarget forced(target);
    EXPECT_EQ(PrefilterEnvironment(image)->texels, scalar) << TargetName(target);
  }
}

TEST(Studio, IsPositiveAndOfMeanOne) {
  const Image image = StudioImage(256, 128);
  double sum = 0.0, weight = 0.0;
  for (int y = 0; y < 128; ++y) {
    const double solid_angle = std::sin(kPi * (y + 0.5) / 128);
    for (int x = 0; x < 256; ++x) {
      const float value = image.As<float>()[(std::size_t(y) * 256 + std::size_t(x)) * 3];
      ASSERT_TRUE(std::isfinite(value) && value > 0.05f && value < 50.0f);
      sum += solid_angle * value;
      weight += solid_angle;
    }
  }
  EXPECT_NEAR(sum / weight, 0.65, 1e-6);
  EXPECT_EQ(StudioEnvironment().get(), StudioEnvironment().get());
  EXPECT_EQ(StudioEnvironment()->image_data, nullptr);
  EXPECT_NE(StudioEnvironment({.keep_image = true})->image_data, nullptr);
  // The build's table holds what preparing the image gives, bit for bit.
  const auto map = StudioEnvironment();
  const auto made = PrefilterEnvironment(StudioImage(kStudioWidth, kStudioHeight), {.max_size = kStudioMaxSize});
  ASSERT_EQ(map->texels.size(), made->texels.size());
  for (std::size_t i = 0; i < made->texels.size(); ++i) {
    if (i % 4 < 3) { ASSERT_EQ(std::bit_cast<int>(map->texels[i]), std::bit_cast<int>(made->texels[i])) << i; }
  }
  for (int k = 0; k < EnvironmentMap::kLevels; ++k) EXPECT_EQ(map->levels[k].size, made->levels[k].size);
  EXPECT_EQ(map->irradiance.offset, made->irradiance.offset);
  // Light comes from above and from the camera's side.
  const double up = lanes::IrradianceOverPi(*map, Vec3<double>{0, 1, 0}).x;
  EXPECT_GT(up, 1.2 * lanes::IrradianceOverPi(*map, Vec3<double>{0, -1, 0}).x);
}

}  // namespace
}  // namespace facet
