// Files that are written: each appears under its name whole or not at all.
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

// A file that is being written. Its bytes go to a temporary file in the same folder, whose name nobody can foretell and
// which is made anew or not at all; Commit() brings it to the disk and gives it the name that was asked for. Until
// then, and when anything fails, what stood under that name stays as it was. A pipe or a device is written directly,
// because it has no state to keep whole. Not thread-safe.
//
// Temporary files are locked for as long as they are written. One that is not locked belongs to a process that was
// killed: whoever writes to the same folder next removes it.
class OutputFile {
 public:
  // What becomes of a symbolic link under the name. Follow: the file that it leads to is written, as a shell's
  // redirection does, and the link stays; for names that users give. Refuse: links, pipes and devices are an error; for
  // names that data or facet itself gives.
  enum class Links : std::uint8_t { Follow, Refuse };

  // Throws Error(OutputFailed), like all that follows; messages name `path`.
  explicit OutputFile(const std::filesystem::path& path, Links links = Links::Follow);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  void Write(std::span<const std::byte> bytes);

  // Replaces bytes that were written before. Not for pipes and devices.
  void Rewrite(std::uint64_t offset, std::span<const std::byte> bytes);

  // All is written. Nothing may follow.
  void Commit();

 private:
  [[noreturn]] void Fail(int error) const;
  void Open(const std::filesystem::path& target);

  std::string name_;                 // what messages call it
  std::filesystem::path target_;     // `path` with links followed
  std::filesystem::path temporary_;  // empty: it is written directly
  std::optional<UnfinishedFile> unfinished_;
  int descriptor_ = -1;
};

// Writes a whole file: the parts, one after the other. Throws Error(OutputFailed).
void WriteFile(const std::filesystem::path& path, std::initializer_list<std::span<const std::byte>> parts,
               OutputFile::Links links = OutputFile::Links::Follow);
void WriteFile(const std::filesystem::path& path, std::span<const std::byte> bytes,
               OutputFile::Links links = OutputFile::Links::Follow);
void WriteFile(const std::filesystem::path& path, const std::string& text);

// True for a name that can be written in any order: no pipe and no device.
bool IsPlainFile(const std::filesystem::path& path);

// Throws Error(OutputFailed) when it can be seen already that `path` cannot be written: its folder does not exist or
// may not be written to, or there is a folder of that name.
void CheckWritable(const std::filesystem::path& path);

// Files, whatever their names: links of both kinds are the file that they lead to. Those that are not there are told
// apart by their names.
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
