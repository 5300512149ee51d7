#include "gltf/container.h"

#include <cstdint>

#include "gltf/place.h"

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

std::string_view AsText(const Bytes& bytes) { return {reinterpret_cast<const char*>(bytes.data), bytes.size}; }

}  // namespace

Container OpenContainer(const Bytes& file, const std::string& file_name, std::vector<std::string>& warnings) {
  const Place place(file_name);
  if (file.size == 0) Fail(place, "the file is empty");
  if (file.size < 4 || ReadU32(file.data) != kMagic) return {AsText(file), std::nullopt};

  if (file.size < kHeaderSize + kChunkHeaderSize) Fail(place, "GLB header is cut short", "fetch the file again");
  const std::uint32_t version = ReadU32(file.data + 4);
  if (version != 2) {
    Fail(place, "GLB container version " + std::to_string(version) + " is not supported", "convert it to glTF 2.0",
         ErrorCode::Unsupported);
  }
  const std::size_t declared = ReadU32(file.data + 8);
  if (declared > file.size) {
    Fail(place,
         "GLB is cut short: it declares " + std::to_string(declared) + " bytes and has " + std::to_string(file.size),
         "fetch the file again");
  }
  if (declared < file.size) warnings.push_back("GLB header: ignored: bytes after the declared length");

  Container container;
  bool first = true;
  for (std::size_t at = kHeaderSize; at < declared; first = false) {
    if (declared - at < kChunkHeaderSize) Fail(place, "GLB chunk header is cut short at byte " + std::to_string(at));
    const std::size_t length = ReadU32(file.data + at);
    const std::uint32_t type = ReadU32(file.data + at + 4);
    at += kChunkHeaderSize;
    if (length > declared - at) {
      Fail(place, "GLB chunk at byte " + std::to_string(at - kChunkHeaderSize) + " is longer than the file");
    }
    if (first && type != kJsonChunk) Fail(place, "the first GLB chunk is not JSON");
    if (first) {
      container.json = AsText(file.Slice(at, length));
    } else if (type == kBinChunk && !container.bin) {
      container.bin = file.Slice(at, length);
    } else if (type == kBinChunk || type == kJsonChunk) {
      warnings.push_back("GLB chunks: ignored: a second JSON or BIN chunk");
    }  // chunks of other types are for extensions, and skipped as the specification says
    at += length;
  }
  if (first) Fail(place, "GLB has no JSON chunk");
  return container;
}

}  // namespace facet::gltf
