#include "gltf/bytes.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <limits>
#include <string>
#include <utility>

#include <sys/stat.h>

#include "base/pages.h"
#include "facet/error.h"

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace facet::gltf {
namespace {

// Files from here on are mapped: what is not used of them is not read, and there is no copy. Smaller ones are read,
// because a mapped file must stay as it is for as long as its scene is in use.
constexpr std::size_t kMappedSize = std::size_t{64} << 20;

// No data where the system does not map the file.
Bytes Map([[maybe_unused]] std::FILE* file, [[maybe_unused]] std::size_t size) {
#ifdef __linux__
  void* const memory = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, ::fileno(file), 0);
  if (memory != MAP_FAILED) {
    std::shared_ptr<const void> owner(memory, [size](void* p) { ::munmap(p, size); });
    return {std::move(owner), static_cast<const std::byte*>(memory), size};
  }
#endif
  return {};
}

}  // namespace

MutableBytes AllocateBytes(std::size_t size) {
  return {std::shared_ptr<std::byte[]>(static_cast<std::byte*>(AllocatePages(size)),
                                       [size](std::byte* bytes) { FreePages(bytes, size); }),
          size};
}

Bytes ReadFileStart(const std::filesystem::path& path, std::size_t most, std::uintmax_t* file_size) {
  const std::string name = path.string();
  std::error_code ignored;
  const auto status = std::filesystem::status(path, ignored);
  if (!std::filesystem::exists(status)) {
    throw Error(ErrorCode::NotFound, "no such file", name, "check the path");
  }
  // A directory, a device or a pipe would give no size, or no end.
  if (!std::filesystem::is_regular_file(status)) throw Error(ErrorCode::NotFound, "not a regular file", name);
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(name.c_str(), "rb"), &std::fclose);
  if (!file) {
    throw Error(ErrorCode::NotFound, std::string("cannot be opened (") + std::strerror(errno) + ")", name,
                "check the permissions");
  }
  // Of the open file, which another may have replaced under its name.
  struct stat opened;
  if (::fstat(fileno(file.get()), &opened) != 0) throw Error(ErrorCode::NotFound, "cannot be read", name);
  const auto size = static_cast<std::uintmax_t>(opened.st_size);
  if (file_size) *file_size = size;
  const auto wanted = static_cast<std::size_t>(std::min<std::uintmax_t>(size, most));
  if (wanted >= kMappedSize) {
    Bytes mapped = Map(file.get(), wanted);
    if (mapped.data != nullptr) return mapped;
  }
  MutableBytes bytes = AllocateBytes(wanted);
  bytes.size = std::fread(bytes.data(), 1, bytes.size, file.get());
  if (std::ferror(file.get())) throw Error(ErrorCode::NotFound, "cannot be read", name);
  return bytes.Freeze();
}

Bytes ReadWholeFile(const std::filesystem::path& path) {
  return ReadFileStart(path, std::numeric_limits<std::size_t>::max());
}

}  // namespace facet::gltf
