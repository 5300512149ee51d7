// Reading textures on lanes, against double precision written independently, on every instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "texture/sample_test.cc"
#include "hwy/foreach_target.h"
// Must come after foreach_target.h.
#include "facet/shader/dispatch.h"
#include "texture/sample-inl.h"

#ifndef FACET_TESTS_TEXTURE_SAMPLE_ONCE
#define FACET_TESTS_TEXTURE_SAMPLE_ONCE
namespace facet {

struct SampleTask {
  const BoundTexture* slot;
  const float* in;   // u, v, du/dx, dv/dx, du/dy, dv/dy: arrays of `count`
  int count;         // a multiple of 16
  float* rgba;       // 4 arrays
  float* footprint;  // lod, taps, major axis in uv: 4 arrays
};

}  // namespace facet
#endif

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace HWY_NAMESPACE {

void SampleAll(const SampleTask& task) {
  const int n = task.count;
  for (int i = 0; i < n; i += static_cast<int>(LaneCount())) {
    const auto number = [&](int k) HWY_ATTR { return LoadFloat(task.in + k * n + i); };
    const Vec2<Float> uv{number(0), number(1)}, dx{number(2), number(3)}, dy{number(4), number(5)};
    const Vec4<Float> c = SampleTexture<kRgba>(*task.slot, uv, dx, dy);
    Store(c.x, task.rgba + i);
    Store(c.y, task.rgba + n + i);
    Store(c.z, task.rgba + 2 * n + i);
    Store(c.w, task.rgba + 3 * n + i);
    const Footprint f = MakeFootprint(*task.slot, dx, dy);
    Store(f.lod, task.footprint + i);
    Store(f.taps, task.footprint + n + i);
    Store(f.major.x, task.footprint + 2 * n + i);
    Store(f.major.y, task.footprint + 3 * n + i);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace facet
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <glm/glm.hpp>
#include <random>

#include "texture/read_texel.h"

namespace facet {
namespace {

FACET_EXPORT(SampleAll);

using Rgba = std::array<double, 4>;

struct Query {
  float u = 0, v = 0, ux = 0, vx = 0, uy = 0, vy = 0;
};

struct Answer {
  Rgba color{};
  double lod = 0, taps = 0, major_u = 0, major_v = 0;
};

// Asks all available targets, which must answer with the same bits.
std::vector<Answer> Sample(const BoundTexture& slot, const std::vector<Query>& queries) {
  const int n = int(queries.size() + 15) / 16 * 16;
  std::vector<float> in(std::size_t(6 * n)), out(std::size_t(8 * n)), first;
  for (int i = 0; i < int(queries.size()); ++i) {
    const Query& q = queries[std::size_t(i)];
    const float numbers[6] = {q.u, q.v, q.ux, q.vx, q.uy, q.vy};
    for (int k = 0; k < 6; ++k) in[std::size_t(k * n + i)] = numbers[k];
  }
  for (Target target : {Target::Scalar, Target::Sse4, Target::Avx2, Target::Avx3, Target::Neon}) {
    if (!TargetIsAvailable(target)) continue;
    std::fill(out.begin(), out.end(), -1.0f);
    SampleAllForTarget(target)({&slot, in.data(), n, out.data(), out.data() + 4 * n});
    if (first.empty()) first = out;
    EXPECT_EQ(std::memcmp(first.data(), out.data(), out.size() * sizeof(float)), 0) << TargetName(target);
  }
  std::vector<Answer> answers(queries.size());
  for (std::size_t i = 0; i < queries.size(); ++i) {
    const auto at = [&](int k) { return double(first[std::size_t(k * n) + i]); };
    answers[i] = {{at(0), at(1), at(2), at(3)}, at(4), at(5), at(6), at(7)};
  }
  return answers;
}

class Uniform {
 public:
  explicit Uniform(unsigned seed) : random_(seed) {}
  double operator()(double low = 0.0, double high = 1.0) {
    return low + (high - low) * double(random_() >> 8) / 16777216.0;
  }

 private:
  std::mt19937 random_;
};

Image Image8(int width, int height, const std::function<double(int, int, int)>& value) {
  Image image;
  image.width = width;
  image.height = height;
  image.channels = 4;
  image.encoding = Encoding::Linear;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (int c = 0; c < 4; ++c) image.bytes.push_back(std::byte(int(std::lround(value(x, y, c) * 255.0))));
    }
  }
  return image;
}

Image Noise(int width, int height, unsigned seed) {
  Uniform random(seed);
  return Image8(width, height, [&](int, int, int) { return random(); });
}

// --- The reference: wraps and bilinear weights in double
// -----------------------------------------------------------------

int WrapIndex(Wrap wrap, long long i, int size) {
  if (wrap == Wrap::ClampToEdge) return int(std::min<long long>(std::max<long long>(i, 0), size - 1));
  const long long period = wrap == Wrap::Repeat ? size : 2ll * size;
  long long k = i % period;
  if (k < 0) k += period;
  return int(k < size ? k : period - 1 - k);
}

Rgba ReferenceLevel(const TextureData& t, const Sampler& sampler, int level, double u, double v, bool linear) {
  const double x = u * t.level_width[level] - (linear ? 0.5 : 0.0),
               y = v * t.level_height[level] - (linear ? 0.5 : 0.0);
  const double fx = linear ? x - std::floor(x) : 0.0, fy = linear ? y - std::floor(y) : 0.0;
  const auto ix = static_cast<long long>(std::floor(x)), iy = static_cast<long long>(std::floor(y));
  Rgba sum{};
  for (int dy = 0; dy < (linear ? 2 : 1); ++dy) {
    for (int dx = 0; dx < (linear ? 2 : 1); ++dx) {
      const Rgba c = ReadTexel(t, level, WrapIndex(sampler.wrap_u, ix + dx, t.level_width[level]),
                               WrapIndex(sampler.wrap_v, iy + dy, t.level_height[level]));
      const double w = (dx ? fx : 1.0 - fx) * (dy ? fy : 1.0 - fy);
      for (std::size_t k = 0; k < 4; ++k) sum[k] += w * c[k];
    }
  }
  return sum;
}

// How close a nearest lookup is to the border of two texels, in texels.
double BorderDistance(double u, int size) { return std::fabs(u * size - std::nearbyint(u * size)); }

// Weights are split in two along u and each of these along v, rounded to 1/16384; no texel differs from another by more
// than 1. With a second level, and the split between the two, it is less than 2.5 times that.
constexpr double kWeightError = 1.5 / 16384;

TEST(SampleTexture, NearestAndLinearOfAllWraps) {
  const int sizes[][2] = {{8, 8}, {16, 4}, {7, 5}, {1, 1}, {1, 9}, {13, 1}, {2, 3}};
  Uniform random(2);
  for (const auto& size : sizes) {
    const TextureData data = BuildTexture(Noise(size[0], size[1], 5), TextureRole::Data, false);
    for (Wrap wrap_u : {Wrap::Repeat, Wrap::MirroredRepeat, Wrap::ClampToEdge}) {
      for (Wrap wrap_v : {Wrap::Repeat, Wrap::MirroredRepeat, Wrap::ClampToEdge}) {
        for (Filter filter : {Filter::Nearest, Filter::Linear}) {
          BoundTexture slot;
          slot.data = &data;
          slot.sampler = {wrap_u, wrap_v, filter, filter, MipFilter::None};
          std::vector<Query> queries;
          for (int i = 0; i < 400; ++i) {
            const double reach = i % 4 == 0 ? 1.0 : i % 4 == 1 ? 3.0 : i % 4 == 2 ? 500.0 : 4e6;
            queries.push_back({float(random(-reach, reach)), float(random(-reach, reach))});
          }
          for (float edge :
               {0.0f, 1.0f, -1.0f, 2.0f, -2.0f, 0.5f, -1e6f, 1048576.5f, 8388607.0f, -16777216.0f, 1e30f, -1e30f, -1e-9f,
                -1e-30f}) {
            queries.push_back({edge, edge});
          }
          const std::vector<Answer> answers = Sample(slot, queries);
          for (std::size_t i = 0; i < queries.size(); ++i) {
            const double u = queries[i].u, v = queries[i].v;
            // Any texel will do, but it must be one: positions beyond all precision, and a hair left of a border.
            if (std::fabs(u) > 1e15 || (filter == Filter::Nearest && u < 0.0 && u > -1e-8)) {
              for (double c : answers[i].color) EXPECT_TRUE(c >= 0.0 && c <= 1.0);
              continue;
            }
            // u * size is rounded once: a texel's border may be missed by that.
            if (filter == Filter::Nearest && std::fabs(u) != 1e6 && i < 400 &&
                (BorderDistance(u, size[0]) < 1e-5 || BorderDistance(v, size[1]) < 1e-5)) {
              continue;
            }
            const Rgba expected = ReferenceLevel(data, slot.sampler, 0, u, v, filter == Filter::Linear);
            for (std::size_t k = 0; k < 4; ++k) {
              ASSERT_NEAR(answers[i].color[k], expected[k], filter == Filter::Nearest ? 1e-6 : kWeightError + 4e-6)
                  << size[0] << " x " << size[1] << " wraps " << int(wrap_u) << int(wrap_v) << " filter " << int(filter)
                  << " at " << u << ", " << v;
            }
          }
        }
      }
    }
  }
}

TEST(SampleTexture, CoordinatesThatAreNotFiniteReadATexel) {
  const TextureData data = BuildTexture(Noise(8, 8, 5), TextureRole::Data, true);
  const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
  for (Wrap wrap : {Wrap::Repeat, Wrap::MirroredRepeat, Wrap::ClampToEdge}) {
    BoundTexture slot;
    slot.data = &data;
    slot.sampler.wrap_u = slot.sampler.wrap_v = wrap;
    std::vector<Query> queries;
    for (float bad : {nan, infinity, -infinity, 3e38f}) {
      queries.push_back({bad, 0.5f});
      queries.push_back({0.5f, bad});
      queries.push_back({0.5f, 0.5f, bad});
      queries.push_back({0.5f, 0.5f, 0.1f, 0.2f, bad, bad});
      queries.push_back({bad, bad, bad, bad, bad, bad});
    }
    for (const Answer& answer : Sample(slot, queries)) {
      for (double c : answer.color) EXPECT_TRUE(c >= 0.0 && c <= 1.0) << c;
    }
  }
}

// --- Level of detail ------------------------------------------------------------------------------------------------

// Singular values of [a b; c d], from the characteristic polynomial in long double.
void SingularValues(double a, double b, double c, double d, double& major, double& minor) {
  const long double s = (long double)a * a + (long double)b * b + (long double)c * c + (long double)d * d;
  const long double det = std::fabs((long double)a * d - (long double)b * c);
  const long double gap = std::sqrt(std::max<long double>(s * s - 4 * det * det, 0));
  major = double(std::sqrt((s + gap) / 2));
  minor = double(det / std::sqrt((s + gap) / 2));
}

TEST(SampleTexture, TheFootprintsAxesAreSingularValues) {
  Uniform random(4);
  const int sizes[][2] = {{64, 64}, {256, 16}, {8, 128}, {100, 30}};
  for (const auto& size : sizes) {
    const TextureData data = BuildTexture(Noise(size[0], size[1], 6), TextureRole::Data, true);
    for (float max_anisotropy : {1.0f, 4.0f, 16.0f}) {
      BoundTexture slot;
      slot.data = &data;
      slot.max_anisotropy = max_anisotropy;
      std::vector<Query> queries;
      for (int i = 0; i < 2000; ++i) {
        const double scale = std::exp2(random(-9, 2));
        const double squeeze = i % 2 ? std::exp2(random(-4, 0)) : 1.0, angle = random(0, 6.283),
                     turn = random(0, 6.283);
        // rotation * diag(1, squeeze) * rotation, in texels; then to uv
        const double c = std::cos(angle), s = std::sin(angle), ct = std::cos(turn), st = std::sin(turn);
        const double texels = scale * 64;
        const double m00 = texels * (c * ct - squeeze * s * st), m01 = texels * (-c * st - squeeze * s * ct);
        const double m10 = texels * (s * ct + squeeze * c * st), m11 = texels * (-s * st + squeeze * c * ct);
        queries.push_back(
            {0.5f, 0.5f, float(m00 / size[0]), float(m10 / size[1]), float(m01 / size[0]), float(m11 / size[1])});
      }
      const std::vector<Answer> answers = Sample(slot, queries);
      for (std::size_t i = 0; i < queries.size(); ++i) {
        const Query& q = queries[i];
        double major = 0, minor = 0;
        SingularValues(double(q.ux) * size[0], double(q.uy) * size[0], double(q.vx) * size[1], double(q.vy) * size[1],
                       major, minor);
        const double ratio = major / minor;
        // Taps: enough that one covers no more than the minor axis, up to the limit. A ratio at a whole number may go
        // either way.
        double taps = major > 1.0 ? std::min(std::ceil(ratio), double(max_anisotropy)) : 1.0;
        if (std::fabs(ratio - std::nearbyint(ratio)) < 1e-3 || std::fabs(major - 1.0) < 1e-4) taps = answers[i].taps;
        ASSERT_EQ(answers[i].taps, taps) << ratio << " " << major;
        ASSERT_NEAR(answers[i].lod, std::log2(std::max(major / taps, minor)), 2e-3) << ratio << " " << major;
        if (taps > 1.0 && ratio > 1.01) {  // a circle has no axes
          // The axis is the image of the direction that is stretched most: as long as the largest singular value.
          const double au = answers[i].major_u * size[0], av = answers[i].major_v * size[1];
          ASSERT_NEAR(std::hypot(au, av) / major, 1.0, 1e-4) << ratio;
          // |M^T axis| = major * |axis| for the left singular vector alone.
          const double tx = double(q.ux) * size[0] * au + double(q.vx) * size[1] * av;
          const double ty = double(q.uy) * size[0] * au + double(q.vy) * size[1] * av;
          ASSERT_NEAR(std::hypot(tx, ty) / (major * std::hypot(au, av)), 1.0, 1e-4) << ratio;
        }
      }
    }
  }
}

// The mean of a periodic function over a pixel's parallelogram, by 64 x 64 samples.
double FootprintMean(const std::function<double(double, double)>& f, const Query& q) {
  double sum = 0.0;
  for (int j = 0; j < 64; ++j) {
    for (int i = 0; i < 64; ++i) {
      const double a = (i + 0.5) / 64 - 0.5, b = (j + 0.5) / 64 - 0.5;
      sum += f(q.u + a * q.ux + b * q.uy, q.v + a * q.vx + b * q.vy);
    }
  }
  return sum / 4096.0;
}

constexpr double kTau = 6.283185307179586;

// A smooth image of waves of at most 1/8 of the texture's frequency limit: what a pixel shows must be near the true
// mean over it, whichever way the footprint is stretched. Trilinear filtering blurs more than a box does; the bounds
// are those of that blur: the box of a level twice as coarse.
TEST(SampleTexture, SmoothImagesAreAveragedOverTheFootprint) {
  Uniform random(8);
  const int sizes[][2] = {{128, 128}, {256, 64}};
  for (const auto& size : sizes) {
    const int width = size[0], height = size[1];
    const auto wave = [](double u, double v) {
      return 0.5 + 0.2 * std::sin(kTau * (3 * u + 2 * v)) + 0.2 * std::cos(kTau * (4 * v - u));
    };
    const TextureData data = BuildTexture(
        Image8(width, height, [&](int x, int y, int) { return wave((x + 0.5) / width, (y + 0.5) / height); }),
        TextureRole::Data, true);
    BoundTexture slot;
    slot.data = &data;
    slot.max_anisotropy = 16.0f;
    std::vector<Query> queries;
    for (int i = 0; i < 320; ++i) {
      const double length = std::exp2(random(-9, -3.5)), ratio = i % 2 ? random(1, 12) : 1.0;
      const double angle = random(0, kTau), skew = i % 4 == 3 ? random(-0.6, 0.6) : 0.0;
      const double c = std::cos(angle) * length, s = std::sin(angle) * length;
      queries.push_back({float(random(-2, 2)), float(random(-2, 2)), float(c), float(s), float((-s + skew * c) / ratio),
                         float((c + skew * s) / ratio)});
    }
    const std::vector<Answer> answers = Sample(slot, queries);
    double worst = 0.0, squares = 0.0;
    for (std::size_t i = 0; i < queries.size(); ++i) {
      const double error = std::fabs(answers[i].color[0] - FootprintMean(wave, queries[i]));
      squares += error * error;
      worst = std::max(worst, error);
      // Waves have |f''| <= 0.2 (2 pi)^2 (13 + 17); a tent of one level and the next instead of a box has a variance
      // that is larger by less than (2 level texels)^2 / 4; half of that times f'' is what the blur can change, plus
      // the image's 8 bits and bilinear interpolation at level 0.
      const double texel_u = std::exp2(std::max(answers[i].lod, 0.0)) / std::min(width, height);
      const double bound = 0.5 * 0.2 * kTau * kTau * 30.0 * texel_u * texel_u + 4e-3;
      ASSERT_LE(error, bound) << i << " lod " << answers[i].lod << " taps " << answers[i].taps;
    }
    EXPECT_LT(std::sqrt(squares / double(queries.size())), 0.02) << width << " x " << height << ", worst " << worst;
  }
}

// A checkerboard of single texels: where a pixel covers many, it must be grey, in all directions.
TEST(SampleTexture, MinifiedPatternsDoNotAlias) {
  const TextureData checker =
      BuildTexture(Image8(256, 256, [](int x, int y, int) { return double((x + y) & 1); }), TextureRole::Data, true);
  const TextureData zone =
      BuildTexture(Image8(256, 256,
                          [](int x, int y, int) {
                            const double dx = x - 127.5, dy = y - 127.5;  // frequency reaches the limit at the border
                            return 0.5 + 0.5 * std::cos(3.14159265358979 * (dx * dx + dy * dy) / 256.0);
                          }),
                   TextureRole::Data, true);
  Uniform random(9);
  for (const TextureData* data : {&checker, &zone}) {
    BoundTexture slot;
    slot.data = data;
    slot.max_anisotropy = 16.0f;
    slot.sampler.wrap_u = slot.sampler.wrap_v = Wrap::Repeat;
    std::vector<Query> queries;
    for (int i = 0; i < 1000; ++i) {
      const double texels = std::exp2(random(2, 6)), ratio = random(1, 8), angle = random(0, kTau);
      const double c = std::cos(angle) * texels / 256, s = std::sin(angle) * texels / 256;
      // The minor axis is four texels at least.
      const double squeeze = std::max(1.0 / ratio, std::min(1.0, 4.0 / texels));
      float u = float(random()), v = float(random());
      if (data == &zone) {  // stay in the outer part, where no wave is longer than four texels
        u = float(random(0.6, 0.75)) + (i % 2 ? 0.0f : -0.35f);
        v = float(random(0.85, 0.95));
      }
      queries.push_back({u, v, float(c), float(s), float(-s * squeeze), float(c * squeeze)});
    }
    for (std::size_t i = 0; const Answer& answer : Sample(slot, queries)) {
      if (data == &checker) {
        ASSERT_NEAR(answer.color[0], 0.5, 0.003) << i << " lod " << answer.lod;
      } else if (answer.lod < 4.0) {  // coarser levels reach the zone's middle, which is not grey
        ASSERT_NEAR(answer.color[0], 0.5, 0.12) << i << " lod " << answer.lod;
      }
      ++i;
    }
  }
}

TEST(SampleTexture, MagnifiedIsBilinearInLevelZero) {
  const TextureData data = BuildTexture(Noise(32, 16, 12), TextureRole::Data, true);
  BoundTexture slot;
  slot.data = &data;
  Uniform random(13);
  std::vector<Query> queries;
  for (int i = 0; i < 1000; ++i) {
    const float d = float(random(0.0, 0.7) / 32);  // at most one texel of either axis
    queries.push_back({float(random(-3, 3)), float(random(-3, 3)), d, 0.5f * d, -0.5f * d, d});
  }
  queries.push_back({0.3f, 0.4f});  // no derivatives at all
  const std::vector<Answer> answers = Sample(slot, queries);
  for (std::size_t i = 0; i < queries.size(); ++i) {
    const Rgba expected = ReferenceLevel(data, slot.sampler, 0, queries[i].u, queries[i].v, true);
    for (std::size_t k = 0; k < 4; ++k) ASSERT_NEAR(answers[i].color[k], expected[k], kWeightError + 4e-6) << i;
  }
}

// However many texels are weighed, the weights sum to one without error: a constant stays what it is.
TEST(SampleTexture, ConstantsAreExact) {
  Uniform random(16);
  for (const TexelBits bits : {TexelBits::Eight, TexelBits::Sixteen}) {
    for (int code = 0; code < 256; code += 3) {
      const Image image = Image8(24, 16, [&](int, int, int c) { return (c % 2 == 0 ? code : 255 - code) / 255.0; });
      const TextureData data = BuildTexture(image, TextureRole::Data, true, bits);
      BoundTexture slot;
      slot.data = &data;
      slot.max_anisotropy = 16.0f;
      std::vector<Query> queries;
      for (int i = 0; i < 64; ++i) {
        const auto number = [&] { return float(random(-1, 1) * std::exp2(random(-8, 2))); };
        queries.push_back({float(random(-3, 3)), float(random(-3, 3)), number(), number(), number(), number()});
      }
      for (const Answer& answer : Sample(slot, queries)) {
        for (std::size_t c = 0; c < 4; ++c) {
          const int expected = c % 2 == 0 ? code : 255 - code;
          ASSERT_NEAR(answer.color[c], expected / 255.0, 1.2e-7) << code;  // a unit in the last place of a float
          if (expected % 255 == 0) {
            ASSERT_EQ(answer.color[c], expected / 255);
          }
        }
      }
    }
  }
}

// Each filter that glTF names, where it can be told: isotropic footprints of a known level.
TEST(SampleTexture, MipFiltersChooseTheirLevels) {
  const TextureData data = BuildTexture(Noise(64, 64, 14), TextureRole::Data, true);
  Uniform random(15);
  for (MipFilter mip : {MipFilter::None, MipFilter::Nearest, MipFilter::Linear}) {
    for (Filter magnification : {Filter::Nearest, Filter::Linear}) {
      for (Filter minification : {Filter::Nearest, Filter::Linear}) {
        BoundTexture slot;
        slot.data = &data;
        slot.sampler = {Wrap::Repeat, Wrap::MirroredRepeat, magnification, minification, mip};
        slot.max_anisotropy = 1.0f;
        std::vector<Query> queries;
        std::vector<double> lods;
        for (int i = 0; i < 300; ++i) {
          const double lod = random(-2, 8);
          const float d = float(std::exp2(lod) / 64.0);
          if (std::fabs(lod - std::floor(lod) - 0.5) < 0.01 || std::fabs(lod) < 0.01) continue;
          lods.push_back(lod);
          queries.push_back({float(random(-2, 2)), float(random(-2, 2)), d, 0, 0, d});
        }
        const std::vector<Answer> answers = Sample(slot, queries);
        for (std::size_t i = 0; i < queries.size(); ++i) {
          const Query& q = queries[i];
          const bool linear = (lods[i] <= 0.0 ? magnification : minification) == Filter::Linear;
          const double lod = std::min(std::max(lods[i], 0.0), double(data.levels - 1));
          const double blend = mip == MipFilter::Linear ? lod - std::floor(lod) : 0.0;
          const int fine = mip == MipFilter::None      ? 0
                           : mip == MipFilter::Nearest ? int(std::floor(lod + 0.5))
                                                       : int(std::floor(lod));
          bool on_border = false;
          for (int level : {fine, std::min(fine + 1, data.levels - 1)}) {
            on_border |= !linear && (BorderDistance(q.u, data.level_width[level]) < 1e-4 ||
                                     BorderDistance(q.v, data.level_height[level]) < 1e-4);
          }
          if (on_border) continue;
          const Rgba a = ReferenceLevel(data, slot.sampler, fine, q.u, q.v, linear);
          const Rgba b = ReferenceLevel(data, slot.sampler, std::min(fine + 1, data.levels - 1), q.u, q.v, linear);
          for (std::size_t k = 0; k < 4; ++k) {
            ASSERT_NEAR(answers[i].color[k], a[k] * (1 - blend) + b[k] * blend, 2.5 * kWeightError)
                << int(mip) << int(magnification) << int(minification) << " lod " << lods[i];
          }
        }
      }
    }
  }
}

// --- KHR_texture_transform
// ---------------------------------------------------------------------------------------------

// The extension's own GLSL: matrix products T * R * S of column-major mat3, R = (cos, -sin, 0, sin, cos, 0, 0, 0, 1).
TEST(SetTransform, IsTranslationTimesRotationTimesScale) {
  Uniform random(16);
  for (int i = 0; i < 200; ++i) {
    TextureRef ref;
    ref.offset = {random(-3, 3), random(-3, 3)};
    ref.scale = {random(-3, 3), random(-3, 3)};
    ref.rotation = float(random(-7, 7));
    const double c = std::cos(double(ref.rotation)), s = std::sin(double(ref.rotation));
    const glm::dmat3 translation(1, 0, 0, 0, 1, 0, ref.offset.x, ref.offset.y, 1), rotation(c, -s, 0, s, c, 0, 0, 0, 1),
        scale(ref.scale.x, 0, 0, 0, ref.scale.y, 0, 0, 0, 1);
    const glm::dmat3 all = translation * rotation * scale;
    BoundTexture slot;
    SetTransform(ref, slot);
    for (int row = 0; row < 2; ++row) {
      for (int column = 0; column < 3; ++column) ASSERT_NEAR(slot.transform[3 * row + column], all[column][row], 1e-6);
    }
  }
}

TEST(SetTransform, QuarterTurnsAreCounterClockwiseOnTheImage) {
  // A quarter turn with v down: what lay at u = 1 on the top edge, (1, 0), is read from (0, -1): one texture height up.
  TextureRef ref;
  ref.rotation = 1.5707963267948966f;
  BoundTexture slot;
  SetTransform(ref, slot);
  EXPECT_NEAR(slot.transform[0] * 1.0 + slot.transform[1] * 0.0, 0.0, 1e-6);
  EXPECT_NEAR(slot.transform[3] * 1.0 + slot.transform[4] * 0.0, -1.0, 1e-6);
  EXPECT_NEAR(slot.transform[1], 1.0, 1e-6);
  EXPECT_NEAR(slot.transform[4], 0.0, 1e-6);
}

// The transform moves coordinates and derivatives alike.
TEST(SetTransform, AppliesToCoordinatesAndDerivatives) {
  const TextureData data = BuildTexture(Noise(64, 64, 17), TextureRole::Data, true);
  BoundTexture plain, turned;
  plain.data = turned.data = &data;
  TextureRef ref;
  ref.offset = {0.3f, -0.2f};
  ref.scale = {4.0f, 0.5f};
  ref.rotation = 0.6f;
  SetTransform(ref, turned);
  const float* m = turned.transform;
  Uniform random(18);
  std::vector<Query> before, after;
  for (int i = 0; i < 500; ++i) {
    const Query q{float(random(-2, 2)),   float(random(-2, 2)),   float(random(-.1, .1)),
                  float(random(-.1, .1)), float(random(-.1, .1)), float(random(-.1, .1))};
    before.push_back(q);
    after.push_back({m[0] * q.u + m[1] * q.v + m[2], m[3] * q.u + m[4] * q.v + m[5], m[0] * q.ux + m[1] * q.vx,
                     m[3] * q.ux + m[4] * q.vx, m[0] * q.uy + m[1] * q.vy, m[3] * q.uy + m[4] * q.vy});
  }
  const std::vector<Answer> a = Sample(turned, before), b = Sample(plain, after);
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t k = 0; k < 4; ++k) ASSERT_EQ(a[i].color[k], b[i].color[k]) << i;
  }
}

}  // namespace
}  // namespace facet
#endif
