// Reports by a clock that the test sets: they have points in any budget, keep to it, do not mistake noise for
// differences, and say early what is out of reach.
#include "measure/measure_errors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "cli/scratch.h"
#include "facet/error.h"
#include "image/codec.h"

namespace facet::test {
namespace {

const std::string kGrid = std::string(FACET_SOURCE_DIR) + "/assets/scenes/material_grid.glb";

// Goes on by `tick(now)` seconds whenever somebody looks at it: so long a rendering takes, and a block of the
// reference.
class TestClock {
 public:
  explicit TestClock(std::function<double(double)> tick) : tick_(std::move(tick)) {}
  explicit TestClock(double tick) : TestClock([tick](double) { return tick; }) {}
  TestClock(const TestClock&) = delete;

  Clock AsClock() {
    return [this] {
      const std::lock_guard lock(mutex_);
      return now_ += tick_(now_);
    };
  }
  double Now() const { return now_; }

 private:
  std::mutex mutex_;
  double now_ = 1000.0;
  std::function<double(double)> tick_;
};

// Few looks fill the half of the budget that the reference has, so that it is soon made; many fit into the other.
std::function<double(double)> CoarseThenFine(double budget, double fine) {
  return [=](double now) { return now - 1000.0 < 0.5 * budget ? budget / 60.0 : fine; };
}

ErrorReport Measure(TestClock& clock, const std::string& size, double budget, const Bound& bound = {},
                    const std::string& scene = kGrid, const SettingsText& more = {}) {
  ReportSettings settings;
  settings.budget_seconds = budget;
  settings.bound = bound;
  settings.threads = 1;  // one thread looks at the clock as often as it did before
  SettingsText text = more;
  text["size"] = size;
  return MeasureErrorsBy(clock.AsClock(), scene, text, settings);
}

TEST(MeasuredErrors, SayWhatTheyMeasured) {
  TestClock clock(CoarseThenFine(60.0, 0.2));
  const ErrorReport report = Measure(clock, "24x24", 60.0);
  EXPECT_LE(report.seconds, 60.0);
  EXPECT_EQ(report.out_of_reach, "");
  EXPECT_EQ(report.settings.at("size"), "24x24");
  EXPECT_GT(report.reference.batches, 2);
  EXPECT_EQ(report.reference.pixels, 24u * 24u);
  EXPECT_FALSE(report.reference.image_png.empty());
  ASSERT_GE(report.points.size(), 10u);
  EXPECT_TRUE(report.points[0].changed.empty());
  std::set<SettingsText> settings;
  for (const ReportPoint& point : report.points) {
    EXPECT_TRUE(settings.insert(point.changed).second) << "measured twice";
    EXPECT_EQ(point.runs, report.points[0].runs);
    EXPECT_GE(point.runs, 2);
    EXPECT_GT(point.seconds, 0.0);
    EXPECT_LE(point.seconds_low, point.seconds);
    EXPECT_GE(point.seconds_high, point.seconds);
    EXPECT_GT(point.error.relative_rmse, 0.0);
    EXPECT_LT(point.error.relative_rmse, 1.0) << "the renderer draws what the reference draws";
    EXPECT_EQ(point.error.standard_error, 0.0) << "of all pixels";
    EXPECT_GT(point.error.flip, 0.0);
    EXPECT_FALSE(point.image_png.empty());
    EXPECT_FALSE(point.error_map_png.empty());
    const bool beaten = std::any_of(report.points.begin(), report.points.end(), [&](const ReportPoint& other) {
      return other.error.relative_rmse < point.error.relative_rmse && other.seconds < point.seconds;
    });
    EXPECT_FALSE(beaten && point.pareto);
  }
  // Fewer coverage samples leave more error; the material grid has no textures, whose approximations are left out.
  std::set<std::string> costs;
  for (const ApproximationCost& cost : report.costs) {
    costs.insert(cost.option);
    EXPECT_GT(cost.seconds_used, 0.0);
    EXPECT_GT(cost.seconds_cheapest, 0.0);
    EXPECT_GT(cost.seconds_most_exact, 0.0);
    EXPECT_EQ(cost.error_used, report.points[0].error.relative_rmse);
    if (cost.option == "samples") {
      EXPECT_GT(cost.error_cheapest, cost.error_most_exact);
      EXPECT_GT(cost.change, 0.0);
    }
  }
  EXPECT_TRUE(costs.contains("samples") && costs.contains("environment-samples"));
  EXPECT_FALSE(costs.contains("max-anisotropy") || costs.contains("texels") || costs.contains("mip-filter"));
  ASSERT_TRUE(report.rounding);
  EXPECT_GT(report.rounding->relative_rmse, 0.0);
  EXPECT_LT(report.rounding->relative_rmse, 1e-4);
}

// However slow the machine is: what there is no time for is left out, of the reference's image too.
TEST(MeasuredErrors, HaveAPointInAnyBudget) {
  for (const double tick : {0.3, 3.0, 1000.0}) {
    TestClock clock(tick);
    const ErrorReport report = Measure(clock, "240x200", 1.0);
    ASSERT_EQ(report.points.size(), 1u);
    EXPECT_TRUE(report.points[0].changed.empty());
    EXPECT_EQ(report.points[0].runs, 1);
    EXPECT_GT(report.points[0].error.relative_rmse, 0.0);
    EXPECT_LT(report.points[0].error.relative_rmse, 1.0);
    EXPECT_GT(report.points[0].error.standard_error, 0.0);
    EXPECT_GT(report.points[0].error.flip, 0.0);
    EXPECT_GT(report.points[0].seconds, 0.0);
    EXPECT_GT(report.reference.pixels, 0u);
    EXPECT_LT(report.reference.pixels, 240u * 200u);
    EXPECT_EQ(report.reference.batches, 2);
    EXPECT_FALSE(report.complete);
    EXPECT_GT(report.planned_points, 8u);
  }
}

// The reference takes half of the budget, and no more of the image than fits in there.
TEST(MeasuredErrors, OfAPartOfTheImageAreNearThoseOfAllOfIt) {
  const auto then_coarse = [](double fine) { return [=](double now) { return now < 1001.5 ? fine : 0.5; }; };
  TestClock unhurried(then_coarse(0.008)), hurried(then_coarse(0.02));
  const ErrorReport whole = Measure(unhurried, "200x200", 3.0), part = Measure(hurried, "200x200", 3.0);
  EXPECT_EQ(whole.reference.pixels, 40000u);
  EXPECT_GT(part.reference.pixels, 10000u);
  EXPECT_LT(part.reference.pixels, 30000u);
  const FilmError &a = whole.points[0].error, &b = part.points[0].error;
  EXPECT_GT(b.standard_error, 0.0);
  EXPECT_LT(b.standard_error, 0.3 * a.relative_rmse);
  EXPECT_NEAR(b.relative_rmse, a.relative_rmse, 3.0 * b.standard_error + 0.1 * a.relative_rmse);
  EXPECT_NEAR(b.flip, a.flip, 0.3 * a.flip);
}

TEST(MeasuredErrors, KeepToTheBudget) {
  for (const double budget : {3.0, 6.0}) {
    TestClock clock(0.05);
    const double before = clock.Now();
    const ErrorReport report = Measure(clock, "16x16", budget);
    EXPECT_LE(clock.Now() - before, budget + 0.3) << budget;
    EXPECT_FALSE(report.complete);
    EXPECT_GE(report.points.size(), 2u) << budget;
  }
}

TEST(MeasuredErrors, SayEarlyWhatNoSettingsReach) {
  constexpr double kBudget = 100.0;
  const auto measured = [&](const Bound& bound) {
    TestClock clock(0.3);
    const ErrorReport report = Measure(clock, "24x24", kBudget, bound);
    EXPECT_LE(report.seconds, 0.3 * kBudget);
    EXPECT_EQ(report.points.size(), 3u);
    EXPECT_TRUE(report.complete);
    EXPECT_FALSE(ChoosePoint(report, bound).kept);
    return report;
  };
  EXPECT_EQ(measured({1e-5, {}}).out_of_reach, "not even the most exact settings come near it");
  const ErrorReport slow = measured({{}, 0.01});
  EXPECT_EQ(slow.out_of_reach, "not even the cheapest settings come near it");
  // The nearest are among the points: all at its most exact, all at its cheapest.
  EXPECT_EQ(slow.points[1].changed.at("samples"), "1");
  EXPECT_EQ(slow.points[1].changed.at("mip-filter"), "none");
  EXPECT_EQ(slow.points[2].changed.at("samples"), "8");
  EXPECT_EQ(slow.points[2].changed.at("environment-samples"), "192");
  EXPECT_NE(measured({1e-5, 1e-3}).out_of_reach, "");
}

class MeasuredErrorsOfAScene : public Scratch {
 protected:
  // An unlit square that fills the image, with a chequered texture of many squares a pixel: its mip levels are grey,
  // as is the truth, while a reference of few samples is noisy.
  std::filesystem::path Board() const {
    constexpr std::uint8_t kBlack = 0, kWhite = 255;
    const Image board{2,
                      2,
                      1,
                      ChannelType::U8,
                      Encoding::Srgb,
                      {std::byte{kBlack}, std::byte{kWhite}, std::byte{kWhite}, std::byte{kBlack}}};
    const std::vector<std::byte> png = EncodePng(board);
    Write("board.png", {reinterpret_cast<const char*>(png.data()), png.size()});
    const float corners[] = {-9, -9, 0,   9, -9,  0,   9, 9, 0,   -9,  -9, 0,  9, 9, 0, -9, 9, 0,  // two triangles
                             0,  0,  901, 0, 901, 703, 0, 0, 901, 703, 0,  703};  // texture coordinates
    Write("board.bin", {reinterpret_cast<const char*>(corners), sizeof(corners)});
    return Write("board.gltf", R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}],
"extensionsUsed": ["KHR_materials_unlit"],
"nodes": [{"mesh": 0}, {"camera": 0, "translation": [0, 0, 3]}],
"cameras": [{"type": "orthographic", "orthographic": {"xmag": 2, "ymag": 2, "znear": 0.1, "zfar": 10}}],
"meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "material": 0}]}],
"materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}, "extensions": {"KHR_materials_unlit": {}}}],
"textures": [{"source": 0, "sampler": 0}], "images": [{"uri": "board.png"}],
"samplers": [{"minFilter": 9987, "magFilter": 9728}],
"buffers": [{"uri": "board.bin", "byteLength": 120}],
"bufferViews": [{"buffer": 0, "byteLength": 72}, {"buffer": 0, "byteOffset": 72, "byteLength": 48}],
"accessors": [{"bufferView": 0, "componentType": 5126, "count": 6, "type": "VEC3", "min": [-9, -9, 0], "max": [9, 9, 0]},
              {"bufferView": 1, "componentType": 5126, "count": 6, "type": "VEC2"}]})");
  }
};

// The machine is eight times slower for a while: all settings take one tick of the clock, so they must come out alike.
TEST_F(MeasuredErrorsOfAScene, DoNotMistakeNoiseForDifferences) {
  constexpr double kBudget = 20.0;
  int compared = 0;
  for (const double lasting : {0.5, 2.0, 20.0}) {
    for (double begin = 10.0; begin < 16.0; begin += 0.4) {
      TestClock clock([&](double now) {
        const double fine = now - 1000.0 >= begin && now - 1000.0 < begin + lasting ? 0.16 : 0.02;
        return CoarseThenFine(kBudget, fine)(now);
      });
      const ErrorReport report = test::Measure(clock, "16x16", kBudget, {}, folder_ / "tiny.gltf");
      ASSERT_GE(report.points.size(), 3u);
      for (const ReportPoint& point : report.points) {
        EXPECT_EQ(point.runs, report.points[0].runs);
        if (point.runs < 5) continue;  // two rounds of three may be those that noise begins and ends in
        ++compared;
        EXPECT_NEAR(point.seconds / report.points[0].seconds, 1.0, 0.01)
            << lasting << " s slow from " << begin << " on";
      }
    }
  }
  EXPECT_GT(compared, 50);
}

TEST_F(MeasuredErrorsOfAScene, AreCompleteWhereThereIsTime) {
  TestClock clock(CoarseThenFine(20.0, 1e-3));
  const ErrorReport report = test::Measure(clock, "16x16", 20.0, {}, folder_ / "tiny.gltf");
  EXPECT_TRUE(report.complete);
  EXPECT_EQ(report.planned_points, report.points.size());
  EXPECT_EQ(report.points.size(), 4u) << "unlit and without texture: 1, 2, 4 and 8 samples";
  EXPECT_EQ(report.points[0].runs, 7);
}

TEST_F(MeasuredErrorsOfAScene, SayEarlyWhatTheReferenceCannotTell) {
  const auto measured = [&](const Bound& bound) {
    TestClock clock(0.25);
    return Measure(clock, "24x24", 20.0, bound, Board());
  };
  const ErrorReport coarse = measured({});
  EXPECT_NEAR(coarse.points[0].error.relative_rmse, coarse.reference.relative_error,
              0.3 * coarse.reference.relative_error)
      << "all of the error is the reference's own";
  const Bound bound{0.3 * coarse.reference.relative_error, {}};
  const ErrorReport report = measured(bound);
  const std::string expected = "in this budget the reference would be less exact than that; one of about ";
  ASSERT_EQ(report.out_of_reach.substr(0, expected.size()), expected) << report.out_of_reach;
  EXPECT_LE(report.seconds, 10.0);
  EXPECT_FALSE(ChoosePoint(report, bound).kept);
  // With what it names the reference can tell.
  TestClock clock(0.25);
  const double named = std::stod(report.out_of_reach.substr(expected.size()));
  EXPECT_GT(named, 20.0);
  EXPECT_LT(Measure(clock, "24x24", named, {}, Board()).reference.relative_error, *bound.max_relative_rmse) << named;
  EXPECT_EQ(measured({1e-6, {}}).out_of_reach,
            "in this budget the reference would be less exact than that; no budget is large enough");
}

TEST(MeasuredErrors, LookOnForABoundThatIsNotFar) {
  constexpr double kBudget = 30.0;
  TestClock first(CoarseThenFine(kBudget, 0.25));
  const double error = Measure(first, "16x16", kBudget).points[0].error.relative_rmse;
  for (const Bound& bound : {Bound{0.9 * error, {}}, Bound{10.0, {}}, Bound{{}, 0.5}, Bound{10.0, 0.5}}) {
    TestClock clock(CoarseThenFine(kBudget, 0.25));
    const ErrorReport report = Measure(clock, "16x16", kBudget, bound);
    EXPECT_EQ(report.out_of_reach, "");
    EXPECT_GE(report.points.size(), 5u);
    EXPECT_EQ(report.points[1].changed.at("samples"), "1");  // the ends first: they are the likeliest to be taken
    std::set<SettingsText> settings;
    for (const ReportPoint& point : report.points) EXPECT_TRUE(settings.insert(point.changed).second);
  }
}

TEST(MeasuredErrors, RefuseWhatIsNoBudgetAndNoBound) {
  TestClock clock(0.1);
  for (const double budget : {0.0, 0.5, -1.0, 1e6, std::nan("")}) {
    EXPECT_THROW(Measure(clock, "8x8", budget), Error) << budget;
  }
  for (const double bound : {0.0, -1.0, std::nan("")}) {
    EXPECT_THROW(Measure(clock, "8x8", 10.0, {bound, {}}), Error) << bound;
    EXPECT_THROW(Measure(clock, "8x8", 10.0, {{}, bound}), Error) << bound;
  }
}

TEST(MeasuredErrors, TellOfTheirProgress) {
  TestClock clock(0.05);
  ReportSettings settings;
  settings.budget_seconds = 5.0;
  double last = 0.0;
  std::set<std::string> said;
  settings.progress = [&](double share, const std::string& what) {
    EXPECT_GE(share, last);
    EXPECT_LE(share, 1.0);
    last = share;
    said.insert(what);
  };
  MeasureErrorsBy(clock.AsClock(), kGrid, {{"size", "16x16"}}, settings);
  EXPECT_TRUE(said.contains("reference") && said.contains("the settings asked for"));
  EXPECT_GT(last, 0.5);
}

}  // namespace
}  // namespace facet::test
