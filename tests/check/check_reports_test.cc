// The HTML page and the JUnit XML of a report.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "base/base64.h"
#include "base/markup.h"
#include "facet/check.h"

namespace facet::test {
namespace {

std::vector<std::byte> Bytes(const std::string& text) {
  const auto* begin = reinterpret_cast<const std::byte*>(text.data());
  return {begin, begin + text.size()};
}

CheckReport SampleReport() {
  CheckReport report;
  report.manifest = "a&b/goldens.json";
  report.problems = {"a&b/goldens.json: /x<y>: unknown key"};
  report.seconds = 1.5;
  CheckedEntry passed;
  passed.name = "passed";
  passed.verdict = Verdict::Passed;
  passed.seconds = 0.25;
  passed.film = passed.expected_film = Digest{};
  CheckedEntry failed;
  failed.name = "<script>alert(1)\"'&";
  failed.place = "goldens.json: /entries/1";
  failed.verdict = Verdict::Failed;
  failed.message = "FLIP\x01 0.5 > 0.1 \xff";
  failed.difference.emplace();
  failed.difference->flip_mean = 0.53125;
  failed.expected = Bytes("one");
  failed.actual = Bytes("two");
  failed.heat_map = Bytes("three");
  failed.warnings = {"texture <3>: broken"};
  CheckedEntry error;
  error.name = "error";
  error.place = "goldens.json: /entries/2/scene";
  error.message = "no such file";
  report.entries = {passed, failed, error};
  return report;
}

std::size_t CountOf(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; at += part.size()) ++count;
  return count;
}

// The vectors of RFC 4648, section 10.
TEST(Base64Text, IsThatOfTheRfc) {
  const std::vector<std::string> texts = {"", "f", "fo", "foo", "foob", "fooba", "foobar"};
  const std::vector<std::string> coded = {"", "Zg==", "Zm8=", "Zm9v", "Zm9vYg==", "Zm9vYmE=", "Zm9vYmFy"};
  for (std::size_t i = 0; i < texts.size(); ++i) EXPECT_EQ(Base64(Bytes(texts[i])), coded[i]);
  EXPECT_EQ(Base64(Bytes("\xff\xef\xbe")), "/+++");
}

TEST(Markup, EscapesWhatMarksUpAndDropsWhatXmlCannotHold) {
  EXPECT_EQ(Escaped("a<b>&\"c'"), "a&lt;b&gt;&amp;&quot;c'");
  EXPECT_EQ(Escaped(std::string("a\0b\x1f\x7f\n", 6)), "ab");
  EXPECT_EQ(Escaped("é€😀"), "é€😀");
  const std::string replaced = "\xef\xbf\xbd";
  EXPECT_EQ(Escaped("\xff"), replaced);
  EXPECT_EQ(Escaped("\xc3"), replaced);                                               // cut off
  EXPECT_EQ(Escaped("\xc0\xbc"), replaced + replaced);                                // an overlong '<'
  EXPECT_EQ(Escaped("\xed\xa0\x80"), replaced + replaced + replaced);                 // a surrogate
  EXPECT_EQ(Escaped("\xef\xbf\xbf"), replaced + replaced + replaced);                 // U+FFFF
  EXPECT_EQ(Escaped("\xf4\x90\x80\x80"), replaced + replaced + replaced + replaced);  // beyond Unicode
}

TEST(CheckHtmlPage, NeedsNothingElseAndEscapes) {
  const std::string html = CheckHtml(SampleReport());
  EXPECT_EQ(html.find("http"), std::string::npos);
  EXPECT_EQ(html.find("//"), std::string::npos);
  EXPECT_EQ(html.find("<link"), std::string::npos);
  EXPECT_EQ(html.find("@import"), std::string::npos);
  EXPECT_EQ(CountOf(html, "<script>"), 1u);  // its own
  EXPECT_EQ(html.find("alert(1)\""), std::string::npos);
  EXPECT_NE(html.find("&lt;script&gt;alert(1)&quot;'&amp;"), std::string::npos);
  EXPECT_NE(html.find("texture &lt;3&gt;: broken"), std::string::npos);
  EXPECT_NE(html.find("/x&lt;y&gt;: unknown key"), std::string::npos);
  EXPECT_EQ(html.find('\x01'), std::string::npos);
}

TEST(CheckHtmlPage, HasThePicturesOfWhatFailedAndTheHashOfWhatPassed) {
  const std::string html = CheckHtml(SampleReport());
  EXPECT_EQ(CountOf(html, "<img "), 3u);
  for (const char* text : {"one", "two", "three"}) {
    EXPECT_EQ(CountOf(html, "src=\"data:image/png;base64," + Base64(Bytes(text)) + "\""), 1u);
  }
  EXPECT_NE(html.find("0.53125"), std::string::npos);
  EXPECT_EQ(CountOf(html, "<section"), 1u);
  EXPECT_NE(html.find(ToHex(Digest{})), std::string::npos);
  EXPECT_NE(html.find("goldens.json: /entries/2/scene"), std::string::npos);
  EXPECT_EQ(CountOf(html, "<tr class=\"passed\">"), 1u);  // which the filter hides
}

TEST(CheckJUnit, CountsFailuresAndErrorsApart) {
  EXPECT_EQ(JUnitXml(SampleReport()),
            R"(<?xml version="1.0" encoding="UTF-8"?>
<testsuites name="facet check" tests="4" failures="1" errors="2" time="1.50">
  <testsuite name="a&amp;b/goldens.json" tests="4" failures="1" errors="2" time="1.50" skipped="0">
    <testcase classname="goldens" name="the manifest" time="0.00">
      <error type="error" message="a&amp;b/goldens.json: /x&lt;y&gt;: unknown key">a&amp;b/goldens.json: /x&lt;y&gt;: unknown key</error>
    </testcase>
    <testcase classname="goldens" name="passed" time="0.25"/>
    <testcase classname="goldens" name="&lt;script&gt;alert(1)&quot;'&amp;" time="0.00">
      <failure type="differs" message="FLIP 0.5 &gt; 0.1 )"
            "\xef\xbf\xbd"
            R"(">goldens.json: /entries/1: FLIP 0.5 &gt; 0.1 )"
            "\xef\xbf\xbd"
            R"(</failure>
      <system-out>warning: texture &lt;3&gt;: broken
      </system-out>
    </testcase>
    <testcase classname="goldens" name="error" time="0.00">
      <error type="error" message="no such file">goldens.json: /entries/2/scene: no such file</error>
    </testcase>
  </testsuite>
</testsuites>
)");
}

}  // namespace
}  // namespace facet::test
