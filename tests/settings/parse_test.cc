#include "settings/parse.h"

#include <gtest/gtest.h>

#include "facet/error.h"

namespace facet {
namespace {

template <class Call>
std::string Complaint(Call call) {
  try {
    call();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::InvalidUsage);
    return error.what();
  }
  return "accepted";
}

TEST(ParseNumber, TakesDecimalNumbers) {
  EXPECT_EQ(ParseNumber("--x", "1.5", {-10, 10}), 1.5);
  EXPECT_EQ(ParseNumber("--x", "+1.5", {-10, 10}), 1.5);
  EXPECT_EQ(ParseNumber("--x", "-2e-1", {-10, 10}), -0.2);
  EXPECT_EQ(ParseNumber("--x", ".5", {-10, 10}), 0.5);
  EXPECT_EQ(ParseNumber("--x", "-10", {-10, 10}), -10.0);
  EXPECT_EQ(ParseNumber("--x", "10", {-10, 10}), 10.0);
}

TEST(ParseDuration, TakesUnits) {
  EXPECT_EQ(ParseDuration("--x", "200ms", {0, 100}), 0.2);
  EXPECT_EQ(ParseDuration("--x", "1.5s", {0, 100}), 1.5);
  EXPECT_EQ(ParseDuration("--x", "3", {0, 100}), 3.0);
  EXPECT_EQ(ParseDuration("--x", "2min", {0, 200}), 120.0);
  EXPECT_EQ(ParseDuration("--x", "0.5h", {0, 2000}), 1800.0);
  for (const char* text : {"", "s", "1m", "1 s", "-1s", "nan", "nans", "inf", "1e9s", "101s", "1sms", "s1"}) {
    const std::string complaint = Complaint([&] { ParseDuration("--x", text, {0, 100}); });
    EXPECT_NE(complaint.find("--x"), std::string::npos) << text;
    EXPECT_NE(complaint.find("0 to 100 seconds"), std::string::npos) << text;
  }
}

TEST(ParseNumber, RefusesEverythingElse) {
  for (const char* text :
       {"",    " ",  "1 ",   " 1",  "1x",  "x",   "nan",   "NaN",    "-nan",   "inf",     "-inf",  "infinity",
        "1,5", "1e", "0x10", "++1", "+-1", "--1", "1e999", "-1e999", "10.001", "-10.001", "1.5.2", "١"}) {
    const std::string complaint = Complaint([&] { ParseNumber("--x", text, {-10, 10}); });
    EXPECT_NE(complaint.find("--x: "), std::string::npos) << text;
    EXPECT_NE(complaint.find("from -10 to 10"), std::string::npos) << text << " gave " << complaint;
  }
}

TEST(ParseInteger, RefusesWhatIsNotAnIntegerInRange) {
  EXPECT_EQ(ParseInteger("--n", "0", 0, 16), 0);
  EXPECT_EQ(ParseInteger("--n", "16", 0, 16), 16);
  for (const char* text : {"", "17", "-1", "1.0", "1 ", "+ 1", "0x1", "99999999999999999999", "one"}) {
    EXPECT_NE(Complaint([&] { ParseInteger("--n", text, 0, 16); }).find("0 to 16"), std::string::npos) << text;
  }
}

TEST(ParseSize, TakesWidthThenHeight) {
  EXPECT_EQ(ParseSize("--size", "640x480").width, 640);
  EXPECT_EQ(ParseSize("--size", "640x480").height, 480);
  EXPECT_EQ(ParseSize("--size", "1x16384").height, 16384);
  EXPECT_EQ(ParseSize("--size", "512").width, 512);
  EXPECT_EQ(ParseSize("--size", "512").height, 512);
  for (const char* text : {"", "0", "16385", "5 12", "640x", "x480", "640x480x3", "0x480", "640x0", "-640x480",
                           "640x16385", "640 x480", "640X", "6.4x48", "640x480 ", "4294967297x1"}) {
    EXPECT_NE(Complaint([&] { ParseSize("--size", text); }).find("WIDTHxHEIGHT"), std::string::npos) << text;
  }
}

TEST(ParseVec3, TakesThreeFiniteNumbers) {
  const glm::dvec3 v = ParseVec3("--target", "-1,2.5,+3e2");
  EXPECT_EQ(v.x, -1.0);
  EXPECT_EQ(v.y, 2.5);
  EXPECT_EQ(v.z, 300.0);
  for (const char* text :
       {"", "1,2", "1,2,3,4", "1,,3", "1,2,nan", "1,2,inf", "1, 2,3", "1;2;3", "1,2,3,", "1,2,1e13"}) {
    EXPECT_NE(Complaint([&] { ParseVec3("--target", text); }).find("X,Y,Z"), std::string::npos) << text;
  }
}

TEST(ParseOrbit, TakesTwoAnglesAndADistance) {
  const Orbit orbit = ParseOrbit("--orbit", "-30,60,4.5");
  EXPECT_EQ(orbit.theta_degrees, -30.0);
  EXPECT_EQ(orbit.phi_degrees, 60.0);
  EXPECT_EQ(orbit.radius, 4.5);
  EXPECT_FALSE(ParseOrbit("--orbit", "0,90").radius.has_value());
  EXPECT_FALSE(ParseOrbit("--orbit", "0,90,0").radius.has_value());
  for (const char* text : {"", "30", "1,2,3,4", "1,2,-3", "a,b,c", "1,nan,3", "1e9,0,1"}) {
    EXPECT_NE(Complaint([&] { ParseOrbit("--orbit", text); }).find("THETA,PHI,RADIUS"), std::string::npos) << text;
  }
}

TEST(ParseColor, KnowsHexAndNames) {
  const glm::vec3 hex = ParseColor("--background", "#336699");
  EXPECT_EQ(hex, glm::vec3(0x33 / 255.0f, 0x66 / 255.0f, 0x99 / 255.0f));
  EXPECT_EQ(ParseColor("--background", "#369"), hex);
  EXPECT_EQ(ParseColor("--background", "#FfF"), glm::vec3(1.0f));
  EXPECT_EQ(ParseColor("--background", "white"), glm::vec3(1.0f));
  EXPECT_EQ(ParseColor("--background", "black"), glm::vec3(0.0f));
  EXPECT_EQ(ParseColor("--background", "grey"), ParseColor("--background", "gray"));
  EXPECT_EQ(ParseColor("--background", "navy"), glm::vec3(0.0f, 0.0f, 128 / 255.0f));
  for (const char* text : {"", "#", "#12", "#1234", "#12345", "#12345678", "#12345g", "#-12345", "#-12", "#+12", "#0x1",
                           "336699", "whit", "wh\xc3\xafte", "rgb(1,2,3)"}) {
    EXPECT_NE(Complaint([&] { ParseColor("--background", text); }).find("#rrggbb"), std::string::npos) << text;
  }
  for (const char* name : {"White", "WHITE", "wHiTe"}) EXPECT_EQ(ParseColor("--background", name), glm::vec3(1.0f));
  EXPECT_EQ(ParseColor("--background", "CornflowerBlue"), ParseColor("--background", "#6495ed"));
  EXPECT_EQ(ParseColor("--background", "rebeccapurple"), ParseColor("--background", "#639"));
}

TEST(ParseChoice, ListsTheChoices) {
  EXPECT_EQ(ParseChoice("--bits", "16", {"8", "16"}), 1);
  EXPECT_EQ(Complaint([] {
              ParseChoice("--bits", "32", {"8", "16", "24"});
            }),
            "--bits: '32' is no choice; give 8, 16 or 24");
}

TEST(ParsePlanes, TakesNamesOnce) {
  EXPECT_EQ(ParsePlanes("--planes", "none"), std::vector<PlaneKind>{});
  EXPECT_EQ(ParsePlanes("--planes", "triangle,depth"), (std::vector<PlaneKind>{PlaneKind::Triangle, PlaneKind::Depth}));
  for (const char* wrong : {"", "Depth", "depth,", ",depth", "depth, triangle", "depth,none"}) {
    EXPECT_NE(Complaint([&] { ParsePlanes("--planes", wrong); }).find("is no choice; give depth or triangle"),
              std::string::npos)
        << wrong;
  }
  EXPECT_NE(Complaint([] { ParsePlanes("--planes", "depth,depth"); }).find("depth is named twice"), std::string::npos);
}

TEST(Choose, TakesANameOrAnIndex) {
  const std::vector<std::string> names = {"Front", "", "Back", "Twin", "Twin", "7"};
  EXPECT_EQ(Choose("--camera", "camera", "Front", names), 0);
  EXPECT_EQ(Choose("--camera", "camera", "2", names), 2);
  EXPECT_EQ(Choose("--camera", "camera", "5", names), 5);
  EXPECT_NE(Complaint([&] { Choose("--camera", "camera", "front", names); }).find("0 'Front', 1, 2 'Back'"),
            std::string::npos);
  EXPECT_NE(Complaint([&] { Choose("--camera", "camera", "7", names); }).find("there is no camera 7"),
            std::string::npos);
  EXPECT_NE(Complaint([&] { Choose("--camera", "camera", "99999999999999999999999", names); }).find("no camera"),
            std::string::npos);
  EXPECT_NE(Complaint([&] { Choose("--camera", "camera", "-1", names); }).find("called '-1'"), std::string::npos);
  EXPECT_NE(Complaint([&] { Choose("--camera", "camera", "Twin", names); }).find("more than one"), std::string::npos);
  EXPECT_NE(Complaint([&] { Choose("--camera", "camera", "7", names); }).find("its cameras are 0 'Front', 1, 2 'Back'"),
            std::string::npos);
  EXPECT_NE(Complaint([&] { Choose("--camera", "camera", "7", {""}); }).find("its only camera is 0"),
            std::string::npos);
  EXPECT_NE(Complaint([&] { Choose("--camera", "camera", "0", {}); }).find("the file has no cameras"),
            std::string::npos);
}

TEST(Choose, ShortensLongListsAndHidesControlCharacters) {
  const std::string complaint =
      Complaint([] { Choose("--camera", "camera", "x", std::vector<std::string>(40, "a\x1b[2Jb")); });
  EXPECT_NE(complaint.find("and 28 more"), std::string::npos);
  EXPECT_EQ(complaint.find('\x1b'), std::string::npos);
}

}  // namespace
}  // namespace facet
