// Input files and their bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <span>
#include <string_view>

namespace facet {

// A slice of bytes with shared ownership: a file is read once, and its buffers and images are slices of it.
struct Bytes {
  std::shared_ptr<const void> owner;
  const std::byte* data = nullptr;
  std::size_t size = 0;
  bool is_mapped = false;  // pages of a mapped file, which take no memory of the process

  std::span<const std::byte> Span() const { return {data, size}; }
  std::string_view Text() const { return {reinterpret_cast<const char*>(data), size}; }
  // The caller must check that offset + length <= size.
  Bytes Slice(std::size_t offset, std::size_t length) const { return {owner, data + offset, length, is_mapped}; }
};

struct MutableBytes {
  std::shared_ptr<std::byte[]> owner;
  std::size_t size = 0;

  std::byte* data() const { return owner.get(); }
  Bytes Freeze() const { return {owner, owner.get(), size}; }
};

// Allocates uninitialised bytes. The caller charges them to the memory budget, since it knows their purpose.
MutableBytes AllocateBytes(std::size_t size);

struct ReadOptions {
  // Refuse all but regular files. For names that come from data, which may be those of pipes and devices.
  bool regular_only = false;
  // Map large files instead of reading them, so that unused parts are not read and nothing is copied. They must not
  // change while the bytes are in use: if a mapped file is truncated, the process ends with SIGBUS.
  bool map = false;
  std::size_t most = std::numeric_limits<std::size_t>::max();  // bytes from the start; the rest is not read
};

// The purpose under which files are charged to the memory budget.
inline constexpr const char* kFilesCharge = "files";

// Reads a file, or its start. Bytes that are read (not mapped) are charged to the current memory budget (see
// memory_budget.h) and not released. `*file_size`, if given, receives the size of the whole file. Throws Error:
// NotFound (no such file, a folder, no permission, not a regular file), OutOfMemory.
Bytes ReadFile(const std::filesystem::path& path, const ReadOptions& options = {}, std::uintmax_t* file_size = nullptr);

// Resolves a path that the file `named_by` contains, relative to its folder. The result must lie in `root`, or, if that
// is empty, in the folder of `named_by`, also after following symbolic links. (If `named_by` is a link into another
// folder, that folder is allowed too.) Every path that comes from data must be resolved by this function. Throws
// Error(InvalidInput) for a path that leads out of the folder.
std::filesystem::path DataPath(const std::filesystem::path& named_by, const std::filesystem::path& name,
                               const std::filesystem::path& root = {});

}  // namespace facet
