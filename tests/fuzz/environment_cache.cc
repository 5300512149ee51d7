// Files of prepared environments. An input changes a file that facet wrote: its first byte says what is put right again
// afterwards, the next are XORed into the header, and the rest is what the floats are, again and again.
#include <cmath>
#include <cstring>
#include <fstream>
#include <functional>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include "base/sha256.h"
#include "facet/load.h"
#include "facet/render.h"
#include "fuzz/fuzz.h"
#include "light/environment_source.h"

namespace facet::fuzz {
namespace {

// Where the picture's sides, the digest of the content and the floats stand.
constexpr std::size_t kSides = 60, kContent = 80, kHeader = 112;
constexpr std::size_t kPiece = std::size_t{64} << 10;

// As src/light/environment_cache.cc makes it, once for the texels and once for the picture.
Digest ContentOf(const std::string& file, std::size_t texels) {
  std::string header = file.substr(0, kHeader);
  std::fill(header.begin() + kContent, header.end(), '\0');
  Sha256 hash;
  hash.Add(header);
  for (const std::string& floats : {file.substr(kHeader, texels), file.substr(kHeader + texels)}) {
    std::vector<Digest> pieces;
    for (std::size_t at = 0; at < floats.size(); at += kPiece) {
      Sha256 of_piece;
      of_piece.Add(std::string_view(floats).substr(at, kPiece));
      pieces.push_back(of_piece.Finish());
    }
    hash.Add(std::uint64_t(floats.size()));
    hash.AddArray(pieces);
  }
  return hash.Finish();
}

// Of the file alone: where that is refused, so is the frame.
class OnlyKept final : public EnvironmentSource {
 public:
  explicit OnlyKept(std::shared_ptr<const EnvironmentSource> source) : source_(std::move(source)) {}
  std::shared_ptr<const Image> Decode() const override { throw Error(ErrorCode::InvalidInput, "is not kept"); }
  std::shared_ptr<const EnvironmentMap> Find(const EnvironmentOptions& options,
                                             const std::function<void(std::uint64_t)>& admit) const override {
    return source_->Find(options, admit);
  }
  std::string Keep(const EnvironmentOptions&, const EnvironmentMap&) const override { return {}; }

 private:
  std::shared_ptr<const EnvironmentSource> source_;
};

Scene Triangle() {
  Scene scene;
  scene.meshes.push_back(
      {.name = {}, .primitives = {{.positions = {{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}}}}, .weights = {}});
  scene.nodes.push_back({.mesh = 0});
  return scene;
}

class Cache {
 public:
  Cache() {
    std::string sky = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 8 +X 16\n";
    for (int i = 0; i < 16 * 8; ++i) sky += {char(10 + i % 50), char(20 + i % 30), char(60), char(0x81)};
    const auto source = OpenEnvironment(folder_.Write("sky.hdr", sky), folder_ / "cache");
    settings_.width = settings_.height = 8;
    settings_.samples = 1;
    settings_.threads = 1;
    settings_.environment_size = 64;
    settings_.environment_samples = 6;
    settings_.background = Background::Environment;
    settings_.memory_limit = kMemoryLimit;
    settings_.environment.kind = EnvironmentSettings::Kind::Image;
    settings_.environment.source = source;
    Render(scene_, settings_);
    settings_.environment.source = std::make_shared<OnlyKept>(source);
    for (const auto& entry : std::filesystem::directory_iterator(folder_ / "cache")) path_ = entry.path();
    std::ifstream stream(path_, std::ios::binary);
    file_.assign(std::istreambuf_iterator<char>(stream), {});
    std::int32_t sides[2];
    std::memcpy(sides, file_.data() + kSides, sizeof sides);
    texels_ = file_.size() - kHeader - std::size_t(sides[0]) * std::size_t(sides[1]) * 4 * sizeof(float);
    Check(Draws(file_) && ContentOf(file_, texels_) == ContentIn(file_), "what was kept is not found");
  }

  // An input's file.
  std::string Changed(std::span<const std::byte> input) const {
    std::string file = file_;
    const std::string_view bytes = AsText(input);
    if (bytes.empty()) return file;
    const int flags = bytes[0];
    const std::string_view header = bytes.substr(1, kHeader), floats = bytes.substr(1 + header.size());
    for (std::size_t i = 0; i < header.size(); ++i) file[i] = static_cast<char>(file[i] ^ header[i]);
    for (std::size_t i = kHeader; i < file.size() && !floats.empty(); ++i) file[i] = floats[i % floats.size()];
    if ((flags & 1) != 0) file.replace(0, 56, file_, 0, 56);  // magic numbers, version and key
    if ((flags & 2) != 0) file.resize(file.size() / 2);
    if ((flags & 4) != 0) file += std::string(16, '\0');
    if ((flags & 8) == 0 && file.size() > kHeader + texels_) {
      const Digest content = ContentOf(file, texels_);
      std::memcpy(file.data() + kContent, content.bytes.data(), content.bytes.size());
    }
    return file;
  }

  // False where the file is refused.
  bool Draws(const std::string& file) const {
    folder_.Write((std::filesystem::path("cache") / path_.filename()).string(), file);
    Film film;
    if (Try([&] { film = Render(scene_, settings_); }) != Outcome::Done) return false;
    for (const glm::vec4& pixel : film.pixels) {
      for (int c = 0; c < 4; ++c) Check(std::isfinite(pixel[c]), "a pixel is not finite");
    }
    return true;
  }

 private:
  static Digest ContentIn(const std::string& file) {
    Digest digest;
    std::memcpy(digest.bytes.data(), file.data() + kContent, digest.bytes.size());
    return digest;
  }

  ScratchFolder folder_;
  Scene scene_ = Triangle();
  RenderSettings settings_;
  std::filesystem::path path_;
  std::string file_;
  std::size_t texels_ = 0;  // bytes
};

}  // namespace

void Run(std::span<const std::byte> input) {
  static const Cache cache;
  cache.Draws(cache.Changed(input));
}

}  // namespace facet::fuzz
