// Output files, which are written atomically: each appears completely or not at all.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/unfinished_files.h"

namespace facet {

// A file that is being written. Its bytes go to a new temporary file in the same folder with an unpredictable name.
// Commit() flushes it to the disk and renames it to the final name. Until then, and if anything fails, an existing file
// of that name does not change. Pipes and devices are written directly. Not thread-safe.
//
// Temporary files are locked while they are written. One without a lock was left behind by a process that was killed,
// and is removed by the next process that writes to the folder.
class OutputFile {
 public:
  // How a symbolic link of that name is treated. Follow: the file that it points to is written, like a shell's
  // redirection, and the link stays; for names that users give. Refuse: links, pipes and devices are an error; for
  // names that come from data or from facet.
  enum class Links : std::uint8_t { Follow, Refuse };

  // Throws Error(OutputFailed), as do all functions below; messages name `path`.
  explicit OutputFile(const std::filesystem::path& path, Links links = Links::Follow);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  void Write(std::span<const std::byte> bytes);

  // Replaces bytes that were written before. Not for pipes and devices.
  void Rewrite(std::uint64_t offset, std::span<const std::byte> bytes);

  // Finishes the file. No other call may follow.
  void Commit();

 private:
  [[noreturn]] void Fail(int error) const;
  void Open(const std::filesystem::path& target);

  std::string name_;                 // for messages
  std::filesystem::path target_;     // `path` with links followed
  std::filesystem::path temporary_;  // empty: the target is written directly
  std::optional<UnfinishedFile> unfinished_;
  int descriptor_ = -1;
};

// Writes a whole file: the parts, one after the other. Throws Error(OutputFailed).
void WriteFile(const std::filesystem::path& path, std::initializer_list<std::span<const std::byte>> parts,
               OutputFile::Links links = OutputFile::Links::Follow);
void WriteFile(const std::filesystem::path& path, std::span<const std::byte> bytes,
               OutputFile::Links links = OutputFile::Links::Follow);
void WriteFile(const std::filesystem::path& path, const std::string& text);

// Whether the file can be written in any order, so is neither a pipe nor a device.
bool IsPlainFile(const std::filesystem::path& path);

// Throws Error(OutputFailed) if `path` obviously cannot be written: its folder does not exist or is not writable, or
// there is a folder of that name.
void CheckWritable(const std::filesystem::path& path);

// A set of files, identified by device and inode, so that hard and symbolic links count as the file that they lead to.
// Files that do not exist are identified by their names.
class FileSet {
 public:
  bool Add(const std::filesystem::path& path);  // false: it was in the set
  bool Has(const std::filesystem::path& path) const;

 private:
  std::set<std::pair<std::uint64_t, std::uint64_t>> there_;  // device and inode
  std::set<std::filesystem::path> named_;
};

// Throws Error(InvalidUsage) when two of `outputs` are the same file, or one of them is the same file as one of
// `inputs`, under whatever names.
void RefuseOverwriting(const std::vector<std::filesystem::path>& outputs,
                       const std::vector<std::filesystem::path>& inputs);
void RefuseOverwritingAnyOf(const FileSet& inputs, const std::vector<std::filesystem::path>& outputs);

}  // namespace facet
