// Asserts every case and curve of the suite, and that the documentation's table is this suite's.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "stability/stability_case.h"
#include "stability/stability_page.h"

namespace facet::stability {
namespace {

// "GGX distribution at n·h within an ULP of 1" -> GGXDistributionAtNHWithinAnULPOf1
std::string Identifier(const char* phrase) {
  std::string name;
  bool starts = true;
  for (const char* c = phrase; *c != '\0'; ++c) {
    const bool letter = (*c >= 'a' && *c <= 'z') || (*c >= 'A' && *c <= 'Z') || (*c >= '0' && *c <= '9');
    if (letter) name += starts && *c >= 'a' ? char(*c - 'a' + 'A') : *c;
    starts = !letter;
  }
  return name;
}

void ExpectSound(const Measured& m) {
  for (const std::string& failure : m.failures) ADD_FAILURE() << failure;
}

class StabilityCase : public testing::TestWithParam<std::size_t> {};

TEST_P(StabilityCase, KeepsItsBound) {
  const Case c = AllCases()[GetParam()];
  const Measured m = c.measure();
  ExpectSound(m);
  if (!m.skipped.empty()) GTEST_SKIP() << m.skipped;
  EXPECT_LE(m.worst, c.bound) << c.name << ", " << c.unit;
}

INSTANTIATE_TEST_SUITE_P(All, StabilityCase, testing::Range(std::size_t{0}, AllCases().size()),
                         [](const auto& parameter) { return Identifier(AllCases()[parameter.param].name); });

class StabilityCurve : public testing::TestWithParam<std::size_t> {};

TEST_P(StabilityCurve, StaysBounded) {
  const Curve curve = AllCurves()[GetParam()];
  for (const double parameter : curve.parameters) {
    Measured m;
    const CurvePoint point = curve.measure(parameter, m);
    ExpectSound(m);
    EXPECT_LE(point.error, curve.error_bound) << curve.name << " at " << parameter;
    EXPECT_LE(point.count, curve.count_bound) << curve.name << " at " << parameter;
  }
}

INSTANTIATE_TEST_SUITE_P(All, StabilityCurve, testing::Range(std::size_t{0}, AllCurves().size()),
                         [](const auto& parameter) { return Identifier(AllCurves()[parameter.param].name); });

// Figures are those of the machine that wrote the page; all else of the table is the suite's.
TEST(StabilityPage, ShowsTheCasesAndCurvesOfThisSuite) {
  std::ifstream file(FACET_SOURCE_DIR "/docs/stability.md");
  std::stringstream page;
  page << file.rdbuf();
  const std::vector<std::string> lines = GeneratedLines(page.str());
  std::vector<std::string> expected;
  for (const Case& c : AllCases()) expected.push_back(RowHead(c));
  for (const Curve& c : AllCurves()) expected.push_back(CurveTitle(c));
  std::vector<std::string> shown;
  for (const std::string& line : lines) {
    if (line.rfind("| ", 0) == 0 && line.rfind("| case", 0) != 0 && line.find(" | ") != std::string::npos) {
      for (const std::string& row : expected) {
        if (line.rfind(row, 0) == 0) shown.push_back(row);
      }
    } else if (line.rfind("### ", 0) == 0) {
      shown.push_back(line);
    }
  }
  EXPECT_EQ(shown, expected) << "write it anew: stability_table --update docs/stability.md";
}

}  // namespace
}  // namespace facet::stability
