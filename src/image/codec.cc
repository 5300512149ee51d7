#include "image/codec.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <new>

#include "base/bytes_text.h"
#include "base/float_environment.h"
#include "base/pages.h"
#include "facet/error.h"
#include "facet/load.h"
#include "image/jpeg.h"
#include "image/limits.h"
#include "image/oiio_loader.h"
#include "image/png.h"
#include "image/radiance.h"

namespace facet {
namespace {

class File {
 public:
  explicit File(int descriptor) : descriptor_(descriptor) {}
  ~File() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  int get() const { return descriptor_; }
  // False with errno set: some file systems report a full disk only here.
  bool Close() {
    const int descriptor = descriptor_;
    descriptor_ = -1;
    return ::close(descriptor) == 0;
  }

 private:
  int descriptor_;
};

[[noreturn]] void FailOutput(const std::filesystem::path& path, int error) {
  throw Error(ErrorCode::OutputFailed, std::string("cannot be written: ") + std::strerror(error), path.string());
}

// In the same folder, so that the rename stays within one file system; the extension stays, as encoders go by it.
std::filesystem::path TemporaryName(const std::filesystem::path& path) {
  static std::atomic<unsigned> counter = 0;
  std::filesystem::path name = ".";
  name += path.stem();
  name += ".part-" + std::to_string(::getpid()) + "-" + std::to_string(counter.fetch_add(1));
  name += path.extension();
  return path.parent_path() / name;
}

}  // namespace

void CheckImageSize(std::uint64_t width, std::uint64_t height, const std::string& name) {
  if (width == 0 || height == 0) throw Error(ErrorCode::InvalidInput, "an empty picture", name);
  const auto side = static_cast<std::uint64_t>(kMaxImageSide);
  if (width <= side && height <= side && width * height <= kMaxImagePixels) return;
  throw Error(ErrorCode::OutOfMemory,
              std::to_string(width) + " x " + std::to_string(height) + " pixels, " +
                  BytesText(4.0 * double(width) * double(height)) + " at 4 bytes each, are more than the limit of " +
                  std::to_string(kMaxImageSide) + " a side and " + std::to_string(kMaxImagePixels) + " in all",
              name, "scale the picture down");
}

std::vector<std::byte> AllocatePixels(std::size_t count, const std::string& name) {
  try {
    std::vector<std::byte> pixels;
    pixels.reserve(count);
    PreferHugePages(pixels.data(), count);
    pixels.resize(count);
    return pixels;
  } catch (const std::bad_alloc&) {
    throw Error(ErrorCode::OutOfMemory, "no memory for " + std::to_string(count) + " bytes of pixels", name);
  }
}

std::vector<std::byte> ReadFileWhole(const std::filesystem::path& path) {
  const auto fail = [&](int error) {
    throw Error(ErrorCode::NotFound, std::string("cannot be read: ") + std::strerror(error), path.string());
  };
  const File file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (file.get() < 0) fail(errno);
  struct stat status {};
  if (::fstat(file.get(), &status) != 0) fail(errno);
  if (S_ISDIR(status.st_mode)) fail(EISDIR);
  std::vector<std::byte> bytes;
  // The size is a hint: pipes have none.
  std::size_t used = 0;
  try {
    bytes.resize(static_cast<std::size_t>(std::max<off_t>(status.st_size, 0)) + 1);
    for (;;) {
      if (used == bytes.size()) bytes.resize(bytes.size() * 2 + 4096);
      const ssize_t count = ::read(file.get(), bytes.data() + used, bytes.size() - used);
      if (count < 0 && errno == EINTR) continue;
      if (count < 0) fail(errno);
      if (count == 0) break;
      used += static_cast<std::size_t>(count);
    }
  } catch (const std::bad_alloc&) {
    throw Error(ErrorCode::OutOfMemory, "the file is larger than the memory", path.string());
  }
  bytes.resize(used);
  return bytes;
}

void WriteFileWhole(const std::filesystem::path& path, const std::function<void(const std::filesystem::path&)>& write) {
  std::error_code ignored;
  // A pipe or a device stays what it is: it has no state to keep whole. A link stays a link to the new file.
  const std::filesystem::file_status status = std::filesystem::status(path, ignored);
  if (std::filesystem::is_fifo(status) || std::filesystem::is_character_file(status)) return write(path);
  const std::filesystem::path target =
      std::filesystem::is_symlink(path, ignored) ? std::filesystem::weakly_canonical(path, ignored) : path;
  const std::filesystem::path temporary = TemporaryName(target);
  try {
    write(temporary);
  } catch (...) {
    ::unlink(temporary.c_str());
    throw;
  }
  if (::rename(temporary.c_str(), target.c_str()) == 0) return;
  const int error = errno;
  ::unlink(temporary.c_str());
  FailOutput(path, error);
}

void WriteFileWhole(const std::filesystem::path& path, std::span<const std::byte> bytes) {
  WriteFileWhole(path, std::initializer_list<std::span<const std::byte>>{bytes});
}

void WriteFileWhole(const std::filesystem::path& path, std::initializer_list<std::span<const std::byte>> parts) {
  WriteFileWhole(path, [&](const std::filesystem::path& temporary) {
    File file(::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
    if (file.get() < 0) FailOutput(path, errno);
    for (std::span<const std::byte> left : parts) {
      while (!left.empty()) {
        const ssize_t count = ::write(file.get(), left.data(), left.size());
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) FailOutput(path, count < 0 ? errno : EIO);
        left = left.subspan(static_cast<std::size_t>(count));
      }
    }
    if (!file.Close()) FailOutput(path, errno);
  });
}

Image DecodeImage(std::span<const std::byte> bytes, const std::string& name) {
  if (LooksLikePng(bytes) || LooksLikeJpeg(bytes)) {
    Image image;
    const auto decode = LooksLikePng(bytes) ? DecodePng : DecodeJpeg;
    decode(bytes, name, kMaxImageSide, [&](Image& whole, int) { image = std::move(whole); });
    return image;
  }
  if (LooksLikeRadiance(bytes)) return DecodeRadiance(bytes, name);
  if (bytes.size() < 12) throw Error(ErrorCode::InvalidInput, "too short for a picture", name);
  return DecodeWithOiio(bytes, name);
}

void DecodeImageRows(std::span<const std::byte> bytes, const std::string& name, const RowReceiver& receive) {
  constexpr int kRows = 64;  // a piece stays in the processor's cache until the receiver has it
  if (LooksLikePng(bytes)) return DecodePng(bytes, name, kRows, receive);
  if (LooksLikeJpeg(bytes)) return DecodeJpeg(bytes, name, kRows, receive);
  const Image whole = DecodeImage(bytes, name);
  receive(whole, whole.height);
}

Image LoadImage(const std::filesystem::path& path) {
  const FloatEnvironment pinned;
  return DecodeImage(ReadFileWhole(path), path.string());
}

}  // namespace facet
