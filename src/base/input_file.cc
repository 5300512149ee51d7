#include "base/input_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include "base/memory_budget.h"
#include "base/pages.h"
#include "base/printable.h"
#include "facet/error.h"

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace facet {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMappedSize = std::size_t{64} << 20;  // smaller files are read whole: it is as fast, and safer

class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int get() const { return number_; }

 private:
  int number_;
};

// Maps a file. The result has no data if the system cannot map it.
Bytes Map([[maybe_unused]] int file, [[maybe_unused]] std::size_t size) {
#ifdef __linux__
  void* const memory = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, file, 0);
  if (memory != MAP_FAILED) {
    std::shared_ptr<const void> owner(memory, [size](void* p) { ::munmap(p, size); });
    return {std::move(owner), static_cast<const std::byte*>(memory), size, true};
  }
#endif
  return {};
}

// Reads up to `size` bytes, fewer only at the end of the file.
template <class Fail>
std::size_t Fill(int file, std::byte* to, std::size_t size, const Fail& fail) {
  std::size_t done = 0;
  while (done < size) {
    const ssize_t count = ::read(file, to + done, size - done);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) fail(std::strerror(errno));
    if (count == 0) break;
    done += static_cast<std::size_t>(count);
  }
  return done;
}

// Reads a pipe or a device, whose size is not known beforehand.
template <class Fail>
Bytes ReadStream(int file, std::size_t most, const std::string& name, const Fail& fail) {
  constexpr std::size_t kFirst = std::size_t{1} << 16;
  std::vector<std::byte> bytes;
  std::size_t used = 0;
  while (used == bytes.size() && used < most) {
    const std::size_t more = std::min(std::max(kFirst, used), most - used);
    MemoryBudget::Current().Charge(more, 1, kFilesCharge, name);
    bytes.resize(used + more);
    used += Fill(file, bytes.data() + used, more, fail);
  }
  const auto owner = std::make_shared<std::vector<std::byte>>(std::move(bytes));
  return {owner, owner->data(), used};
}

// Whether `path`, with its links followed, is `folder` or lies in it.
bool LiesIn(const fs::path& path, const fs::path& folder) {
  std::error_code ignored;
  // Made absolute first, because the canonical form of a relative path that does not exist is relative.
  const fs::path real = fs::weakly_canonical(fs::absolute(path, ignored), ignored);
  const fs::path relative = real.lexically_relative(fs::canonical(folder, ignored));
  return !relative.empty() && *relative.begin() != "..";
}

}  // namespace

MutableBytes AllocateBytes(std::size_t size) {
  return {std::shared_ptr<std::byte[]>(static_cast<std::byte*>(AllocatePages(size)),
                                       [size](std::byte* bytes) { FreePages(bytes, size); }),
          size};
}

Bytes ReadFile(const fs::path& path, const ReadOptions& options, std::uintmax_t* file_size) {
  const std::string name = Printable(path.string());
  const auto fail = [&](const std::string& why, const char* hint = "") {
    throw Error(ErrorCode::NotFound, why, name, hint);
  };
  // O_NONBLOCK, because opening a pipe that data names would otherwise wait for a writer.
  const Descriptor file(
      ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOCTTY | (options.regular_only ? O_NONBLOCK : 0)));
  if (file.get() < 0) {
    if (errno == ENOENT || errno == ENOTDIR) fail("no such file", "check the path");
    if (errno == EACCES) fail("cannot be opened: Permission denied", "check the permissions");
    fail(std::string("cannot be opened: ") + std::strerror(errno));
  }
  struct stat status {};
  if (::fstat(file.get(), &status) != 0) fail("cannot be read");
  if (S_ISDIR(status.st_mode)) fail("is a folder", "give the name of a file");
  const bool regular = S_ISREG(status.st_mode);
  if (options.regular_only && !regular) fail("is not a regular file");
  // Files of /proc have size 0 but are not empty.
  if (!regular || status.st_size == 0) {
    Bytes bytes = ReadStream(file.get(), options.most, name, fail);
    if (file_size) *file_size = bytes.size;
    return bytes;
  }
  if (file_size) *file_size = static_cast<std::uintmax_t>(status.st_size);
  const auto wanted = static_cast<std::size_t>(std::min<std::uintmax_t>(std::uintmax_t(status.st_size), options.most));
  if (options.map && wanted >= kMappedSize) {
    Bytes mapped = Map(file.get(), wanted);
    if (mapped.data != nullptr) return mapped;
  }
  MemoryBudget::Current().Charge(wanted, 1, kFilesCharge, name);
  MutableBytes bytes = AllocateBytes(wanted);
  bytes.size = Fill(file.get(), bytes.data(), wanted, fail);
  return bytes.Freeze();
}

fs::path DataPath(const fs::path& named_by, const fs::path& name, const fs::path& root) {
  // For the operating system a zero byte would end the name, which would then differ from the one in messages.
  if (name.native().find('\0') != std::string::npos) {
    throw Error(ErrorCode::InvalidInput, Quoted(name.string()) + " is no file's name", Printable(named_by.string()));
  }
  const fs::path folder = named_by.has_parent_path() ? named_by.parent_path() : fs::path(".");
  const fs::path path = named_by.parent_path() / name;
  std::error_code ignored;
  const bool inside = !root.empty()
                          ? LiesIn(path, root)
                          : !name.is_absolute() &&
                                (LiesIn(path, folder) || LiesIn(path, fs::canonical(named_by, ignored).parent_path()));
  if (inside) return path;
  throw Error(ErrorCode::InvalidInput,
              Quoted(name.string()) + " lies outside of the folder " + Quoted((root.empty() ? folder : root).string()),
              Printable(named_by.string()), "if the file is to be trusted, give a folder that holds both (--root)");
}

}  // namespace facet
