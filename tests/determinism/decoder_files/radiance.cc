#include <algorithm>
#include <array>
#include <cmath>

#include "decoder_files.h"

namespace facet::decoder_files {
namespace {

constexpr int kWidth = 64, kHeight = 32;

std::array<std::uint8_t, 4> PixelAt(int x, int y) {
  std::array<float, 3> color;
  for (int c = 0; c < 3; ++c) {
    // A flat part for runs to be long, and a sun.
    color[static_cast<std::size_t>(c)] =
        x < kWidth / 3 ? 0.25f : PatternAt(x, y, c) * (x == 40 && y == 9 ? 900.0f : 1.7f);
  }
  int exponent = 0;
  std::frexp(std::max({color[0], color[1], color[2]}), &exponent);
  std::array<std::uint8_t, 4> pixel{0, 0, 0, static_cast<std::uint8_t>(exponent + 128)};
  for (std::size_t c = 0; c < 3; ++c) pixel[c] = static_cast<std::uint8_t>(std::ldexp(color[c], 8 - exponent));
  return pixel;
}

// Runs of at least four equal bytes; what lies between is as it is.
void AppendPlane(std::string& out, const std::string& plane) {
  for (std::size_t x = 0; x < plane.size();) {
    const auto run = [&](std::size_t from) {
      std::size_t end = from;
      while (end < plane.size() && end - from < 127 && plane[end] == plane[from]) ++end;
      return end - from;
    };
    if (const std::size_t length = run(x); length >= 4) {
      out += static_cast<char>(128 + length);
      out += plane[x];
      x += length;
    } else {
      std::size_t end = x;
      while (end < plane.size() && end - x < 128 && run(end) < 4) ++end;
      out += static_cast<char>(end - x);
      out += plane.substr(x, end - x);
      x = end;
    }
  }
}

}  // namespace

void WriteRadiance(const Folder& folder) {
  const std::string header = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 32 +X 64\n";
  std::string flat = header, packed = header;
  for (int y = 0; y < kHeight; ++y) {
    packed += {2, 2, 0, kWidth};
    std::array<std::string, 4> planes;
    for (int x = 0; x < kWidth; ++x) {
      for (std::size_t c = 0; c < 4; ++c) {
        planes[c] += static_cast<char>(PixelAt(x, y)[c]);
        flat += planes[c].back();
      }
    }
    for (const std::string& plane : planes) AppendPlane(packed, plane);
  }
  WriteWhole(folder / "radiance-flat.hdr", flat);
  WriteWhole(folder / "radiance-runs.hdr", packed);
}

}  // namespace facet::decoder_files
