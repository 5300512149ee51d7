#include "studio.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "facet/image.h"
#include "light/studio.h"

namespace facet::assets {
namespace {

// Ward (1991), Real Pixels: a shared exponent. Mantissas are rounded to nearest: facet reads them as they stand, so
// that rounding down would darken the light by half a step.
void AppendRgbe(std::vector<std::uint8_t>* planes, const float* rgb) {
  const float largest = std::max(rgb[0], std::max(rgb[1], rgb[2]));
  int exponent = 0;
  if (largest < 1e-32f) {
    for (int c = 0; c < 4; ++c) planes[c].push_back(0);
    return;
  }
  std::frexp(largest, &exponent);
  for (int c = 0; c < 3; ++c)
    planes[c].push_back(std::uint8_t(std::min(255.0f, std::ldexp(rgb[c], 8 - exponent) + 0.5f)));
  planes[3].push_back(std::uint8_t(exponent + 128));
}

// The "new" run lengths: runs of at least four equal bytes, else literal bytes.
void AppendRunLengths(std::vector<std::uint8_t>& out, const std::vector<std::uint8_t>& line) {
  std::size_t i = 0;
  const auto run_at = [&](std::size_t start) {
    std::size_t end = start + 1;
    while (end < line.size() && end - start < 127 && line[end] == line[start]) ++end;
    return end - start;
  };
  while (i < line.size()) {
    std::size_t literal_end = i;
    while (literal_end < line.size() && literal_end - i < 128 && run_at(literal_end) < 4) ++literal_end;
    if (literal_end > i) {
      out.push_back(std::uint8_t(literal_end - i));
      out.insert(out.end(), line.begin() + std::ptrdiff_t(i), line.begin() + std::ptrdiff_t(literal_end));
      i = literal_end;
      continue;
    }
    const std::size_t run = run_at(i);
    out.push_back(std::uint8_t(128 + run));
    out.push_back(line[i]);
    i += run;
  }
}

}  // namespace

void WriteStudio(const std::filesystem::path& path) {
  const Image image = StudioImage(256, 128);
  const std::string header = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y " + std::to_string(image.height) + " +X " +
                             std::to_string(image.width) + "\n";
  std::vector<std::uint8_t> out(header.begin(), header.end());
  const float* pixel = image.As<float>();
  for (int y = 0; y < image.height; ++y) {
    std::vector<std::uint8_t> planes[4];
    for (int x = 0; x < image.width; ++x, pixel += image.channels) AppendRgbe(planes, pixel);
    out.insert(out.end(), {2, 2, std::uint8_t(image.width >> 8), std::uint8_t(image.width & 255)});
    for (const auto& plane : planes) AppendRunLengths(out, plane);
  }
  std::ofstream stream(path, std::ios::binary);
  stream.write(reinterpret_cast<const char*>(out.data()), std::streamsize(out.size()));
  stream.close();
  if (!stream) throw std::runtime_error("cannot write " + path.string());
}

}  // namespace facet::assets
