// Changes a PNG file chunk by chunk and writes its checksums anew, so that decoders look at what was changed. Linked
// into fuzzers whose inputs are PNG files.
#include <libdeflate.h>

#include <cstring>
#include <optional>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "fuzz/fuzz.h"

namespace facet::fuzz {
namespace {

constexpr std::string_view kSignature = "\x89PNG\r\n\x1a\n";

struct Chunk {
  std::string type;  // 4 bytes
  std::string data;
};

std::uint32_t BigAt(std::string_view bytes, std::size_t at) {
  std::uint32_t word = 0;
  for (std::size_t i = 0; i < 4; ++i) word = word << 8 | static_cast<unsigned char>(bytes[at + i]);
  return word;
}

std::string Big(std::uint32_t word) {
  return {char(word >> 24 & 255), char(word >> 16 & 255), char(word >> 8 & 255), char(word & 255)};
}

std::optional<std::vector<Chunk>> Parse(std::string_view bytes) {
  if (!bytes.starts_with(kSignature)) return std::nullopt;
  std::vector<Chunk> chunks;
  std::size_t at = kSignature.size();
  while (bytes.size() - at >= 12) {
    const std::size_t size = std::min<std::size_t>(BigAt(bytes, at), bytes.size() - at - 12);
    chunks.push_back({std::string(bytes.substr(at + 4, 4)), std::string(bytes.substr(at + 8, size))});
    at += 12 + size;
  }
  if (chunks.empty()) return std::nullopt;
  return chunks;
}

std::string Dump(const std::vector<Chunk>& chunks) {
  std::string bytes(kSignature);
  for (const Chunk& chunk : chunks) {
    const std::string summed = chunk.type + chunk.data;
    bytes += Big(static_cast<std::uint32_t>(chunk.data.size())) + summed +
             Big(libdeflate_crc32(0, summed.data(), summed.size()));
  }
  return bytes;
}

void Mutate(std::string& data, std::size_t more) {
  if (data.size() + more == 0) return;
  std::vector<std::uint8_t> bytes(data.size() + more);
  std::memcpy(bytes.data(), data.data(), data.size());
  const std::size_t size = LLVMFuzzerMutate(bytes.data(), data.size(), bytes.size());
  data.assign(reinterpret_cast<const char*>(bytes.data()), size);
}

// What is compressed is changed, and compressed again.
void MutateCompressed(std::string& data) {
  std::string plain(std::size_t{1} << 16, '\0');
  std::size_t size = 0;
  libdeflate_decompressor* const reader = libdeflate_alloc_decompressor();
  const libdeflate_result result =
      libdeflate_zlib_decompress(reader, data.data(), data.size(), plain.data(), plain.size(), &size);
  libdeflate_free_decompressor(reader);
  if (result != LIBDEFLATE_SUCCESS) return Mutate(data, 32);
  plain.resize(size);
  Mutate(plain, 32);
  libdeflate_compressor* const writer = libdeflate_alloc_compressor(1);
  data.resize(libdeflate_zlib_compress_bound(writer, plain.size()));
  data.resize(libdeflate_zlib_compress(writer, plain.data(), plain.size(), data.data(), data.size()));
  libdeflate_free_compressor(writer);
}

}  // namespace
}  // namespace facet::fuzz

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                               unsigned seed) {
  using namespace facet::fuzz;
  std::minstd_rand random(seed);
  const auto below = [&random](std::size_t count) { return static_cast<std::size_t>(random()) % count; };
  auto chunks = Parse({reinterpret_cast<const char*>(data), size});
  if (!chunks || below(16) == 0) return LLVMFuzzerMutate(data, size, max_size);
  const std::size_t at = below(chunks->size());
  const auto place = chunks->begin() + static_cast<std::ptrdiff_t>(at);
  Chunk& chunk = *place;
  switch (below(10)) {
    case 0: chunks->insert(chunks->begin() + static_cast<std::ptrdiff_t>(below(chunks->size())), Chunk(chunk)); break;
    case 1: chunks->erase(place); break;
    case 2: std::swap(chunk, (*chunks)[below(chunks->size())]); break;
    case 3: {
      static const std::vector<std::string> types = {"IHDR", "PLTE", "IDAT", "IEND", "tRNS", "gAMA", "cHRM",
                                                     "sRGB", "iCCP", "tEXt", "zTXt", "iTXt", "bKGD", "acTL"};
      chunk.type = types[below(types.size())];
      break;
    }
    case 4:
    case 5:
    case 6:
      if (chunk.type == "IDAT") {
        MutateCompressed(chunk.data);
        break;
      }
      [[fallthrough]];
    default: Mutate(chunk.data, chunk.type == "IHDR" ? 0 : 64);
  }
  const std::string bytes = Dump(*chunks);
  if (bytes.size() > max_size) return LLVMFuzzerMutate(data, size, max_size);
  std::memcpy(data, bytes.data(), bytes.size());
  return bytes.size();
}
