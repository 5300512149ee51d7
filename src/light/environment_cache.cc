// The cache of prefiltered environments, one file of a folder each: OpenEnvironment() of facet/load.h.
//
// A file's name is the digest of everything that its content depends on (the bytes of the environment image, the
// options, the version of facet), so that an entry never becomes out of date. The content has a digest of its own, by
// which truncated and damaged files are recognised. A file consists of a Header, the texels of all maps, and the pixels
// of the linear image if that is kept: floats in native byte order.
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <system_error>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/float_environment.h"
#include "base/input_file.h"
#include "base/output_file.h"
#include "base/parallel.h"
#include "base/sha256.h"
#include "facet/error.h"
#include "facet/load.h"
#include "facet/version.h"
#include "image/codec.h"
#include "image/convert.h"
#include "light/environment_source.h"

namespace facet {
namespace {

constexpr std::uint32_t kFormat = 1;  // of the cache files; raised when their layout changes

struct Header {
  std::array<char, 16> magic = {'f', 'a', 'c', 'e', 't', ' ', 'l', 'i', 'g', 'h', 't', ' ', 'm', 'a', 'p', '\n'};
  std::uint32_t byte_order = 0x01020304;
  std::uint32_t format = kFormat;
  Digest key{};
  std::int32_t size = 0;  // of the sharpest level, in texels
  std::int32_t image_width = 0, image_height = 0;
  std::int32_t zero = 0;
  std::uint64_t repaired_values = 0;
  Digest content{};  // of the other header fields and all floats
};
static_assert(sizeof(Header) == 112 && std::has_unique_object_representations_v<Header>, "no padding");

constexpr std::size_t kPiece = std::size_t{64} << 10;
using Scratch = std::array<std::byte, kPiece>;

// Adds to `hash` the digests of the pieces that `size` bytes are divided into, instead of the bytes themselves: pieces
// can then be read and hashed on all threads. get(first, size, scratch) returns one piece, which may lie in `scratch`.
template <class Get>
void AddInPieces(Sha256& hash, std::size_t size, const Get& get) {
  std::vector<Digest> pieces((size + kPiece - 1) / kPiece);
  ParallelFor(pieces.size(), 1, [&](std::size_t begin, std::size_t end) {
    Scratch scratch;
    for (std::size_t i = begin; i < end; ++i) {
      Sha256 of_piece;
      of_piece.Add(get(i * kPiece, std::min(kPiece, size - i * kPiece), scratch));
      pieces[i] = of_piece.Finish();
    }
  });
  hash.Add(std::uint64_t(size));
  hash.AddArray(pieces);
}

void AddInPieces(Sha256& hash, std::span<const std::byte> bytes) {
  AddInPieces(hash, bytes.size(),
              [&](std::size_t first, std::size_t size, Scratch&) { return bytes.subspan(first, size); });
}

Digest DigestOf(std::span<const std::byte> bytes) {
  Sha256 hash;
  AddInPieces(hash, bytes);
  return hash.Finish();
}

Sha256 BeginContent(Header header) {
  header.content = {};
  Sha256 hash;
  hash.Add(std::as_bytes(std::span(&header, 1)));
  return hash;
}

// Whether PrefilterEnvironment() can have produced these floats: they are means of values from 0 to kMaxRadiance, apart
// from rounding, and none is NaN.
bool IsLight(std::span<const float> numbers) {
  constexpr float kMost = 2.0f * kMaxRadiance;
  bool fine = true;
  for (const float number : numbers) fine &= (number >= 0.0f) & (number <= kMost);
  return fine;
}

class OpenFile {
 public:
  // O_NONBLOCK, because opening a pipe of that name would otherwise wait for a writer.
  explicit OpenFile(const std::filesystem::path& path)
      : descriptor_(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)) {}
  ~OpenFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;

  // 0 for everything that is not a regular file.
  std::uint64_t Size() const {
    struct stat status {};
    const bool plain = descriptor_ >= 0 && ::fstat(descriptor_, &status) == 0 && S_ISREG(status.st_mode);
    return plain ? std::uint64_t(status.st_size) : 0;
  }

  // False if the file has fewer bytes.
  bool Read(std::uint64_t offset, std::span<std::byte> to) const {
    while (!to.empty()) {
      const ssize_t count = ::pread(descriptor_, to.data(), to.size(), static_cast<off_t>(offset));
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0) return false;
      offset += static_cast<std::uint64_t>(count);
      to = to.subspan(static_cast<std::size_t>(count));
    }
    return true;
  }

 private:
  int descriptor_;
};

class CachedEnvironment final : public EnvironmentSource {
 public:
  // A regular file is only hashed, piece by piece: allocating memory for all of it would take longer than its digest.
  // What cannot be read twice, such as a pipe, is kept in memory.
  CachedEnvironment(std::filesystem::path image_file, std::filesystem::path folder)
      : image_file_(std::move(image_file)), folder_(std::move(folder)) {
    std::error_code ignored;
    const OpenFile file(std::filesystem::is_regular_file(image_file_, ignored) ? image_file_ : std::filesystem::path());
    const std::uint64_t file_size = file.Size();
    if (file_size == 0) {
      bytes_ = ReadFile(image_file_);
      digest_ = DigestOf(bytes_.Span());
      return;
    }
    Sha256 hash;
    AddInPieces(hash, file_size, [&](std::size_t first, std::size_t size, Scratch& scratch) {
      const auto piece = std::span(scratch).first(size);
      if (!file.Read(first, piece)) throw Error(ErrorCode::NotFound, "cannot be read whole", image_file_.string());
      return std::span<const std::byte>(piece);
    });
    digest_ = hash.Finish();
  }

  std::shared_ptr<const Image> Decode() const override {
    const FloatEnvironment pinned;
    if (bytes_.size > 0) return std::make_shared<const Image>(DecodeImage(bytes_.Span(), image_file_.string()));
    const Bytes bytes = ReadFile(image_file_);
    // Otherwise the maps of another image would be stored under this digest.
    if (DigestOf(bytes.Span()) != digest_) {
      throw Error(ErrorCode::InvalidInput, "was changed while it was in use", image_file_.string());
    }
    return std::make_shared<const Image>(DecodeImage(bytes.Span(), image_file_.string()));
  }

  std::shared_ptr<const EnvironmentMap> Find(const EnvironmentOptions& options,
                                             const std::function<void(std::uint64_t)>& admit) const override {
    const Digest key = KeyOf(options);
    const OpenFile file(PathOf(key));
    const std::uint64_t file_size = file.Size();
    if (file_size < sizeof(Header)) return nullptr;
    const Header expected{.key = key};
    Header header;
    if (!file.Read(0, std::as_writable_bytes(std::span(&header, 1))) || header.magic != expected.magic ||
        header.byte_order != expected.byte_order || header.format != kFormat || header.key != key) {
      return nullptr;
    }
    // Sizes are checked before memory is allocated for them, since the digest can be checked only afterwards.
    const std::int32_t width = header.image_width, height = header.image_height;
    const bool size_ok =
        header.size >= 64 && header.size <= options.max_size && std::has_single_bit(unsigned(header.size));
    // PrefilterEnvironment() doubles the row of an image of height 1.
    const bool image_ok = options.keep_image
                              ? width >= 1 && width <= kMaxImageSide && height >= 2 && height <= kMaxImageSide &&
                                    std::uint64_t(width) * std::uint64_t(height) <= kMaxImagePixels
                              : width == 0 && height == 0;
    if (!size_ok || !image_ok) return nullptr;
    auto map = std::make_shared<EnvironmentMap>();
    const std::size_t texel_count = AssignLevels(header.size, *map);
    const std::size_t image_floats = std::size_t(header.image_width) * std::size_t(header.image_height) * 4;
    const std::uint64_t float_bytes = std::uint64_t(texel_count + image_floats) * sizeof(float);
    if (file_size != sizeof(Header) + float_bytes) return nullptr;
    admit(float_bytes);

    Sha256 hash = BeginContent(header);
    std::uint64_t offset = sizeof(Header);
    std::atomic<bool> is_light = true;  // the digest shows damage but not forgery, as anybody can compute it
    const auto read = [&](PageVector<float>& floats, std::size_t count) {
      floats.resize(count);
      const auto bytes = std::as_writable_bytes(std::span(floats));
      AddInPieces(hash, bytes.size(), [&](std::size_t first, std::size_t size, Scratch&) {
        const auto piece = bytes.subspan(first, size);
        if (!file.Read(offset + first, piece)) std::ranges::fill(piece, std::byte{0});  // the digest will differ
        if (!IsLight(std::span(floats).subspan(first / sizeof(float), size / sizeof(float)))) is_light = false;
        return std::span<const std::byte>(piece);
      });
      offset += bytes.size();
    };
    read(map->texels, texel_count);
    read(map->image, image_floats);
    if (hash.Finish() != header.content || !is_light) return nullptr;
    map->texel_data = map->texels.data();
    if (options.keep_image) map->image_data = map->image.data();
    map->image_width = header.image_width;
    map->image_height = header.image_height;
    map->repaired_values = std::size_t(header.repaired_values);
    return map;
  }

  std::string Keep(const EnvironmentOptions& options, const EnvironmentMap& map) const override {
    Header header{.key = KeyOf(options)};
    header.size = map.levels[0].size;
    header.image_width = map.image_width;
    header.image_height = map.image_height;
    header.repaired_values = map.repaired_values;
    const auto texels = std::as_bytes(std::span(map.texels)), image = std::as_bytes(std::span(map.image));
    Sha256 hash = BeginContent(header);
    AddInPieces(hash, texels);
    AddInPieces(hash, image);
    header.content = hash.Finish();
    const std::string nothing_kept = "the prepared environment is not kept: ";
    std::error_code failure;
    std::filesystem::create_directories(folder_, failure);
    if (failure) return nothing_kept + folder_.string() + ": cannot be made: " + failure.message();
    try {
      // Other users may be able to write to the folder, so symbolic links in it are not followed.
      WriteFile(PathOf(header.key), {std::as_bytes(std::span(&header, 1)), texels, image}, OutputFile::Links::Refuse);
    } catch (const Error& error) {
      return nothing_kept + error.what();
    }
    return {};
  }

 private:
  Digest KeyOf(const EnvironmentOptions& options) const {
    // A structured binding, which does not compile if an option is added and forgotten here.
    const auto& [keep_image, max_size, samples, irradiance] = options;
    Sha256 hash;
    hash.Add(Version());
    hash.Add(kFormat);
    hash.Add(kEnvironmentArithmetic);
    hash.Add(std::as_bytes(std::span(digest_.bytes)));
    hash.Add(keep_image);
    hash.Add(max_size);
    hash.Add(samples);
    hash.Add(irradiance);
    return hash.Finish();
  }

  std::filesystem::path PathOf(const Digest& key) const { return folder_ / (ToHex(key) + ".environment"); }

  std::filesystem::path image_file_, folder_;
  Bytes bytes_;  // the file's content, if it cannot be read twice
  Digest digest_;
};

}  // namespace

std::shared_ptr<const EnvironmentSource> OpenEnvironment(const std::filesystem::path& image_file,
                                                         const std::filesystem::path& cache) {
  return std::make_shared<const CachedEnvironment>(image_file, cache);
}

}  // namespace facet
