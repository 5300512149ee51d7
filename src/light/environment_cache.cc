// Prepared environments as files of a folder: OpenEnvironment() of facet/load.h.
//
// A file's name is the digest of all that decides over its bits, so that it never has to be changed; its own digest
// stands in it, so that one that was cut off or damaged is not taken for whole. It is a Header, then the texels of the
// map, then those of the picture where that is kept: floats as they lie in memory.
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
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
#include "base/parallel.h"
#include "base/sha256.h"
#include "facet/error.h"
#include "facet/load.h"
#include "facet/version.h"
#include "image/codec.h"
#include "light/environment_source.h"

namespace facet {
namespace {

constexpr std::uint32_t kFormat = 1;  // of the files

struct Header {
  std::array<char, 16> magic = {'f', 'a', 'c', 'e', 't', ' ', 'l', 'i', 'g', 'h', 't', ' ', 'm', 'a', 'p', '\n'};
  std::uint32_t byte_order = 0x01020304;
  std::uint32_t format = kFormat;
  Digest key{};
  std::int32_t size = 0;  // texels along the sharpest level
  std::int32_t picture_width = 0, picture_height = 0;
  std::int32_t zero = 0;
  std::uint64_t repaired_values = 0;
  Digest content{};  // of the other fields and the floats
};
static_assert(sizeof(Header) == 112 && std::has_unique_object_representations_v<Header>, "no padding");

// The digests of pieces are digested: they can be made, and a file be read, on all threads. visit(first, bytes) is
// called for each piece, before it is digested.
template <class Visit>
void AddInPieces(Sha256& hash, std::span<const std::byte> bytes, const Visit& visit) {
  constexpr std::size_t kPiece = std::size_t{128} << 10;
  std::vector<Digest> pieces((bytes.size() + kPiece - 1) / kPiece);
  ParallelFor(pieces.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto piece = bytes.subspan(i * kPiece, std::min(kPiece, bytes.size() - i * kPiece));
      visit(i * kPiece, piece.size());
      Sha256 of_piece;
      of_piece.Add(piece);
      pieces[i] = of_piece.Finish();
    }
  });
  hash.Add(std::uint64_t(bytes.size()));
  hash.AddArray(pieces);
}

constexpr auto kAsItIs = [](std::size_t, std::size_t) {};

Sha256 BeginContent(Header header) {
  header.content = {};
  Sha256 hash;
  hash.Add(std::as_bytes(std::span(&header, 1)));
  return hash;
}

class OpenFile {
 public:
  // Not blocking: a pipe of that name is no entry, and nobody may ever write to it.
  explicit OpenFile(const std::filesystem::path& path)
      : descriptor_(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)) {}
  ~OpenFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;

  // None for what is no plain file.
  std::uint64_t Size() const {
    struct stat status {};
    const bool plain = descriptor_ >= 0 && ::fstat(descriptor_, &status) == 0 && S_ISREG(status.st_mode);
    return plain ? std::uint64_t(status.st_size) : 0;
  }

  // What cannot be read is left as it is: the digest finds it.
  void Read(std::uint64_t offset, std::span<std::byte> to) const {
    while (!to.empty()) {
      const ssize_t count = ::pread(descriptor_, to.data(), to.size(), static_cast<off_t>(offset));
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0) return;
      offset += static_cast<std::uint64_t>(count);
      to = to.subspan(static_cast<std::size_t>(count));
    }
  }

 private:
  int descriptor_;
};

class CachedEnvironment final : public EnvironmentSource {
 public:
  CachedEnvironment(const std::filesystem::path& picture, std::filesystem::path folder)
      : name_(picture.string()), folder_(std::move(folder)), bytes_(ReadFileWhole(picture)) {
    Sha256 hash;
    AddInPieces(hash, bytes_, kAsItIs);
    digest_ = hash.Finish();
  }

  std::shared_ptr<const Image> Picture() const override {
    const FloatEnvironment pinned;
    return std::make_shared<const Image>(DecodeImage(bytes_, name_));
  }

  std::shared_ptr<const EnvironmentMap> Find(const EnvironmentOptions& options,
                                             const std::function<void(std::uint64_t)>& admit) const override {
    const Digest key = KeyOf(options);
    const OpenFile file(PathOf(key));
    const std::uint64_t file_size = file.Size();
    if (file_size < sizeof(Header)) return nullptr;
    const Header expected{.key = key};
    Header header;
    file.Read(0, std::as_writable_bytes(std::span(&header, 1)));
    if (header.magic != expected.magic || header.byte_order != expected.byte_order || header.format != kFormat ||
        header.key != key) {
      return nullptr;
    }
    // Sizes are bounded before they are trusted: the digest can be checked only when all is in memory.
    const auto side_ok = [](std::int32_t side) { return side >= 1 && side <= kMaxImageSide; };
    const bool size_ok =
        header.size >= 1 && header.size <= options.max_size && std::has_single_bit(unsigned(header.size));
    const bool picture_ok = options.keep_picture ? side_ok(header.picture_width) && side_ok(header.picture_height)
                                                 : header.picture_width == 0 && header.picture_height == 0;
    if (!size_ok || !picture_ok) return nullptr;
    auto map = std::make_shared<EnvironmentMap>();
    const std::size_t texel_count = PlaceLevels(header.size, *map);
    const std::size_t picture_count = std::size_t(header.picture_width) * std::size_t(header.picture_height) * 4;
    const std::uint64_t float_bytes = std::uint64_t(texel_count + picture_count) * sizeof(float);
    if (file_size != sizeof(Header) + float_bytes) return nullptr;
    admit(float_bytes);

    Sha256 hash = BeginContent(header);
    std::uint64_t offset = sizeof(Header);
    const auto read = [&](PageVector<float>& floats, std::size_t count) {
      floats.resize(count);
      const auto bytes = std::as_writable_bytes(std::span(floats));
      AddInPieces(hash, bytes,
                  [&](std::size_t first, std::size_t size) { file.Read(offset + first, bytes.subspan(first, size)); });
      offset += bytes.size();
    };
    read(map->texels, texel_count);
    read(map->picture, picture_count);
    if (hash.Finish() != header.content) return nullptr;
    map->texel_data = map->texels.data();
    if (options.keep_picture) map->picture_data = map->picture.data();
    map->picture_width = header.picture_width;
    map->picture_height = header.picture_height;
    map->repaired_values = std::size_t(header.repaired_values);
    return map;
  }

  std::string Keep(const EnvironmentOptions& options, const EnvironmentMap& map) const override {
    Header header{.key = KeyOf(options)};
    header.size = map.levels[0].size;
    header.picture_width = map.picture_width;
    header.picture_height = map.picture_height;
    header.repaired_values = map.repaired_values;
    const auto texels = std::as_bytes(std::span(map.texels)), picture = std::as_bytes(std::span(map.picture));
    Sha256 hash = BeginContent(header);
    AddInPieces(hash, texels, kAsItIs);
    AddInPieces(hash, picture, kAsItIs);
    header.content = hash.Finish();
    const std::string nothing_kept = "the prepared environment is not kept: ";
    std::error_code failure;
    std::filesystem::create_directories(folder_, failure);
    if (failure) return nothing_kept + folder_.string() + ": cannot be made: " + failure.message();
    try {
      WriteFileWhole(PathOf(header.key), {std::as_bytes(std::span(&header, 1)), texels, picture});
    } catch (const Error& error) {
      return nothing_kept + error.what();
    }
    return {};
  }

 private:
  Digest KeyOf(const EnvironmentOptions& options) const {
    // By name, so that a further option is not forgotten here: it would not compile.
    const auto& [keep_picture, max_size, samples, irradiance] = options;
    Sha256 hash;
    hash.Add(Version());
    hash.Add(kFormat);
    hash.Add(kEnvironmentArithmetic);
    hash.Add(std::as_bytes(std::span(digest_.bytes)));
    hash.Add(keep_picture);
    hash.Add(max_size);
    hash.Add(samples);
    hash.Add(irradiance);
    return hash.Finish();
  }

  std::filesystem::path PathOf(const Digest& key) const { return folder_ / (ToHex(key) + ".environment"); }

  std::string name_;
  std::filesystem::path folder_;
  std::vector<std::byte> bytes_;
  Digest digest_;
};

}  // namespace

std::shared_ptr<const EnvironmentSource> OpenEnvironment(const std::filesystem::path& picture,
                                                         const std::filesystem::path& cache) {
  return std::make_shared<const CachedEnvironment>(picture, cache);
}

}  // namespace facet
