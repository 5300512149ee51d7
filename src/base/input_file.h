// Files that are read, and the bytes that they hold.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <span>
#include <string_view>

namespace facet {

// Bytes that someone else owns, kept alive: a file is read once, and its buffers and images are slices of it.
struct Bytes {
  std::shared_ptr<const void> owner;
  const std::byte* data = nullptr;
  std::size_t size = 0;
  bool is_mapped = false;  // a file's pages, which take no memory of their own

  std::span<const std::byte> Span() const { return {data, size}; }
  std::string_view Text() const { return {reinterpret_cast<const char*>(data), size}; }
  // The caller has checked offset + length <= size.
  Bytes Slice(std::size_t offset, std::size_t length) const { return {owner, data + offset, length, is_mapped}; }
};

struct MutableBytes {
  std::shared_ptr<std::byte[]> owner;
  std::size_t size = 0;

  std::byte* data() const { return owner.get(); }
  Bytes Freeze() const { return {owner, owner.get(), size}; }
};

// Uninitialised. Not charged to the memory budget: the caller knows what they are for.
MutableBytes AllocateBytes(std::size_t size);

struct ReadOptions {
  // Only regular files: for names that data gives, which may be those of pipes and devices.
  bool regular_only = false;
  // Maps large files instead of reading them: what is not used of them is not read, and there is no copy. They must
  // stay as they are for as long as the bytes are in use: a mapped file that is cut short ends the process (SIGBUS).
  bool map = false;
  std::size_t most = std::numeric_limits<std::size_t>::max();  // bytes from the start; what follows is left unread
};

// What files that are read are charged for.
inline constexpr const char* kFilesCharge = "files";

// A whole file, or its start. What is read (not what is mapped) is charged to the current memory budget (see
// memory_budget.h) for good. `file_size` gets the size of the whole, where given.
// Throws Error: NotFound (no such file, a folder, no permission, not a regular file), OutOfMemory.
Bytes ReadFile(const std::filesystem::path& path, const ReadOptions& options = {}, std::uintmax_t* file_size = nullptr);

// The path of a file that `named_by`, another file, names: relative to its folder. It must lie in `root`, or, where
// that is empty, in the folder of `named_by`, also when links are followed. (A file that is itself a link into another
// folder names files of that folder too.) Names from data are opened in no other way. Throws Error(InvalidInput) for a
// path that leads out of that folder.
std::filesystem::path DataPath(const std::filesystem::path& named_by, const std::filesystem::path& name,
                               const std::filesystem::path& root = {});

}  // namespace facet
