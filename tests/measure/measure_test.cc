// What a report measures with: errors against a part of the reference, FLIP of parts, and times that noise does not
// turn into differences.
#include "measure/measure.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <vector>

#include "facet/compare.h"
#include "facet/film.h"

namespace facet::test {
namespace {

constexpr int kWidth = 200, kHeight = 152;

// Smooth, with fine detail in places, and see-through at the left.
glm::dvec4 PixelAt(int x, int y) {
  const double alpha = x < 40 ? x / 40.0 : 1.0;
  const double wave = 0.5 + 0.4 * std::sin(0.05 * x) * std::cos(0.07 * y), grain = (x * 7 + y * 13) % 11 / 40.0;
  return glm::dvec4(wave, 0.5 * wave + grain, 1.0 - wave, 1.0) * alpha;
}

ReferenceFilm WholeReference() {
  ReferenceFilm reference;
  reference.width = kWidth;
  reference.height = kHeight;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) reference.pixels.push_back(PixelAt(x, y));
  }
  reference.blocks = SpreadBlocks(kWidth, kHeight, 0);
  reference.known_pixels = reference.pixels.size();
  reference.whole = true;
  return reference;
}

// The first blocks of another order.
ReferenceFilm PartOfIt(std::uint64_t seed, std::size_t count) {
  ReferenceFilm reference = WholeReference();
  reference.blocks = SpreadBlocks(kWidth, kHeight, seed);
  reference.blocks.resize(count);
  reference.whole = false;
  reference.known_pixels = 0;
  for (const PixelBlock& block : reference.blocks) reference.known_pixels += std::size_t(block.width * block.height);
  return reference;
}

// Off by more towards the lower right, and now and then by much.
Film OffFilm() {
  Film film{kWidth, kHeight, {}};
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const double off = 0.02 * (x + y) / kWidth + ((x * 31 + y * 17) % 97 == 0 ? 0.2 : 0.0);
      film.pixels.emplace_back(PixelAt(x, y) + glm::dvec4(off, -off, 0.5 * off, 0.0));
    }
  }
  return film;
}

TEST(ErrorAgainstAReference, OfAllOfItIsThatAgainstItsFilm) {
  const ReferenceFilm reference = WholeReference();
  const Film film = OffFilm();
  const FilmError a = ErrorOf(film, reference), b = ErrorOf(film, ToFilm(reference));
  EXPECT_NEAR(a.relative_rmse, b.relative_rmse, 1e-6);
  EXPECT_NEAR(a.rmse, b.rmse, 1e-6);
  EXPECT_NEAR(a.largest, b.largest, 1e-6);
  EXPECT_EQ(a.standard_error, 0.0);
}

TEST(ErrorAgainstAReference, LooksOnlyAtWhatThatKnows) {
  ReferenceFilm reference = PartOfIt(3, 10);
  Film film = ToFilm(WholeReference());
  const PixelBlock& known = reference.blocks[4];
  std::vector<bool> is_known(film.pixels.size(), false);
  for (const PixelBlock& block : reference.blocks) {
    for (int y = block.y; y < block.y + block.height; ++y) {
      for (int x = block.x; x < block.x + block.width; ++x) is_known[std::size_t(y * kWidth + x)] = true;
    }
  }
  for (std::size_t i = 0; i < film.pixels.size(); ++i) {
    if (!is_known[i]) film.pixels[i] = glm::vec4(1e6f);
  }
  EXPECT_LT(ErrorOf(film, reference).largest, 1e-6);
  film.pixels[std::size_t(known.y * kWidth + known.x)].y += 0.25f;
  const FilmError error = ErrorOf(film, reference);
  EXPECT_NEAR(error.largest, 0.25, 1e-6);
  EXPECT_NEAR(error.rmse, 0.25 / std::sqrt(3.0 * double(reference.known_pixels)), 1e-6);
}

// Errors over a part spread about the whole's as the standard error says, which makes no use of the blocks' being
// spread evenly: blocks drawn at random.
TEST(ErrorAgainstAReference, OfAPartIsAsUncertainAsItSays) {
  const Film film = OffFilm();
  const double whole = ErrorOf(film, WholeReference()).relative_rmse;
  constexpr int kDraws = 400;
  std::mt19937 random(1);
  double off2 = 0.0, said2 = 0.0, mean = 0.0;
  for (int draw = 0; draw < kDraws; ++draw) {
    ReferenceFilm part = WholeReference();
    std::shuffle(part.blocks.begin(), part.blocks.end(), random);
    part.blocks.resize(part.blocks.size() / 3);
    part.whole = false;
    part.known_pixels = 0;
    for (const PixelBlock& block : part.blocks) part.known_pixels += std::size_t(block.width * block.height);
    const FilmError error = ErrorOf(film, part);
    mean += error.relative_rmse / kDraws;
    off2 += (error.relative_rmse - whole) * (error.relative_rmse - whole) / kDraws;
    said2 += error.standard_error * error.standard_error / kDraws;
  }
  EXPECT_NEAR(mean, whole, 0.02 * whole);
  EXPECT_GT(off2, 0.0);
  EXPECT_NEAR(std::sqrt(said2 / off2), 1.0, 0.15);
}

TEST(FlipOfAReport, IsThatOfCompareImagesWhereTheReferenceIsWhole) {
  const ReferenceFilm reference = WholeReference();
  for (const bool opaque : {false, true}) {
    DisplaySettings display;
    if (opaque) display.background_srgb = glm::vec3(0.2f);
    const Image a = EncodeFilm(ToFilm(reference), display), b = EncodeFilm(OffFilm(), display);
    const FlipJudge judge(reference, a);
    const FlipJudge::Verdict verdict = judge.Judge(b);
    const ImageDifference difference = CompareImages(a, b);
    EXPECT_GT(difference.flip_mean, 0.01);
    EXPECT_NEAR(verdict.mean, difference.flip_mean, 1e-12);
    const float* expected = difference.flip_map.As<float>();
    EXPECT_TRUE(std::equal(verdict.errors.begin(), verdict.errors.end(), expected));
    const Image map = judge.Map(verdict, kWidth);
    EXPECT_EQ(map.bytes, HeatMap(difference).bytes);
    EXPECT_EQ(judge.Map(verdict, 100).width, 100);
  }
}

// A few per cent off, for the blocks' borders.
TEST(FlipOfAReport, OfPartsIsNearlyThatOfTheWhole) {
  const Image reference = EncodeFilm(ToFilm(WholeReference()), {}), test = EncodeFilm(OffFilm(), {});
  const double whole = CompareImages(reference, test).flip_mean;
  const ReferenceFilm all_blocks = PartOfIt(0, SpreadBlocks(kWidth, kHeight, 0).size());
  EXPECT_NEAR(FlipJudge(all_blocks, reference).Judge(test).mean, whole, 0.06 * whole);
}

TEST(FlipOfAReport, IsTransparentWhereNothingIsKnown) {
  ReferenceFilm reference = PartOfIt(0, 20);
  const Image encoded = EncodeFilm(ToFilm(WholeReference()), {});
  const FlipJudge judge(reference, encoded);
  const FlipJudge::Verdict verdict = judge.Judge(EncodeFilm(OffFilm(), {}));
  const Image map = judge.Map(verdict, kWidth);
  ASSERT_EQ(map.channels, 4);
  std::vector<int> alpha(map.PixelCount(), 0);
  for (const PixelBlock& block : reference.blocks) {
    for (int y = block.y; y < block.y + block.height; ++y) {
      for (int x = block.x; x < block.x + block.width; ++x) alpha[std::size_t(y * kWidth + x)] = 255;
    }
  }
  for (std::size_t i = 0; i < alpha.size(); ++i) {
    ASSERT_EQ(std::to_integer<int>(map.bytes[4 * i + 3]), alpha[i]) << i;
    if (alpha[i] == 0) {
      ASSERT_EQ(verdict.errors[i], 0.0f);
    }
  }
  // The mean of what is known only, also where a pixel of the small map is half known.
  FlipJudge::Verdict even = verdict;
  for (std::size_t i = 0; i < alpha.size(); ++i) even.errors[i] = alpha[i] > 0 ? 0.5f : 0.0f;
  const auto colors = [](const Image& rgba) {
    std::set<std::vector<std::byte>> found;
    for (std::size_t i = 0; i < rgba.PixelCount(); ++i) {
      const auto pixel = rgba.bytes.begin() + std::ptrdiff_t(4 * i);
      if (pixel[3] != std::byte{0}) found.insert({pixel, pixel + 4});
    }
    return found;
  };
  EXPECT_EQ(colors(judge.Map(even, kWidth)).size(), 1u);
  EXPECT_EQ(colors(judge.Map(even, 12)), colors(judge.Map(even, kWidth)));
}

// Four points that take 1 to 4 ms; `slow` says by what factor the machine is slower in its n-th run.
template <class Slow>
std::vector<PointTime> TimesWith(int rounds, const Slow& slow) {
  std::vector<std::vector<double>> all;
  int run = 0;
  for (int round = 0; round < rounds; ++round) {
    std::vector<double>& seconds = all.emplace_back(4);
    for (int i = 0; i < 4; ++i) {
      const int point = round % 2 == 0 ? i : 3 - i;
      seconds[std::size_t(point)] = 1e-3 * (point + 1) * slow(run++);
    }
  }
  return TimesOf(all);
}

TEST(TimesOfPoints, AreTheirMediansOnAQuietMachine) {
  const std::vector<PointTime> times = TimesWith(5, [](int) { return 1.0; });
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(times[i].median, 1e-3 * double(i + 1), 1e-15);
    EXPECT_EQ(times[i].low, times[i].high);
  }
  EXPECT_EQ(TimesOf({{0.0, 0.0}})[1].median, 0.0);  // a clock that stands still
}

// Wherever and however long the machine is eight times slower, no point takes part in it more than others.
TEST(TimesOfPoints, OfAMachineThatIsSlowForAWhileKeepTheirRatios) {
  for (const int rounds : {5, 7}) {
    for (int begin = 0; begin < 4 * rounds; ++begin) {
      for (int end = begin; end <= 4 * rounds; ++end) {
        const auto times = TimesWith(rounds, [&](int run) { return run >= begin && run < end ? 8.0 : 1.0; });
        for (std::size_t i = 0; i < 4; ++i) {
          EXPECT_GE(times[i].median, times[i].low);
          EXPECT_LE(times[i].median, times[i].high);
          EXPECT_NEAR(times[i].median / times[0].median, double(i + 1), 1e-9)
              << rounds << " rounds, slow from run " << begin << " to " << end;
        }
      }
    }
  }
}

}  // namespace
}  // namespace facet::test
