#include "gltf/container.h"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <string>

#include "base/json_bounds.h"
#include "gltf/recognize.h"

namespace facet::gltf {
namespace {

constexpr std::uint32_t kMagic = 0x46546C67;      // "glTF"
constexpr std::uint32_t kJsonChunk = 0x4E4F534A;  // "JSON"
constexpr std::uint32_t kBinChunk = 0x004E4942;   // "BIN\0"
constexpr std::size_t kHeaderSize = 12, kChunkHeaderSize = 8;

std::uint32_t ReadU32(const std::byte* p) {
  return std::to_integer<std::uint32_t>(p[0]) | std::to_integer<std::uint32_t>(p[1]) << 8 |
         std::to_integer<std::uint32_t>(p[2]) << 16 | std::to_integer<std::uint32_t>(p[3]) << 24;
}

// "1 byte", "7 bytes".
std::string Count(std::size_t bytes) { return std::to_string(bytes) + (bytes == 1 ? " byte" : " bytes"); }

bool BeginsAsJson(std::string_view text) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.front()))) text.remove_prefix(1);
  return text.starts_with('{');
}

// The position after the bracket that closes the JSON object at the start of `text`; nothing if there is none.
std::optional<std::size_t> EndOfJson(std::string_view text) {
  std::int64_t depth = 0;
  std::optional<std::size_t> end;
  ForEachJsonByte(text, [&](std::size_t i) {
    if (text[i] == '[' || text[i] == '{') ++depth;
    if ((text[i] == ']' || text[i] == '}') && --depth == 0) end = i + 1;
    return !end;
  });
  return end;
}

// Whether a word can be the type of a chunk: letters, which zeros may follow.
bool IsName(std::uint32_t type) {
  bool at_end = false, valid = true;
  for (int i = 0; i < 4; ++i, type >>= 8) {
    const std::uint32_t c = type & 0xFF;
    valid = valid && (c == 0 ? i > 0 : !at_end && c > 0x20 && c < 0x7F);
    at_end = at_end || c == 0;
  }
  return valid;
}

// Whether text ends, apart from padding, with the bracket that closes an object.
bool EndsAsJson(std::string_view text) {
  const std::size_t last = text.find_last_not_of(std::string_view(" \t\r\n\0", 5));
  return last != std::string_view::npos && text[last] == '}';
}

class GlbReader {
 public:
  GlbReader(const Bytes& file, const Place& place) : file_(file), place_(place) {}

  Container Read() {
    ReadHeader();
    std::size_t at = kHeaderSize + kChunkHeaderSize;
    const std::size_t json_size = JsonSize(file_.Slice(at, file_.size - at).Text());
    container_.json = file_.Slice(at, json_size).Text();
    at += json_size;
    while (file_.size - at >= kChunkHeaderSize && ReadChunk(at)) {
    }
    ReadTail(at);
    return container_;
  }

 private:
  void Warn(const std::string& what) const { Place(place_, "GLB").Warn(what); }

  void ReadHeader() {
    if (file_.size < kHeaderSize + kChunkHeaderSize) {
      Fail(place_, "the GLB ends after " + Count(file_.size) + ", within its headers", "fetch the file again");
    }
    const std::uint32_t version = ReadU32(file_.data + 4);
    if (version != 2) {
      Fail(place_, "GLB container version " + std::to_string(version) + " is not supported", "convert it to glTF 2.0",
           ErrorCode::Unsupported);
    }
    declared_ = ReadU32(file_.data + 8);
    if (ReadU32(file_.data + kHeaderSize + 4) != kJsonChunk) Fail(place_, "the first GLB chunk is not JSON");
  }

  static bool IsBin(std::string_view text, std::size_t at) {
    return text.substr(std::min(at + 4, text.size()), 4) == kBin;
  }

  // The size of the JSON chunk at the start of `rest`: as its header says, if that is possible, otherwise up to the end
  // of the JSON text. Warns if these differ.
  std::size_t JsonSize(std::string_view rest) {
    const std::size_t length = ReadU32(file_.data + kHeaderSize);
    is_cut_ = length > rest.size();
    const bool is_likely =
        length <= rest.size() && EndsAsJson(rest.substr(0, length)) && (length == rest.size() || IsBin(rest, length));
    if (is_likely) return length;
    const std::optional<std::size_t> end = EndOfJson(rest);
    if (!end && length <= rest.size()) return length;  // the parser will report the error
    if (!end) {
      Fail(place_, "the JSON chunk's length is " + Count(length) + ", and the file ends after " + Count(rest.size()),
           "fetch the file again");
    }
    std::size_t size = std::clamp(length, *end, rest.size());
    constexpr std::size_t kMostPadding = 7;  // at most 3 bytes in a valid file
    for (std::size_t padding = 0; padding <= kMostPadding; ++padding) {
      if (!IsBin(rest, *end + padding)) continue;
      size = *end + padding;
      break;
    }
    if (size != length) Warn("the JSON chunk's length is " + Count(length) + ", and it has " + std::to_string(size));
    return size;
  }

  // Whether a sequence of chunks of any types reaches from there exactly to the end that the header states.
  bool AreChunks(std::size_t at) const {
    const std::size_t end = std::min<std::size_t>(declared_, file_.size);
    while (at + kChunkHeaderSize <= end && ReadU32(file_.data + at + 4) != 0) {
      at += kChunkHeaderSize + ReadU32(file_.data + at);
    }
    return at == declared_;
  }

  // Moves `at` to the end of the chunk that begins there; false if there is no chunk.
  bool ReadChunk(std::size_t& at) {
    const std::size_t length = ReadU32(file_.data + at), left = file_.size - at - kChunkHeaderSize;
    const std::uint32_t type = ReadU32(file_.data + at + 4);
    const bool is_bin = type == kBinChunk && !container_.bin;
    // Beyond the end that the header states, only missing chunks are searched.
    if (!is_bin && (at >= declared_ || length > left || !(IsName(type) || AreChunks(at)))) return false;
    const std::size_t size = std::min(length, left);
    if (is_bin) {
      if (length > left) Warn("the BIN chunk's length is " + Count(length) + ", and it has " + std::to_string(left));
      bin_at_ = at + kChunkHeaderSize;
      container_.bin = file_.Slice(bin_at_, size);
    } else if (type == kBinChunk || type == kJsonChunk) {
      Warn("ignored: a second JSON or BIN chunk");
    }  // chunks of other types belong to extensions, and the specification says to skip them
    at += kChunkHeaderSize + size;
    bin_end_ = is_bin ? at : bin_end_;
    return true;
  }

  void ReadTail(std::size_t end) {
    const std::size_t rest = file_.size - end;
    if (rest > 0) Warn(Count(rest) + " after the last chunk");
    if (declared_ != end + (declared_ == file_.size ? rest : 0)) {
      Warn("the header's length is " + Count(declared_) + ", and the file has " + std::to_string(file_.size));
    }
    // Bytes after the BIN chunk belong to it if a buffer needs them, since the chunk's length may be wrong.
    if (rest > 0 && bin_end_ == end) container_.bin = file_.Slice(bin_at_, file_.size - bin_at_);
    is_cut_ = is_cut_ || declared_ > file_.size || rest > 0;
    if (is_cut_ && !container_.bin) container_.bin = file_.Slice(file_.size, 0);
  }

  static constexpr std::string_view kBin{"BIN\0", 4};

  const Bytes& file_;
  const Place& place_;
  Container container_;
  std::size_t declared_ = 0;
  std::size_t bin_at_ = 0, bin_end_ = 0;  // 0: no BIN chunk
  bool is_cut_ = false;                   // the BIN chunk may be missing because the file ends too early
};

}  // namespace

Container OpenContainer(const Bytes& file, const Place& place) {
  if (file.size == 0) Fail(place, "the file is empty");
  if (file.size >= 4 && ReadU32(file.data) == kMagic) return GlbReader(file, place).Read();
  const std::string_view text = file.Text();
  if (const auto foreign = RecognizeForeign(text)) Fail(place, "not a glTF file, but " + foreign->what, foreign->hint);
  if (!BeginsAsJson(text)) Fail(place, "not a glTF file: neither JSON nor GLB", "is it the right one?");
  return {text, std::nullopt};
}

}  // namespace facet::gltf
