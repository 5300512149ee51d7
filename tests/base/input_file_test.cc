#include "base/input_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <string>
#include <thread>

#include "base/memory_budget.h"
#include "base/temporary_folder.h"
#include "facet/error.h"

namespace facet {
namespace {

namespace fs = std::filesystem;
using test::Put;
using test::ScratchFolder;

std::string Refusal(const auto& body, ErrorCode code) {
  try {
    body();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), code) << error.what();
    return error.what();
  }
  ADD_FAILURE() << "was not refused";
  return {};
}

bool Has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(ReadFile, GivesAWholeFileOrItsStart) {
  const ScratchFolder folder;
  Put(folder / "a", "0123456789");
  Put(folder / "empty", "");
  EXPECT_EQ(ReadFile(folder / "a").Text(), "0123456789");
  EXPECT_EQ(ReadFile(folder / "empty").size, 0u);
  std::uintmax_t size = 0;
  EXPECT_EQ(ReadFile(folder / "a", {.most = 4}, &size).Text(), "0123");
  EXPECT_EQ(size, 10u);
  EXPECT_FALSE(ReadFile("/proc/self/status").Text().empty()) << "says that it has no bytes";
}

TEST(ReadFile, MappedBytesAreThoseThatAreRead) {
  const ScratchFolder folder;
  std::string text(std::size_t{64} << 20, 'a');
  text.back() = 'z';
  Put(folder / "large", text);
  const Bytes mapped = ReadFile(folder / "large", {.map = true}), read = ReadFile(folder / "large");
  EXPECT_TRUE(mapped.Text() == text);
  EXPECT_TRUE(read.Text() == text);
  MemoryBudget small(std::uint64_t{1} << 20);
  const MemoryBudget::Scope scope(small);
  EXPECT_TRUE(ReadFile(folder / "large", {.map = true}).Text() == text) << "what is mapped takes no memory";
  EXPECT_TRUE(Has(Refusal([&] { ReadFile(folder / "large"); }, ErrorCode::OutOfMemory), "64.0 MiB for files"));
}

TEST(ReadFile, EndlessFilesEndAtTheMemoryLimit) {
  MemoryBudget small(std::uint64_t{1} << 20);
  const MemoryBudget::Scope scope(small);
  EXPECT_TRUE(Has(Refusal([] { ReadFile("/dev/zero"); }, ErrorCode::OutOfMemory), "/dev/zero"));
}

TEST(ReadFile, OpensOnlyRegularFilesForNamesFromData) {
  const ScratchFolder folder;
  ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
  fs::create_symlink("/dev/zero", folder / "link");
  for (const fs::path& path : {folder / "pipe", folder / "link", fs::path("/dev/zero")}) {
    EXPECT_TRUE(Has(Refusal([&] { ReadFile(path, {.regular_only = true}); }, ErrorCode::NotFound), "regular")) << path;
  }
  std::thread writer([&] { Put(folder / "pipe", "through"); });
  EXPECT_EQ(ReadFile(folder / "pipe").Text(), "through") << "a user's own pipe is read";
  writer.join();
}

TEST(ReadFile, SaysWhyItCannot) {
  const ScratchFolder folder;
  EXPECT_TRUE(Has(Refusal([&] { ReadFile(folder / "none"); }, ErrorCode::NotFound), "no such file"));
  EXPECT_TRUE(Has(Refusal([&] { ReadFile(folder.path()); }, ErrorCode::NotFound), "is a folder"));
}

TEST(DataPath, StaysInTheFolderOfTheFileThatNames) {
  const ScratchFolder folder;
  fs::create_directories(folder / "models/textures");
  const fs::path file = folder / "models/a.gltf";
  Put(file, "");
  Put(folder / "secret", "");
  Put(folder / "models/textures/in", "");
  fs::create_symlink("../../secret", folder / "models/textures/out");
  fs::create_symlink("..", folder / "models/up");
  fs::create_symlink("textures/in", folder / "models/inner");
  for (const char* name :
       {"b.bin", "textures/in", "textures/../b.bin", "./b.bin", "inner", "missing/b", "a..b", "..b"}) {
    EXPECT_EQ(DataPath(file, name), folder / "models" / name) << name;
  }
  for (const char* name : {"../secret", "textures/../../secret", "/dev/zero", "textures/out", "up/secret", ".."}) {
    EXPECT_TRUE(Has(Refusal([&] { DataPath(file, name); }, ErrorCode::InvalidInput), "lies outside of the folder"))
        << name;
  }
  // A user may say which folder they may lie in.
  for (const char* name : {"../secret", "textures/out", "up/secret", "b.bin"}) {
    EXPECT_EQ(DataPath(file, name, folder.path()), folder / "models" / name) << name;
  }
  EXPECT_EQ(DataPath(file, "/dev/zero", "/"), "/dev/zero");
  EXPECT_TRUE(
      Has(Refusal([&] { DataPath(file, "b.bin", folder / "models/textures"); }, ErrorCode::InvalidInput), "outside"));
  const fs::path before = fs::current_path();
  fs::current_path(folder / "models");
  EXPECT_EQ(DataPath("a.gltf", "textures/in"), "textures/in");
  EXPECT_TRUE(Has(Refusal([] { DataPath("a.gltf", "../secret"); }, ErrorCode::InvalidInput), "outside"));
  fs::current_path(before);
}

// Build systems and version control of large files lay out folders of links into a store.
TEST(DataPath, ALinkedFileNamesFilesOfItsOwnFolder) {
  const ScratchFolder folder;
  fs::create_directories(folder / "store");
  fs::create_directories(folder / "view");
  Put(folder / "store/a.gltf", "");
  Put(folder / "store/a.bin", "");
  Put(folder / "secret", "");
  fs::create_symlink("../store/a.gltf", folder / "view/a.gltf");
  fs::create_symlink("../store/a.bin", folder / "view/a.bin");
  fs::create_symlink("../secret", folder / "view/b.bin");
  EXPECT_EQ(DataPath(folder / "view/a.gltf", "a.bin"), folder / "view/a.bin");
  EXPECT_TRUE(Has(Refusal([&] { DataPath(folder / "view/a.gltf", "b.bin"); }, ErrorCode::InvalidInput), "outside"));
}

}  // namespace
}  // namespace facet
