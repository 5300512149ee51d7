#include "gltf/uri.h"

#include <gtest/gtest.h>

#include <fstream>

#include "gltf/files.h"
#include "gltf_files.h"

namespace facet {
namespace {

using gltf::DecodeBase64;
using gltf::DecodeDataUri;
using gltf::PercentDecode;
using testing::Base64;
using testing::FileMaker;
using testing::TempFolder;

std::string Text(const std::optional<Bytes>& bytes) { return bytes ? std::string(bytes->Text()) : "(malformed)"; }

TEST(Uri, PercentDecoding) {
  EXPECT_EQ(PercentDecode("a%20b%2Fc"), "a b/c");
  EXPECT_EQ(PercentDecode("%C3%A9"), "\xC3\xA9");
  EXPECT_EQ(PercentDecode("100%"), "100%");
  EXPECT_EQ(PercentDecode("%4"), "%4");
  EXPECT_EQ(PercentDecode("%zz%41"), "%zzA");
}

TEST(Uri, Base64OfEveryLengthAndItsMistakes) {
  EXPECT_EQ(Text(DecodeBase64("")), "");  // RFC 4648, section 10
  EXPECT_EQ(Text(DecodeBase64("Zg==")), "f");
  EXPECT_EQ(Text(DecodeBase64("Zm8=")), "fo");
  EXPECT_EQ(Text(DecodeBase64("Zm9v")), "foo");
  EXPECT_EQ(Text(DecodeBase64("Zm9vYg")), "foob") << "padding may be left out";
  EXPECT_EQ(Text(DecodeBase64("-_-_")), Text(DecodeBase64("+/+/")));
  EXPECT_EQ(Text(DecodeBase64("Zm9v!")), "(malformed)");
  EXPECT_EQ(Text(DecodeBase64("Z")), "(malformed)");
  EXPECT_EQ(Text(DecodeBase64("Zm 9")), "fo") << "blanks do not count";
  EXPECT_EQ(Text(DecodeBase64(" Zm9v\r\nYmFy\t\n")), "foobar");
  EXPECT_EQ(Text(DecodeBase64("Zg = =\n")), "f");
  EXPECT_EQ(Text(DecodeBase64("Zm 9!")), "(malformed)");
  EXPECT_EQ(Text(DecodeBase64(" Z ")), "(malformed)");
  std::string every;
  for (int i = 0; i < 256; ++i) every += static_cast<char>(i);
  for (std::size_t length = 0; length < every.size(); ++length) {
    ASSERT_EQ(Text(DecodeBase64(Base64(every.substr(0, length)))), every.substr(0, length));
  }
}

TEST(Uri, DataUris) {
  EXPECT_EQ(Text(DecodeDataUri("data:application/octet-stream;base64,Zm9v")), "foo");
  EXPECT_EQ(Text(DecodeDataUri("DATA:;base64,Zm9v")), "foo");
  EXPECT_EQ(Text(DecodeDataUri("data:;base64,Zm9%76")), "foo");
  EXPECT_EQ(Text(DecodeDataUri("data:;base64,Zm%0A9%0D%76")), "foo");
  EXPECT_EQ(Text(DecodeDataUri(" data:image/png; charset=x; Base64 ,Zm9v")), "foo");
  EXPECT_EQ(Text(DecodeDataUri("data:text/plain,a%20b%00c")), std::string("a b\0c", 5));
  EXPECT_EQ(Text(DecodeDataUri("data:application/octet-stream;base64")), "(malformed)");
}

TEST(Uri, OnlyRelativeReferencesAreFollowed) {
  const TempFolder folder;
  std::filesystem::create_directory(folder.Path() / "sub");
  const std::filesystem::path scene = folder.Path() / "a.gltf";
  LoadOptions options;
  LoadReport report;
  gltf::FileStore files(scene, options, report);
  const gltf::Place place("a.gltf");
  for (const char* bad : {"", "https://example.com/a.bin", "file:///etc/hostname", "/etc/hostname", "a%00b", "../a.bin",
                          "sub/../../a.bin", "%2E%2E/a.bin"}) {
    EXPECT_THROW(files.Find(bad, place), Error) << bad;
  }
  EXPECT_TRUE(report.files.empty());
  EXPECT_EQ(files.Find("sub/a%20b.bin", place), folder.Path() / "sub/a b.bin");
  EXPECT_EQ(files.Find("sub/../c.bin", place), folder.Path() / "sub/../c.bin");
  EXPECT_EQ(report.files.size(), 2u);
  options.root = "/";
  EXPECT_EQ(files.Find("/etc/hostname", place), std::filesystem::path("/etc/hostname"));
  EXPECT_EQ(files.Find("../a.bin", place), folder.Path() / "../a.bin");
}

// A file that is not there yet, named by one that is given without its folder, lies where that lies.
TEST(Uri, NamesWithoutAFolderAreOfTheCurrentOne) {
  const TempFolder folder;
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(folder.Path());
  EXPECT_EQ(DataPath("a.gltf", "missing.bin"), "missing.bin");
  EXPECT_THROW(DataPath("a.gltf", "../missing.bin"), Error);
  EXPECT_THROW(DataPath("a.gltf", std::string("a.png\0.txt", 10)), Error);
  std::filesystem::current_path(before);
}

TEST(Uri, LinksLeadNoFurtherThanNames) {
  const TempFolder folder;
  std::filesystem::create_directory(folder.Path() / "inner");
  std::ofstream(folder.Path() / "secret.bin") << "secret";
  std::filesystem::create_symlink("../secret.bin", folder.Path() / "inner" / "link.bin");
  const std::filesystem::path scene = folder.Path() / "inner" / "a.gltf";
  LoadOptions options;
  LoadReport report;
  gltf::FileStore files(scene, options, report);
  const gltf::Place place("a.gltf");
  EXPECT_THROW(files.Find("link.bin", place), Error);
  options.root = folder.Path();
  EXPECT_EQ(files.Read(files.Find("link.bin", place)).Text(), "secret");
}

TEST(Uri, OneFileIsReadOnceByWhateverNames) {
  const TempFolder folder;
  std::ofstream(folder.Path() / "a.bin") << std::string(1000, 'x');
  const std::filesystem::path scene = folder.Path() / "a.gltf";
  LoadOptions options;
  LoadReport report;
  gltf::FileStore files(scene, options, report);
  const gltf::Place place("a.gltf");
  const Bytes first = files.Read(files.Find("a.bin", place));
  EXPECT_EQ(files.Read(files.Find("./././a.bin", place)).data, first.data);
  EXPECT_EQ(files.Read(files.Find("%61.bin", place)).data, first.data);
  EXPECT_EQ(report.file_bytes, 1000u);
}

// The buffer's file is called `file_name`, and the glTF file calls it `uri`.
LoadedScene LoadBeside(const std::string& file_name, const std::string& uri) {
  const TempFolder folder;
  FileMaker file;
  file.Attribute("POSITION", file.Triangle());
  folder.Write(file_name, file.Bin());
  return LoadGltf(folder.Write("sc\xC3\xA8ne \xE6\x97\xA5.gltf", file.Json(uri)));
}

TEST(Uri, BufferFileNames) {
  for (const auto& [name, uri] : {std::pair<const char*, const char*>{"plain.bin", "plain.bin"},
                                  {"with space.bin", "with%20space.bin"},
                                  {"with space.bin", "with space.bin"},
                                  {"gr\xC3\xBC\xC3\x9F.bin", "gr\xC3\xBC\xC3\x9F.bin"},
                                  {"gr\xC3\xBC\xC3\x9F.bin", "gr%C3%BC%C3%9F.bin"},
                                  {"gr\xC3\xBC.bin", "gr\\u00fc.bin"},
                                  {"100%.bin", "100%.bin"},
                                  {"100%25.bin", "100%25.bin"},
                                  {"a+b&c.bin", "a+b&c.bin"}}) {
    const LoadedScene loaded = LoadBeside(name, uri);
    EXPECT_EQ(loaded.scene.meshes.at(0).primitives.at(0).positions.at(1), glm::vec3(1, 0, 0)) << uri;
    EXPECT_TRUE(loaded.report.warnings.empty()) << uri;
  }
}

TEST(Uri, BackslashesAreSlashesWhereTheNameDoesNotExist) {
  const TempFolder folder;
  std::filesystem::create_directory(folder.Path() / "sub");
  FileMaker file;
  file.Attribute("POSITION", file.Triangle());
  folder.Write("sub/a b.bin", file.Bin());
  for (const char* uri : {"sub\\\\a b.bin", ".\\\\sub\\\\a%20b.bin", "sub%5Ca%20b.bin"}) {
    const LoadedScene loaded = LoadGltf(folder.Write("s.gltf", file.Json(uri)));
    EXPECT_EQ(loaded.scene.meshes.at(0).primitives.at(0).positions.at(1), glm::vec3(1, 0, 0)) << uri;
    EXPECT_EQ(loaded.report.warnings, std::vector<std::string>{"buffers[0].uri: backslashes are read as slashes"});
  }
  folder.Write("sub\\a b.bin", file.Bin());
  EXPECT_TRUE(LoadGltf(folder.Write("s.gltf", file.Json("sub\\\\a b.bin"))).report.warnings.empty()) << "it exists";
}

TEST(Uri, MissingBufferNamesTheFile) {
  try {
    LoadBeside("there.bin", "not%20there.bin");
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::NotFound);
    EXPECT_NE(std::string(error.what()).find("buffers[0].uri"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("not there.bin"), std::string::npos) << error.what();
  }
}

TEST(Uri, EmbeddedBuffer) {
  FileMaker file;
  file.Attribute("POSITION", file.Triangle());
  const LoadedScene loaded =
      testing::LoadBytes(file.Json("data:application/octet-stream;base64," + Base64(file.Bin())));
  EXPECT_EQ(loaded.scene.meshes.at(0).primitives.at(0).positions.at(2), glm::vec3(0, 1, 0));
}

}  // namespace
}  // namespace facet
