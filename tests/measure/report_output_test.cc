// What `facet report` writes: the page and its diagrams, JSON, CSV, and the choice of a point.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <limits>
#include <regex>
#include <string>
#include <vector>

#include "base/number_text.h"
#include "facet/error.h"
#include "measure/knobs.h"
#include "measure/report_svg.h"
#include "measure/sample_error_report.h"

namespace facet::test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

std::size_t CountOf(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; at += part.size()) ++count;
  return count;
}

bool Contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

std::vector<std::byte> Bytes(const std::string& text) {
  const auto* begin = reinterpret_cast<const std::byte*>(text.data());
  return {begin, begin + text.size()};
}

// Python's parser says whether a text is well-formed XML, and what `check` (Python, over the tree `t`) finds.
void ExpectXml(const std::string& text, const std::string& check) {
  if (std::system("python3 -c 'import xml.etree' 2>&1") != 0) GTEST_SKIP() << "needs python3";
  // Tests run beside one another, each in a process of its own.
  const std::string path = testing::TempDir() + "facet-report-" + std::to_string(getpid()) + ".xml";
  std::ofstream(path, std::ios::binary) << text;
  const std::string command =
      "python3 -c 'import sys, xml.etree.ElementTree as e; t = e.parse(sys.argv[1]).getroot(); " + check + "' '" +
      path + "'";
  EXPECT_EQ(std::system(command.c_str()), 0) << check << "\n" << text.substr(0, 2000);
  std::remove(path.c_str());
}

// The message of the error that `call` throws, after its code was checked.
std::string MessageOf(ErrorCode code, const std::function<void()>& call) {
  try {
    call();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), code) << error.what();
    return error.what();
  }
  ADD_FAILURE() << "nothing was thrown";
  return {};
}

struct Dot {
  std::string kind;
  double x, y;
};

// The dots of an SVG in the order in which they are drawn.
std::vector<Dot> Dots(const std::string& svg) {
  static const std::regex pattern("<circle class=\"(dot[^\"]*)\" cx=\"([0-9.]+)\" cy=\"([0-9.]+)\"");
  std::vector<Dot> dots;
  for (std::sregex_iterator it(svg.begin(), svg.end(), pattern), end; it != end; ++it) {
    dots.push_back({(*it)[1], std::stod((*it)[2]), std::stod((*it)[3])});
  }
  return dots;
}

std::string FrontLine(const std::string& svg) {
  std::smatch match;
  return std::regex_search(svg, match, std::regex("<polyline class=\"front\" points=\"([^\"]*)\"")) ? match[1].str()
                                                                                                    : "";
}

DiagramPoint PointAt(double x, double error, bool front = false) {
  DiagramPoint point;
  point.x = x;
  point.error = error;
  point.front = front;
  point.title = point.number = "n";
  return point;
}

Diagram DiagramOf(std::vector<DiagramPoint> points) { return {"name", "x", "y", std::move(points), {}}; }

TEST(LogAxisOfADiagram, MapsByTheLogarithmAndHoldsEnds) {
  const LogAxis axis{0.01, 100.0, 50.0, 250.0};
  EXPECT_DOUBLE_EQ(axis.At(0.01), 50.0);
  EXPECT_DOUBLE_EQ(axis.At(0.1), 100.0);
  EXPECT_DOUBLE_EQ(axis.At(1.0), 150.0);
  EXPECT_DOUBLE_EQ(axis.At(std::sqrt(10.0)), 175.0);
  EXPECT_DOUBLE_EQ(axis.At(100.0), 250.0);
  for (const double low : {0.0, -1.0, -kInfinity, 1e-300}) EXPECT_EQ(axis.At(low), 50.0);
  for (const double high : {kInfinity, kNaN, 1e300}) EXPECT_EQ(axis.At(high), 250.0);
}

TEST(LogAxisOfADiagram, CoversAllThatItCanShow) {
  const std::vector<double> values = {0.0, 3.0, kNaN, 2000.0, kInfinity, -5.0};
  const LogAxis axis = AxisOver(values, 0.0, 1.0);
  EXPECT_LT(axis.low, 3.0);
  EXPECT_GT(axis.low, 1.0);
  EXPECT_GT(axis.high, 2000.0);
  EXPECT_LT(axis.high, 6000.0);
  for (const std::vector<double>& odd : {std::vector<double>{}, {0.0, kNaN}, {1.0}, {5e-324, 1.7e308}}) {
    const LogAxis some = AxisOver(odd, 0.0, 1.0);
    EXPECT_GT(some.low, 0.0);
    EXPECT_TRUE(std::isfinite(some.high));
    EXPECT_GE(some.high / 3.99, some.low);
  }
}

TEST(TicksOfADiagram, AreFewAndWithinTheAxis) {
  for (const double low : {1e-300, 1.3e-7, 0.02, 1.0, 7.0, 3e5}) {
    for (const double factor : {4.0, 9.9, 50.0, 250.0, 3e4, 1e9, 1e40, 1e300}) {
      const LogAxis axis{low, low * factor, 0.0, 1.0};
      std::size_t labels = 0;
      double before = 0.0;
      for (const Tick& tick : Ticks(axis)) {
        EXPECT_GE(tick.value, axis.low);
        EXPECT_LE(tick.value, axis.high);
        EXPECT_GT(tick.value, before);
        before = tick.value;
        labels += tick.labelled;
      }
      EXPECT_GE(labels, 1u) << low << " " << factor;
      EXPECT_LE(labels, 12u) << low << " " << factor;
    }
  }
}

TEST(DiagramSvg, PutsDotsWhereTheLogarithmSays) {
  const std::string svg =
      ToSvg(DiagramOf({PointAt(1, 0.1), PointAt(10, 0.01), PointAt(100, 0.001), PointAt(1000, 0.0001)}));
  const std::vector<Dot> dots = Dots(svg);
  ASSERT_EQ(dots.size(), 4u);
  for (std::size_t i = 1; i < 4; ++i) {
    EXPECT_GT(dots[i].x, dots[i - 1].x);
    EXPECT_GT(dots[i].y, dots[i - 1].y);  // less error stands lower; y points down
    // Equal ratios are equally far apart, to the hundredth of a pixel that is written.
    EXPECT_NEAR(dots[i].x - dots[i - 1].x, dots[1].x - dots[0].x, 0.021);
    EXPECT_NEAR(dots[i].y - dots[i - 1].y, dots[1].y - dots[0].y, 0.021);
  }
}

TEST(DiagramSvg, JoinsTheFrontOnlyAndInOrderOfX) {
  const std::string svg = ToSvg(DiagramOf({PointAt(40, 0.002, true), PointAt(20, 0.05), PointAt(5, 0.03, true),
                                           PointAt(12, 0.01, true), PointAt(60, 0.02)}));
  std::string expected;
  std::vector<Dot> front;
  for (const Dot& dot : Dots(svg)) {
    if (Contains(dot.kind, "front")) front.push_back(dot);
  }
  ASSERT_EQ(front.size(), 3u);
  std::sort(front.begin(), front.end(), [](const Dot& a, const Dot& b) { return a.x < b.x; });
  std::regex number("[0-9.]+");
  const std::string line = FrontLine(svg);
  std::vector<double> places;
  for (std::sregex_iterator it(line.begin(), line.end(), number), end; it != end; ++it)
    places.push_back(std::stod(it->str()));
  EXPECT_EQ(places, (std::vector<double>{front[0].x, front[0].y, front[1].x, front[1].y, front[2].x, front[2].y}));
}

TEST(DiagramSvg, HoldsZeroAndInfinityAtTheEdges) {
  std::vector<DiagramPoint> points = {PointAt(10, 0.1), PointAt(20, 0.0), PointAt(0, 0.05), PointAt(30, kInfinity),
                                      PointAt(40, 0.02)};
  const std::string svg = ToSvg(DiagramOf(points));
  EXPECT_FALSE(std::regex_search(svg, std::regex("\"[^\"]*(nan|inf)")));
  const std::vector<Dot> dots = Dots(svg);
  ASSERT_EQ(dots.size(), 5u);
  for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(Contains(dots[i].kind, "off"), i >= 1 && i <= 3) << i;
  for (const std::size_t inside : {0u, 4u}) {
    EXPECT_LT(dots[inside].y, dots[1].y);  // no error: below all
    EXPECT_GT(dots[inside].x, dots[2].x);  // no time: left of all
    EXPECT_GT(dots[inside].y, dots[3].y);
  }
}

TEST(DiagramSvg, ShowsLevelsAndNamesThoseFarBelow) {
  Diagram diagram = DiagramOf({PointAt(10, 0.1), PointAt(20, 0.01)});
  diagram.levels = {{0.001, "near", true}, {1e-7, "far", false}};
  const std::string svg = ToSvg(diagram);
  EXPECT_EQ(CountOf(svg, "<rect class=\"band\""), 1u);
  EXPECT_EQ(CountOf(svg, "<line class=\"level\""), 1u);
  EXPECT_TRUE(Contains(svg, ">near 0.001<"));
  EXPECT_TRUE(Contains(svg, ">↓ far 1·10⁻⁷<"));
}

TEST(ErrorReportPage, IsWellFormedAndNeedsNothingElse) {
  ErrorReport report = SampleErrorReport();
  report.points[0].image_png = Bytes("one");
  report.points[3].error_map_png = Bytes("two");
  report.reference.image_png = Bytes("three");
  const std::string html = ToHtml(report);
  for (const char* outside : {"http", "//", "<link", "@import", "<script", "url("})
    EXPECT_FALSE(Contains(html, outside)) << outside;
  EXPECT_TRUE(Contains(html, "data:image/png;base64,b25l\""));
  EXPECT_TRUE(Contains(html, "data:image/png;base64,dHdv\""));
  EXPECT_TRUE(Contains(html, "alt=\"picture by the reference\" src=\"data:image/png;base64,dGhyZWU=\""));
  EXPECT_TRUE(Contains(html, "prefers-color-scheme: dark"));
  // Four diagrams of 13 dots; every link has its target.
  ExpectXml(html,
            "assert len(list(t.iter(\"svg\"))) == 4; assert len(list(t.iter(\"circle\"))) == 52; "
            "assert len(list(t.iter(\"img\"))) == 3; ids = [x.get(\"id\") for x in t.iter() if x.get(\"id\")]; "
            "assert len(ids) == len(set(ids)); "
            "assert all(a.get(\"href\")[1:] in ids for a in t.iter(\"a\"))");
}

TEST(ErrorReportPage, EscapesWhatItIsGiven) {
  ErrorReport report = SampleErrorReport();
  const std::string evil = "<script>alert('1')</script>\"&\x01\xff";
  report.version = report.scene = report.target = evil;
  report.settings = {{evil, evil}};
  report.reference.notes = {evil};
  report.points[1].changed = {{evil, evil}};
  report.points[1].image_png = Bytes("one");
  report.costs[0].option = report.costs[0].used = report.costs[0].cheapest = report.costs[0].most_exact = evil;
  const std::string html = ToHtml(report);
  EXPECT_FALSE(Contains(html, "<script"));
  ExpectXml(html, "assert not list(t.iter(\"script\"))");
}

TEST(ErrorReportPage, MarksTheSettingsAskedFor) {
  ErrorReport report = SampleErrorReport();
  report.settings.clear();
  EXPECT_EQ(CountOf(ToHtml(report), ">default</text>"), 4u);
  report.settings = {{"samples", "3"}};
  const std::string html = ToHtml(report);
  EXPECT_EQ(CountOf(html, ">default</text>"), 0u);
  EXPECT_EQ(CountOf(html, ">asked for</text>"), 4u);
}

TEST(ErrorReportPage, ListsPointsByError) {
  const std::string html = ToHtml(SampleErrorReport());
  const std::string table = html.substr(html.find("All points"));
  const auto at = [&](const char* words) { return table.find(std::string(">") + words + "<"); };
  EXPECT_LT(at("samples=32"), at("samples=16"));
  EXPECT_LT(at("samples=16"), at("samples=8"));
  EXPECT_LT(at("samples=2"), at("samples=1"));
  EXPECT_NE(at("samples=1"), std::string::npos);
  EXPECT_EQ(CountOf(table, "<tr id=\"point-"), 13u);
  EXPECT_EQ(CountOf(table, "●</td>"), 11u);
  EXPECT_TRUE(Contains(html, "The budget ended before all of the 20 points"));
}

TEST(ErrorReportPage, SaysWhatCannotBeDrawnAndStaysWhole) {
  ErrorReport report = SampleErrorReport();
  report.points[1].error.relative_rmse = 0.0;
  report.points[2].seconds = 0.0;
  report.points[3].error.relative_rmse = kNaN;
  report.points[4].peak_bytes = 0;
  report.costs[0].change = kNaN;
  report.rounding.reset();
  const std::string html = ToHtml(report);
  EXPECT_TRUE(Contains(html, "3 points have a zero or no finite number"));
  EXPECT_TRUE(Contains(html, "1 point is left out, for want of a known memory"));
  EXPECT_TRUE(Contains(html, "The rounding error was not measured"));
  ExpectXml(html, "assert len(list(t.iter(\"circle\"))) == 51");
  ExpectXml(ToHtml(ErrorReport()), "assert len(list(t.iter(\"svg\"))) == 3");  // no points at all
}

TEST(ErrorReportPage, SaysHowMuchOfTheImageWasCompared) {
  ErrorReport report = SampleErrorReport();
  EXPECT_FALSE(Contains(ToHtml(report), "There was time for"));
  EXPECT_FALSE(Contains(ToHtml(report), " ± "));
  report.reference.pixels = 51200;
  report.points[0].error.standard_error = 0.00042;
  const std::string html = ToHtml(report);
  EXPECT_TRUE(Contains(html, "There was time for 51,200 of the picture's 153,600 pixels"));
  EXPECT_TRUE(Contains(html, ">0.0061 ± 0.00042<"));
  ExpectXml(html, "assert True");
}

TEST(ErrorReportPage, TellsRoundingFromApproximation) {
  ErrorReport report = SampleErrorReport();
  report.points[0].error.relative_rmse = 0.0042;
  EXPECT_TRUE(Contains(ToHtml(report), "10000 times as much: the error is that of approximations"));
  report.rounding->relative_rmse = 0.0021;
  EXPECT_TRUE(Contains(ToHtml(report), "only 2 times as much: rounding is part of the error"));
  report.rounding->relative_rmse = 0.1;
  EXPECT_TRUE(Contains(ToHtml(report), "rounding hides"));
}

void ExpectEqual(const FilmError& a, const FilmError& b) {
  EXPECT_EQ(a.rmse, b.rmse);
  EXPECT_EQ(a.relative_rmse, b.relative_rmse);
  EXPECT_EQ(a.largest, b.largest);
  EXPECT_EQ(a.flip, b.flip);
  EXPECT_EQ(a.standard_error, b.standard_error);
}

TEST(ErrorReportJson, ReadsBackAsItWas) {
  ErrorReport report = SampleErrorReport();
  report.points[1].seconds = 5e-324;
  report.points[1].seconds_high = std::numeric_limits<double>::max();
  report.points[1].error = {1.0 / 3.0, 0.1, std::nextafter(1.0, 2.0), 2.2250738585072014e-308, 0.01};
  report.reference.pixels = 1234;
  report.points[1].peak_bytes = std::numeric_limits<std::size_t>::max();
  report.points[2].changed = {{"a\"b\\\n", "é\x01"}};
  report.points[2].error.relative_rmse = kInfinity;
  ErrorReport read = ReportFromJson(ToJson(report), "stored.json");
  EXPECT_EQ(read.version, report.version);
  EXPECT_EQ(read.scene, report.scene);
  EXPECT_EQ(read.target, report.target);
  EXPECT_EQ(read.threads, 2);
  EXPECT_EQ(read.width, 480);
  EXPECT_EQ(read.height, 320);
  EXPECT_EQ(read.settings, report.settings);
  EXPECT_EQ(read.reference.samples, 256);
  EXPECT_EQ(read.reference.batches, 8);
  EXPECT_EQ(read.reference.pixels, 1234u);
  EXPECT_EQ(read.reference.seconds, report.reference.seconds);
  EXPECT_EQ(read.reference.rms_error, report.reference.rms_error);
  EXPECT_EQ(read.reference.relative_error, report.reference.relative_error);
  EXPECT_EQ(read.reference.notes, report.reference.notes);
  ASSERT_TRUE(read.rounding);
  ExpectEqual(*read.rounding, *report.rounding);
  EXPECT_EQ(read.seconds, report.seconds);
  EXPECT_EQ(read.complete, report.complete);
  EXPECT_EQ(read.planned_points, 20u);
  ASSERT_EQ(read.points.size(), report.points.size());
  EXPECT_TRUE(std::isnan(read.points[2].error.relative_rmse));  // JSON has no infinity
  report.points[2].error.relative_rmse = read.points[2].error.relative_rmse = 1.0;
  for (std::size_t i = 0; i < read.points.size(); ++i) {
    const ReportPoint &a = read.points[i], &b = report.points[i];
    EXPECT_EQ(a.changed, b.changed);
    EXPECT_EQ(a.runs, b.runs);
    EXPECT_EQ(a.seconds, b.seconds);
    EXPECT_EQ(a.seconds_low, b.seconds_low);
    EXPECT_EQ(a.seconds_high, b.seconds_high);
    EXPECT_EQ(a.peak_bytes, b.peak_bytes);
    ExpectEqual(a.error, b.error);
    EXPECT_EQ(a.pareto, b.pareto);
  }
  ASSERT_EQ(read.costs.size(), 3u);
  EXPECT_EQ(ToJson(read).find("\"costs\""), ToJson(read).rfind("\"costs\""));
  EXPECT_EQ(ToJson(ReportFromJson(ToJson(read), "")), ToJson(read));
  EXPECT_EQ(read.costs[1].option, "samples");
  EXPECT_EQ(read.costs[1].most_exact, "64");
  EXPECT_EQ(read.costs[1].error_cheapest, 0.041);
  EXPECT_EQ(read.costs[1].seconds_most_exact, 0.93);
  EXPECT_EQ(read.costs[1].change, 0.0057);
}

// Those of earlier versions, whose references were always whole.
TEST(ErrorReportJson, ReadsReportsThatDoNotSayWhatTheirReferenceHas) {
  std::string json = ToJson(SampleErrorReport());
  for (const std::string key : {"pixels", "standard_error"}) {
    json = std::regex_replace(json, std::regex(",\\s*\"" + key + "\": [0-9.]+"), "");
    EXPECT_FALSE(Contains(json, key));
  }
  const ErrorReport read = ReportFromJson(json, "stored.json");
  EXPECT_EQ(read.reference.pixels, 480u * 320u);
  EXPECT_EQ(read.points[0].error.standard_error, 0.0);
  EXPECT_EQ(read.points[0].error.flip, SampleErrorReport().points[0].error.flip);
}

TEST(ErrorReportJson, NamesThePlaceThatIsWrong) {
  const std::string good = ToJson(SampleErrorReport());
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string bad = good;
    const std::size_t at = bad.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return bad.replace(at, from.size(), to);
  };
  const auto message = [](const std::string& json) {
    return MessageOf(ErrorCode::InvalidInput, [&] { ReportFromJson(json, "stored.json"); });
  };
  EXPECT_TRUE(
      Contains(message(with("\"peak_bytes\": 92278784", "\"peak_bytes\": -1")), "stored.json: /points/0/peak_bytes: "));
  EXPECT_TRUE(Contains(message(with("\"relative_rmse\": 0.0061", "\"relative_rmse\": \"x\"")),
                       "stored.json: /points/0/error/relative_rmse: is no number"));
  EXPECT_TRUE(
      Contains(message(with("\"relative_rmse\": 0.0061", "\"relative_rmse\": -0.0061")), "/error/relative_rmse: "));
  EXPECT_TRUE(Contains(message(with("\"threads\": 2", "\"threads\": 2147483648")), "/threads: "));
  EXPECT_TRUE(Contains(message(with("\"complete\": false", "\"complete\": 0")), "/complete: is no true or false"));
  EXPECT_TRUE(Contains(message(with("\"costs\"", "\"cost\"")), "stored.json: has no 'costs'"));
  EXPECT_TRUE(Contains(message(with("textures without mips\",", "textures without mips\", 3,")),
                       "/reference/notes/1: is no string"));
  EXPECT_TRUE(Contains(message("[]"), "stored.json: is no object"));
  EXPECT_TRUE(Contains(message("{"), "stored.json: "));
  EXPECT_TRUE(Contains(message(with("0.0061", "1e999")), "stored.json: "));
}

TEST(ErrorReportCsv, HasALinePerPointAndAColumnPerVariedOption) {
  ErrorReport report = SampleErrorReport();
  report.points.resize(3);
  report.points[1].changed = {{"samples", "1"}, {"target", "0,\"1\",2"}};
  report.points[1].error.standard_error = 0.004;
  report.points[2].error.relative_rmse = kInfinity;
  for (ReportPoint& point : report.points) {
    point.seconds_low = 0.5 * point.seconds;
    point.seconds_high = 2.0 * point.seconds;
  }
  report.points[2].seconds = 0.1;
  EXPECT_EQ(
      ToCsv(report),
      "samples,target,runs,seconds,seconds_low,seconds_high,peak_bytes,rmse,relative_rmse,largest,flip,standard_error,"
      "pareto\r\n"
      "4,,5,0.062,0.031,0.124,92278784,0.001525,0.0061,0.1952,0.00305,0,yes\r\n"
      "1,\"0,\"\"1\"\",2\",5,0.021,0.0105,0.042,63967232,0.01025,0.041,1.312,0.0205,0.004,no\r\n"
      "2,,5,0.1,0.018,0.072,73404416,0.0038,,0.4864,0.0076,0,yes\r\n");
}

TEST(WordsForNumbers, HaveThreeDigitsAndAUnit) {
  EXPECT_EQ(TimeWords(0.0413), "41.3 ms");
  EXPECT_EQ(TimeWords(0.9996), "1000 ms");
  EXPECT_EQ(TimeWords(12.34567), "12.3 s");
  EXPECT_EQ(TimeWords(0.0000421), "42.1 µs");
  EXPECT_EQ(TimeWords(0.0), "0 s");
  EXPECT_EQ(TimeWords(kNaN), "not known");
  EXPECT_EQ(ErrorWords(0.031234), "0.0312");
  EXPECT_EQ(ErrorWords(4.2e-7), "4.2·10⁻⁷");
  EXPECT_EQ(ErrorWords(1.2345e19), "1.23·10¹⁹");
  EXPECT_EQ(BytesWords(1023.0), "1023 B");
  EXPECT_EQ(BytesWords(1047552.0), "1023 KiB");
  EXPECT_EQ(BytesWords(1.5 * 1073741824.0), "1.5 GiB");
  EXPECT_EQ(SettingsWords({{"samples", "2"}, {"max-anisotropy", "1"}}), "max-anisotropy=1 samples=2");
}

ErrorReport ReportWith(const std::vector<std::pair<double, double>>& seconds_and_errors) {
  ErrorReport report;
  for (const auto& [seconds, error] : seconds_and_errors) {
    ReportPoint& point = report.points.emplace_back();
    if (report.points.size() > 1) point.changed = {{"samples", std::to_string(report.points.size())}};
    point.seconds = seconds;
    point.error.relative_rmse = error;
  }
  return report;
}

TEST(ChosenPoint, IsTheFastestWithinTheError) {
  const ErrorReport report = ReportWith({{0.1, 0.005}, {0.041, 0.0081}, {0.02, 0.011}, {0.041, 0.001}, {0.01, kNaN}});
  const Choice choice = ChoosePoint(report, {0.01, {}});
  EXPECT_EQ(choice.point, 1u);  // of two that are as fast, the first
  EXPECT_TRUE(choice.kept);
  EXPECT_EQ(choice.why,
            "takes samples=2: relative RMSE 0.0081 is within 0.01, and its 41 ms are the least of 3 such points");
  EXPECT_EQ(ChoosePoint(report, {0.011, {}}).point, 2u);  // the bound itself is within
  EXPECT_EQ(ChoosePoint(report, {0.001, {}}).why,
            "takes samples=4: relative RMSE 0.001 is within 0.001; it is the only such point");
}

TEST(ChosenPoint, IsTheMostExactWithinTheTime) {
  const ErrorReport report = ReportWith({{0.1, 0.005}, {0.041, 0.0081}, {0.02, 0.011}, {0.2, 0.001}, {0.05, 0.0081}});
  const Choice choice = ChoosePoint(report, {{}, 0.05});
  EXPECT_EQ(choice.point, 1u);
  EXPECT_TRUE(choice.kept);
  EXPECT_EQ(choice.why,
            "takes samples=2: its 41 ms are within 50 ms, and its relative RMSE 0.0081 is the least of 3 such points");
  EXPECT_EQ(
      ChoosePoint(report, {{}, 0.1}).why,
      "takes the settings asked for: its 100 ms are within 100 ms, and its relative RMSE 0.005 is the least of 4 such "
      "points");
}

TEST(ChosenPoint, IsTheFastestWithinBoth) {
  const ErrorReport report = ReportWith({{0.1, 0.005}, {0.041, 0.0081}, {0.02, 0.011}, {0.09, 0.001}});
  const Choice choice = ChoosePoint(report, {0.01, 0.095});
  EXPECT_EQ(choice.point, 1u);
  EXPECT_TRUE(choice.kept);
  EXPECT_EQ(
      choice.why,
      "takes samples=2: relative RMSE 0.0081 is within 0.01, and its 41 ms are within 95 ms and the least of 2 such "
      "points");
}

TEST(ChosenPoint, IsTheNearestWhereNoneIsWithin) {
  const ErrorReport report = ReportWith({{0.1, 0.005}, {0.04, 0.008}, {0.02, 0.011}, {0.2, 0.001}, {kNaN, kNaN}});
  const Choice by_error = ChoosePoint(report, {0.0001, {}});
  EXPECT_EQ(by_error.point, 3u);
  EXPECT_FALSE(by_error.kept);
  EXPECT_EQ(by_error.why,
            "none of 5 points keeps relative RMSE 0.0001; takes the nearest, samples=4: relative RMSE 0.001");
  ErrorReport coarse = report;
  coarse.reference.relative_error = 0.0007;
  EXPECT_EQ(ChoosePoint(coarse, {0.0005, {}}).why,
            "none of 5 points keeps relative RMSE 0.0005; takes the nearest, samples=4: relative RMSE 0.001; the "
            "reference itself is off by 0.0007, by less in a larger budget");
  EXPECT_EQ(ChoosePoint(coarse, {0.0008, {}}).why,
            "none of 5 points keeps relative RMSE 0.0008; takes the nearest, samples=4: relative RMSE 0.001");
  const Choice by_time = ChoosePoint(report, {{}, 0.01});
  EXPECT_EQ(by_time.point, 2u);
  EXPECT_FALSE(by_time.kept);
  // Factors by which the worse bound is missed: 2.5, 2.67, 3.67, 5.
  const Choice by_both = ChoosePoint(report, {0.003, 0.04});
  EXPECT_EQ(by_both.point, 0u);
  EXPECT_FALSE(by_both.kept);
  EXPECT_EQ(
      by_both.why,
      "none of 5 points keeps relative RMSE 0.003 and 40 ms; takes the nearest, the settings asked for: relative RMSE "
      "0.005 and 100 ms");
}

TEST(ChosenPoint, RefusesBoundsThatNothingCanKeep) {
  const ErrorReport report = SampleErrorReport();
  for (const double bad : {0.0, -1.0, kNaN, kInfinity}) {
    EXPECT_TRUE(Contains(MessageOf(ErrorCode::InvalidUsage,
                                   [&] {
                                     ChoosePoint(report, {bad, {}});
                                   }),
                         "above 0"))
        << bad;
    EXPECT_TRUE(Contains(MessageOf(ErrorCode::InvalidUsage,
                                   [&] {
                                     ChoosePoint(report, {0.1, bad});
                                   }),
                         "above 0"))
        << bad;
  }
  MessageOf(ErrorCode::InvalidUsage, [&] { ChoosePoint(report, {}); });
  MessageOf(ErrorCode::InvalidInput, [&] { ChoosePoint(ErrorReport(), {0.1, {}}); });
}

}  // namespace
}  // namespace facet::test
