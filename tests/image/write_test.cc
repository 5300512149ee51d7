// Files appear whole or not at all.
#include <sys/resource.h>

#include <csignal>
#include <string>
#include <vector>

#include "facet/film.h"
#include "facet/load.h"
#include "image/codec.h"
#include "image/image_test_util.h"

namespace facet {
namespace {

TEST(Write, ReplacesWhatWasThere) {
  TemporaryFolder folder;
  const Image first = MakePattern(8, 8, 3, ChannelType::U8), second = MakePattern(9, 5, 4, ChannelType::U16);
  WriteImage(folder / "A.PNG", first);
  ExpectSame(LoadImage(folder / "A.PNG"), first);
  WriteImage(folder / "A.PNG", second);
  ExpectSame(LoadImage(folder / "A.PNG"), second);
  EXPECT_EQ(folder.Names(), std::vector<std::string>{"A.PNG"});
}

TEST(Write, FormatsAreToldByContentWhenRead) {
  TemporaryFolder folder;
  const Image image = MakePattern(8, 8, 3, ChannelType::U8);
  WriteImage(folder / "a.png", image);
  std::filesystem::rename(folder / "a.png", folder / "a.jpg");
  ExpectSame(LoadImage(folder / "a.jpg"), image);
}

TEST(Write, UnknownExtensionsAreRefusedWithAList) {
  TemporaryFolder folder;
  const Image image = MakePattern(8, 8, 3, ChannelType::U8);
  std::string what;
  for (const char* name : {"a.xyz", "a", "a.png.bak"}) {
    EXPECT_EQ(CodeOf([&] { WriteImage(folder / name, image); }, &what), ErrorCode::InvalidUsage);
    EXPECT_NE(what.find(".png, .exr"), std::string::npos) << what;
  }
  EXPECT_TRUE(folder.Names().empty());
}

TEST(Write, RefusesPicturesThatContradictThemselves) {
  TemporaryFolder folder;
  Image image = MakePattern(8, 8, 3, ChannelType::U8);
  image.bytes.pop_back();
  EXPECT_EQ(CodeOf([&] { WriteImage(folder / "a.png", image); }), ErrorCode::InvalidUsage);
  EXPECT_EQ(CodeOf([&] { WriteImage(folder / "a.png", Image{}); }), ErrorCode::InvalidUsage);
  EXPECT_EQ(CodeOf([&] { WriteImage(folder / "a.png", MakePattern(2, 2, 3, ChannelType::F32)); }),
            ErrorCode::InvalidUsage);
  EXPECT_TRUE(folder.Names().empty());
}

TEST(Write, FailuresNameTheReasonAndLeaveNothing) {
  TemporaryFolder folder;
  const Image image = MakePattern(8, 8, 3, ChannelType::U8);
  std::string what;
  for (const char* name : {"missing/a.png", "missing/a.exr"}) {
    EXPECT_EQ(CodeOf([&] { WriteImage(folder / name, image); }, &what), ErrorCode::OutputFailed);
    EXPECT_NE(what.find("No such file or directory"), std::string::npos) << what;
    EXPECT_NE(what.find(name), std::string::npos) << what;
  }
  std::filesystem::create_directory(folder / "folder.png");
  EXPECT_EQ(CodeOf([&] { WriteImage(folder / "folder.png", image); }, &what), ErrorCode::OutputFailed);
  EXPECT_EQ(folder.Names(), std::vector<std::string>{"folder.png"});
  if (geteuid() == 0) return;  // root may write anywhere
  std::filesystem::permissions(folder.path(), std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
  EXPECT_EQ(CodeOf([&] { WriteImage(folder / "a.png", image); }, &what), ErrorCode::OutputFailed);
  EXPECT_NE(what.find("Permission denied"), std::string::npos) << what;
  EXPECT_EQ(folder.Names(), std::vector<std::string>{"folder.png"});
}

// A limit on the size of files stands in for a full disk.
TEST(Write, AFullDiskLeavesTheOldFile) {
  TemporaryFolder folder;
  const Image small = MakePattern(2, 2, 3, ChannelType::U8), large = MakePattern(200, 200, 4, ChannelType::U16);
  WriteImage(folder / "a.png", small);
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit tight = before;
  tight.rlim_cur = 10000;
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &tight), 0);
  std::string what;
  const ErrorCode code = CodeOf([&] { WriteImage(folder / "a.png", large); }, &what);
  ErrorCode module_code = ErrorCode::Internal;
  try {
    WriteImage(folder / "b.exr", large);
  } catch (const Error& error) {
    module_code = error.code();
  }
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(code, ErrorCode::OutputFailed);
  EXPECT_NE(what.find("File too large"), std::string::npos) << what;
  EXPECT_TRUE(module_code == ErrorCode::OutputFailed || module_code == ErrorCode::MissingModule);
  EXPECT_EQ(folder.Names(), std::vector<std::string>{"a.png"});
  ExpectSame(LoadImage(folder / "a.png"), small);
}

TEST(Read, MissingFilesAndFoldersAreNotFound) {
  TemporaryFolder folder;
  std::string what;
  EXPECT_EQ(CodeOf([&] { LoadImage(folder / "none.png"); }, &what), ErrorCode::NotFound);
  EXPECT_NE(what.find("no such file"), std::string::npos) << what;
  EXPECT_EQ(CodeOf([&] { LoadImage(folder.path()); }), ErrorCode::NotFound);
}

}  // namespace
}  // namespace facet
