#include "base/output_file.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <string>
#include <thread>
#include <vector>

#include "base/temporary_folder.h"
#include "base/unfinished_files.h"
#include "facet/error.h"

namespace facet {
namespace {

namespace fs = std::filesystem;
using test::Put;
using test::ScratchFolder;
using test::TextOf;
using Names = std::vector<std::string>;

std::span<const std::byte> BytesOf(std::string_view text) { return std::as_bytes(std::span(text)); }

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

TEST(OutputFile, AppearsWholeWhenItIsCommitted) {
  const ScratchFolder folder;
  Put(folder / "a", "before");
  {
    OutputFile file(folder / "a");
    file.Write(BytesOf("hello "));
    file.Write(BytesOf("world"));
    EXPECT_EQ(TextOf(folder / "a"), "before");
    file.Rewrite(0, BytesOf("J"));
    file.Commit();
  }
  EXPECT_EQ(TextOf(folder / "a"), "Jello world");
  EXPECT_EQ(folder.Names(), Names{"a"});
}

TEST(OutputFile, LeavesNothingWhenItIsNot) {
  const ScratchFolder folder;
  Put(folder / "a", "before");
  {
    OutputFile file(folder / "a");
    file.Write(BytesOf("half"));
    EXPECT_EQ(folder.Names().size(), 2u);
  }
  EXPECT_EQ(TextOf(folder / "a"), "before");
  EXPECT_EQ(folder.Names(), Names{"a"});
}

// Nobody can know where the next file will be made: two hundred names without a repetition, none with a number of ours.
TEST(OutputFile, TemporaryNamesCannotBeForetold) {
  const ScratchFolder folder;
  std::vector<std::string> seen;
  for (int i = 0; i < 200; ++i) {
    const OutputFile file(folder / "a.png");
    const Names names = folder.Names();
    ASSERT_EQ(names.size(), 1u);
    EXPECT_EQ(names[0].find(std::to_string(getpid())), std::string::npos) << names[0];
    EXPECT_EQ(names[0].find("a.png"), std::string::npos) << names[0];
    seen.push_back(names[0]);
  }
  std::sort(seen.begin(), seen.end());
  EXPECT_EQ(std::unique(seen.begin(), seen.end()), seen.end());
}

TEST(OutputFile, NamesMayBeAsLongAsNamesCanBe) {
  const ScratchFolder folder;
  const std::string name = std::string(251, 'n') + ".png";  // NAME_MAX
  WriteFile(folder / name, std::string("long"));
  EXPECT_EQ(TextOf(folder / name), "long");
  EXPECT_EQ(folder.Names(), Names{name});
}

TEST(OutputFile, KeepsTheModeOfWhatItReplaces) {
  const ScratchFolder folder;
  Put(folder / "a", "before");
  ASSERT_EQ(chmod((folder / "a").c_str(), 0640), 0);
  WriteFile(folder / "a", std::string("after"));
  struct stat status {};
  ASSERT_EQ(stat((folder / "a").c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777u, 0640u);
  const mode_t mask = umask(027);
  WriteFile(folder / "b", std::string("new"));
  umask(mask);
  ASSERT_EQ(stat((folder / "b").c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777u, 0640u) << "0666 less the mask";
}

TEST(OutputFile, FollowsLinksAsARedirectionDoes) {
  const ScratchFolder folder;
  fs::create_directory(folder / "elsewhere");
  Put(folder / "elsewhere/target", "before");
  fs::create_symlink("elsewhere/target", folder / "link");
  fs::create_symlink("link", folder / "chain");
  fs::create_symlink("elsewhere/new", folder / "dangling");
  WriteFile(folder / "chain", std::string("after"));
  EXPECT_EQ(TextOf(folder / "elsewhere/target"), "after");
  EXPECT_TRUE(fs::is_symlink(folder / "link"));
  EXPECT_TRUE(fs::is_symlink(folder / "chain"));
  WriteFile(folder / "dangling", std::string("made"));
  EXPECT_EQ(TextOf(folder / "elsewhere/new"), "made");
  EXPECT_TRUE(fs::is_symlink(folder / "dangling"));
  fs::create_symlink("loop", folder / "loop");
  EXPECT_NE(Refusal([&] { WriteFile(folder / "loop", std::string()); }, ErrorCode::OutputFailed).find("symbolic links"),
            std::string::npos);
  EXPECT_TRUE(fs::is_symlink(fs::symlink_status(folder / "loop")));
}

TEST(OutputFile, RefusesLinksWhereItIsToldTo) {
  const ScratchFolder folder;
  Put(folder / "victim", "before");
  fs::create_symlink("victim", folder / "link");
  fs::create_symlink("nowhere", folder / "dangling");
  ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
  for (const char* name : {"link", "dangling", "pipe"}) {
    const std::string what = Refusal([&] { WriteFile(folder / name, BytesOf("after"), OutputFile::Links::Refuse); },
                                     ErrorCode::OutputFailed);
    EXPECT_NE(what.find("it is no plain file"), std::string::npos) << what;
  }
  EXPECT_EQ(TextOf(folder / "victim"), "before");
  EXPECT_EQ(folder.Names(), (Names{"dangling", "link", "pipe", "victim"}));
  WriteFile(folder / "victim", BytesOf("after"), OutputFile::Links::Refuse);
  EXPECT_EQ(TextOf(folder / "victim"), "after");
}

// What a process that was killed left behind has no lock; what another is writing has one.
TEST(OutputFile, RemovesAbandonedFilesAndNoOthers) {
  const ScratchFolder folder;
  Put(folder / ".facet-0123456789abcdef.part", "abandoned");
  Put(folder / ".facet-fedcba9876543210.part", "in use");
  Put(folder / ".facet-0123456789abcdeg.part", "no such name");
  Put(folder / ".facet-0123456789abcdef.part.txt", "nor this");
  Put(folder / "victim", "before");
  fs::create_symlink("victim", folder / ".facet-00000000000000aa.part");
  const int in_use = open((folder / ".facet-fedcba9876543210.part").c_str(), O_RDONLY);
  ASSERT_EQ(flock(in_use, LOCK_EX), 0);
  WriteFile(folder / "a", std::string("a"));
  EXPECT_EQ(folder.Names(), (Names{".facet-00000000000000aa.part", ".facet-0123456789abcdef.part.txt",
                                   ".facet-0123456789abcdeg.part", ".facet-fedcba9876543210.part", "a", "victim"}));
  close(in_use);
  WriteFile(folder / "a", std::string("a"));
  EXPECT_FALSE(fs::exists(folder / ".facet-fedcba9876543210.part"));
}

TEST(OutputFile, IsFoundWhenItsProcessWasKilled) {
  const ScratchFolder folder;
  int ready[2];
  ASSERT_EQ(pipe(ready), 0);
  const pid_t child = fork();
  if (child == 0) {
    OutputFile file(folder / "a");
    file.Write(BytesOf("half"));
    [[maybe_unused]] const ssize_t told = write(ready[1], "x", 1);
    for (;;) pause();
  }
  char byte = 0;
  ASSERT_EQ(read(ready[0], &byte, 1), 1);
  WriteFile(folder / "b", std::string("b"));
  EXPECT_EQ(folder.Names().size(), 2u) << "the other still writes";
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  EXPECT_EQ(folder.Names().size(), 2u);
  WriteFile(folder / "b", std::string("b"));
  EXPECT_EQ(folder.Names(), Names{"b"});
}

TEST(OutputFile, ManyThreadsWriteToOneFolder) {
  const ScratchFolder folder;
  std::vector<std::thread> threads;
  for (int t = 0; t < 8; ++t) {
    threads.emplace_back([&folder, t] {
      for (int i = 0; i < 50; ++i) WriteFile(folder / std::to_string(t), std::to_string(i));
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(folder.Names().size(), 8u);
  for (const std::string& name : folder.Names()) EXPECT_EQ(TextOf(folder / name), "49");
}

TEST(OutputFile, ASignalsHandlerRemovesIt) {
  const ScratchFolder folder;
  int ready[2];
  ASSERT_EQ(pipe(ready), 0);
  const pid_t child = fork();
  if (child == 0) {
    std::signal(SIGTERM, [](int) {
      RemoveUnfinishedFiles();
      _exit(7);
    });
    OutputFile one(folder / "a"), two(folder / "b");
    [[maybe_unused]] const ssize_t told = write(ready[1], "x", 1);
    for (;;) pause();
  }
  char byte = 0;
  ASSERT_EQ(read(ready[0], &byte, 1), 1);
  EXPECT_EQ(folder.Names().size(), 2u);
  kill(child, SIGTERM);
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_EQ(WEXITSTATUS(status), 7);
  EXPECT_EQ(folder.Names(), Names{});
}

// In a process of its own: the limit on the size of files holds for all that it writes. Nothing ignores the signals.
TEST(OutputFile, LimitsAndPipesWithoutReadersAreErrorsAndNotDeaths) {
  const ScratchFolder folder;
  Put(folder / "a", "before");
  ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
  const pid_t child = fork();
  if (child == 0) {
    std::signal(SIGXFSZ, SIG_DFL);
    std::signal(SIGPIPE, SIG_DFL);
    const int reader = open((folder / "pipe").c_str(), O_RDONLY | O_NONBLOCK);
    OutputFile pipe(folder / "pipe");
    close(reader);
    const rlimit limit = {1000, RLIM_INFINITY};
    setrlimit(RLIMIT_FSIZE, &limit);
    const std::string text(5000, 'x');
    int failures = 0;
    try {
      pipe.Write(BytesOf(text));
    } catch (const Error& error) {
      failures += std::string(error.what()).find("Broken pipe") != std::string::npos;
    }
    try {
      WriteFile(folder / "a", text);
    } catch (const Error& error) {
      failures += std::string(error.what()).find("File too large") != std::string::npos;
    }
    _exit(failures);
  }
  int status = 0;
  waitpid(child, &status, 0);
  ASSERT_TRUE(WIFEXITED(status)) << "ended by signal " << WTERMSIG(status);
  EXPECT_EQ(WEXITSTATUS(status), 2);
  EXPECT_EQ(TextOf(folder / "a"), "before");
  EXPECT_EQ(folder.Names(), (Names{"a", "pipe"}));
}

TEST(OutputFile, WritesToPipesAndDevicesDirectly) {
  const ScratchFolder folder;
  ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
  std::string read_back;
  std::thread reader([&] { read_back = TextOf(folder / "pipe"); });
  WriteFile(folder / "pipe", std::string("through"));
  reader.join();
  EXPECT_EQ(read_back, "through");
  EXPECT_EQ(folder.Names(), Names{"pipe"});
  WriteFile("/dev/null", std::string("gone"));
  EXPECT_NE(Refusal([] { WriteFile("/dev/full", std::string("none")); }, ErrorCode::OutputFailed).find("No space left"),
            std::string::npos);
  EXPECT_TRUE(IsPlainFile(folder / "a"));
  EXPECT_FALSE(IsPlainFile(folder / "pipe"));
  EXPECT_FALSE(IsPlainFile("/dev/null"));
}

TEST(OutputFile, SaysWhyItCannotBeWritten) {
  const ScratchFolder folder;
  fs::create_directory(folder / "folder");
  const auto refused = [&](const std::string& name, const char* part) {
    const std::string what = Refusal([&] { WriteFile(folder / name, std::string()); }, ErrorCode::OutputFailed);
    EXPECT_NE(what.find((folder / name).string()), std::string::npos) << what;
    EXPECT_NE(what.find(part), std::string::npos) << what;
  };
  refused("missing/a", "No such file or directory");
  refused("folder", "Is a directory");
  refused(std::string(300, 'n'), "File name too long");
  EXPECT_EQ(folder.Names(), Names{"folder"});
  EXPECT_NE(Refusal([&] { CheckWritable(folder / "folder"); }, ErrorCode::OutputFailed).find("is a folder"),
            std::string::npos);
  EXPECT_NE(Refusal([&] { CheckWritable(folder / "missing/a"); }, ErrorCode::OutputFailed).find("does not exist"),
            std::string::npos);
  CheckWritable(folder / "a");
}

TEST(RefuseOverwriting, KnowsFilesByAnyName) {
  const ScratchFolder folder;
  Put(folder / "in", "in");
  fs::create_symlink("in", folder / "link");
  fs::create_hard_link(folder / "in", folder / "hard");
  const fs::path in = folder / "in";
  for (const fs::path& out : {in, folder / "link", folder / "hard", folder / "x/../in", folder / "./in"}) {
    fs::create_directories(folder / "x");
    EXPECT_NE(Refusal(
                  [&] {
                    RefuseOverwriting({folder / "other", out}, {in});
                  },
                  ErrorCode::InvalidUsage)
                  .find("is also an input"),
              std::string::npos)
        << out;
  }
  RefuseOverwriting({folder / "out", "/dev/null"}, {in, folder / "missing", "/dev/null"});
  EXPECT_NE(Refusal(
                [&] {
                  RefuseOverwriting({folder / "new", folder / "x/../new"}, {});
                },
                ErrorCode::InvalidUsage)
                .find("two outputs"),
            std::string::npos);
}

}  // namespace
}  // namespace facet
