#include "facet/error.h"

#include <gtest/gtest.h>

#include <limits>
#include <set>
#include <type_traits>

#include "base/check.h"

namespace facet {
namespace {

TEST(Error, IsOneLine) {
  EXPECT_STREQ(Error(ErrorCode::NotFound, "no such file").what(), "no such file");
  EXPECT_STREQ(Error(ErrorCode::NotFound, "no such file", "a.glb").what(), "a.glb: no such file");
  EXPECT_STREQ(Error(ErrorCode::NotFound, "no such file", "", "look elsewhere").what(), "no such file; look elsewhere");
  const Error whole(ErrorCode::InvalidInput, "bad\nvalue", "a\r\nb.gltf", "mend\nit");
  EXPECT_STREQ(whole.what(), "a  b.gltf: bad value; mend it");
  EXPECT_EQ(whole.code(), ErrorCode::InvalidInput);
  EXPECT_EQ(whole.message(), "bad\nvalue") << "the parts stay as they were given";
  EXPECT_EQ(whole.where(), "a\r\nb.gltf");
  EXPECT_EQ(whole.hint(), "mend\nit");
  static_assert(std::is_base_of_v<std::runtime_error, Error>);
}

TEST(Error, ExitCodesAreTheDocumentedOnes) {
  EXPECT_EQ(ExitCode(ErrorCode::Internal), 1);
  EXPECT_EQ(ExitCode(ErrorCode::InvalidUsage), 2);
  EXPECT_EQ(ExitCode(ErrorCode::NotFound), 3);
  EXPECT_EQ(ExitCode(ErrorCode::InvalidInput), 4);
  EXPECT_EQ(ExitCode(ErrorCode::Unsupported), 5);
  EXPECT_EQ(ExitCode(ErrorCode::OutputFailed), 6);
  EXPECT_EQ(ExitCode(ErrorCode::OutOfMemory), 7);
  EXPECT_EQ(ExitCode(ErrorCode::MissingModule), 8);
}

TEST(Check, PassesSilently) {
  int evaluated = 0;
  FACET_CHECK_OP(++evaluated, ==, 1);
  FACET_CHECK(++evaluated == 2);
  EXPECT_EQ(evaluated, 2) << "operands of a check that holds are evaluated once";
}

TEST(Check, PrintsBothOperandsAndThePlace) {
  const int size = 3;
  const int line = __LINE__ + 2;
  try {
    FACET_CHECK_OP(size + 1, <=, 2.5);
    FAIL() << "did not throw";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::Internal);
    EXPECT_EQ(error.message(), "check failed: size + 1 <= 2.5 (4 against 2.5)");
    EXPECT_TRUE(error.where().ends_with("error_test.cc:" + std::to_string(line))) << error.where();
    EXPECT_NE(error.hint().find("defect of facet"), std::string::npos);
  }
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(FACET_CHECK_OP(nan, <, 1.0), Error) << "NaN fails";
  EXPECT_THROW(FACET_CHECK(size == 4), Error);
}

}  // namespace
}  // namespace facet
