#include "png.h"

#include <array>
#include <cstdlib>
#include <string_view>

#include "deflate.h"

namespace facet::assets {
namespace {

std::uint32_t Crc32(const std::uint8_t* data, std::size_t size) {
  std::uint32_t crc = 0xFFFFFFFFu;
  for (std::size_t i = 0; i < size; ++i) {
    crc ^= data[i];
    for (int k = 0; k < 8; ++k) crc = (crc & 1u) != 0 ? 0xEDB88320u ^ (crc >> 1) : crc >> 1;
  }
  return ~crc;
}

void AppendBigEndian(std::vector<std::uint8_t>& out, std::uint32_t value) {
  for (int shift : {24, 16, 8, 0}) out.push_back(std::uint8_t(value >> shift));
}

void AppendChunk(std::vector<std::uint8_t>& out, std::string_view type, const std::vector<std::uint8_t>& data) {
  AppendBigEndian(out, std::uint32_t(data.size()));
  const std::size_t start = out.size();
  out.insert(out.end(), type.begin(), type.end());
  out.insert(out.end(), data.begin(), data.end());
  AppendBigEndian(out, Crc32(out.data() + start, out.size() - start));
}

int Paeth(int a, int b, int c) {
  const int p = a + b - c, pa = std::abs(p - a), pb = std::abs(p - b), pc = std::abs(p - c);
  return pa <= pb && pa <= pc ? a : pb <= pc ? b : c;
}

}  // namespace

std::vector<std::uint8_t> EncodePng(int width, int height, int channels, const std::vector<std::uint8_t>& pixels) {
  const std::size_t step = std::size_t(channels), stride = std::size_t(width) * step;
  std::vector<std::uint8_t> filtered;
  const std::vector<std::uint8_t> black(stride, 0);
  for (std::size_t y = 0; y < std::size_t(height); ++y) {
    const std::uint8_t* row = pixels.data() + y * stride;
    const std::uint8_t* above = y == 0 ? black.data() : row - stride;
    std::vector<std::uint8_t> best;
    long best_cost = -1;
    for (int filter = 0; filter < 5; ++filter) {  // the one with the least sum of absolute differences
      std::vector<std::uint8_t> line = {std::uint8_t(filter)};
      long cost = 0;
      for (std::size_t x = 0; x < stride; ++x) {
        const int a = x < step ? 0 : row[x - step], b = above[x], c = x < step ? 0 : above[x - step];
        const std::array<int, 5> prediction = {0, a, b, (a + b) / 2, Paeth(a, b, c)};
        const std::uint8_t value = std::uint8_t(row[x] - prediction[std::size_t(filter)]);
        cost += value < 128 ? value : 256 - value;
        line.push_back(value);
      }
      if (best_cost < 0 || cost < best_cost) best_cost = cost, best = line;
    }
    filtered.insert(filtered.end(), best.begin(), best.end());
  }
  std::vector<std::uint8_t> out = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
  std::vector<std::uint8_t> header;
  AppendBigEndian(header, std::uint32_t(width));
  AppendBigEndian(header, std::uint32_t(height));
  constexpr std::array<std::uint8_t, 5> kColorType = {0, 0, 4, 2, 6};
  header.insert(header.end(), {8, kColorType[step], 0, 0, 0});
  AppendChunk(out, "IHDR", header);
  AppendChunk(out, "IDAT", DeflateZlib(filtered));
  AppendChunk(out, "IEND", {});
  return out;
}

}  // namespace facet::assets
