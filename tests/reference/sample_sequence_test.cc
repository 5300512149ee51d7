// The random points of the reference: even, uniform and independent.
#include "reference/sample_sequence.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

namespace facet {
namespace {

// Of any division of the square into 2^k boxes with sides of powers of two, each box holds one of 2^k points.
TEST(SampleSequence, AlignedRunsAreNets) {
  for (const std::uint64_t seed : {0u, 1u, 77u}) {
    const SampleSequence sequence(MixBits(seed));
    for (std::uint32_t pair : {0u, 3u}) {
      for (int k : {4, 8}) {
        const std::uint32_t count = 1u << k;
        for (std::uint32_t first : {0u, count, 5u * count}) {
          for (int a = 0; a <= k; ++a) {
            std::set<std::pair<int, int>> boxes;
            for (std::uint32_t i = 0; i < count; ++i) {
              const glm::dvec2 p = sequence.Point(pair, first + i);
              ASSERT_TRUE(p.x > 0.0 && p.x < 1.0 && p.y > 0.0 && p.y < 1.0);
              boxes.emplace(int(p.x * double(1 << a)), int(p.y * double(1 << (k - a))));
            }
            ASSERT_EQ(boxes.size(), count)
                << "seed " << seed << " pair " << pair << " from " << first << " sides " << a;
          }
        }
      }
    }
  }
}

// Each point alone is uniform over the seeds: without that, means would be biased.
TEST(SampleSequence, EveryPointIsUniformOverSeeds) {
  constexpr int kSeeds = 40000;
  for (std::uint32_t index : {0u, 1u, 6u, 1000u}) {
    int box[4][4] = {};
    for (int seed = 0; seed < kSeeds; ++seed) {
      const glm::dvec2 p = SampleSequence(MixBits(std::uint64_t(seed))).Point(2, index);
      ++box[int(p.x * 4.0)][int(p.y * 4.0)];
    }
    const double expected = kSeeds / 16.0;
    double chi2 = 0.0;
    for (const auto& row : box) {
      for (int n : row) chi2 += (n - expected) * (n - expected) / expected;
    }
    EXPECT_LT(chi2, 37.7) << index;  // of 15 degrees of freedom: exceeded once in a thousand
  }
}

// How many of a net's points lie before an edge: 85 or 86 of 256 before a third, and a third of the seeds give the
// latter.
TEST(SampleSequence, EdgesBetweenStrataAreNotBiased) {
  constexpr int kSeeds = 6000;
  int more[2] = {};
  for (int seed = 0; seed < kSeeds; ++seed) {
    int before[2] = {};
    for (std::uint32_t i = 0; i < 256; ++i) {
      const glm::dvec2 p = SampleSequence(MixBits(std::uint64_t(seed))).Point(0, i);
      for (int c = 0; c < 2; ++c) before[c] += p[c] < 1.0 / 3.0;
    }
    for (int c = 0; c < 2; ++c) {
      ASSERT_TRUE(before[c] == 85 || before[c] == 86);
      more[c] += before[c] == 86;
    }
  }
  for (int count : more) EXPECT_NEAR(double(count) / kSeeds, 1.0 / 3.0, 0.025);  // four standard deviations
}

TEST(SampleSequence, PairsAndSeedsAreIndependent) {
  constexpr std::uint32_t kCount = 4096;
  const SampleSequence one(MixBits(1)), other(MixBits(2));
  const auto correlation = [&](const SampleSequence& a, std::uint32_t pa, const SampleSequence& b, std::uint32_t pb) {
    double sum = 0.0;
    for (std::uint32_t i = 0; i < kCount; ++i) sum += (a.Point(pa, i).x - 0.5) * (b.Point(pb, i).x - 0.5);
    return sum / kCount * 12.0;
  };
  EXPECT_NEAR(correlation(one, 0, one, 0), 1.0, 0.01);
  EXPECT_NEAR(correlation(one, 0, one, 1), 0.0, 0.06);  // 4 / sqrt(4096)
  EXPECT_NEAR(correlation(one, 0, other, 0), 0.0, 0.06);
}

// The mean of a smooth function over N points of a net is off by much less than N^-1/2.
TEST(SampleSequence, ConvergesFasterThanChance) {
  const auto error = [](std::uint32_t count) {
    double sum2 = 0.0;
    constexpr int kSeeds = 64;
    for (int seed = 0; seed < kSeeds; ++seed) {
      const SampleSequence sequence(MixBits(std::uint64_t(seed)));
      double mean = 0.0;
      for (std::uint32_t i = 0; i < count; ++i) {
        const glm::dvec2 p = sequence.Point(0, i);
        mean += std::exp(p.x) * std::sqrt(p.y);
      }
      mean = mean / count - (std::exp(1.0) - 1.0) * (2.0 / 3.0);
      sum2 += mean * mean;
    }
    return std::sqrt(sum2 / kSeeds);
  };
  EXPECT_LT(error(1024), error(16) / 32.0);  // by chance it would be an eighth
}

}  // namespace
}  // namespace facet
