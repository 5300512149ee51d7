// Small files for every decoder that facet has, made by the libraries' own encoders: what prove.py renders on one
// processor after another. Each function fills a folder; the names say which decoder is at work.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace facet::decoder_files {

using Folder = std::filesystem::path;
template <class T, std::size_t N>
using Values = std::vector<std::array<T, N>>;

// Attributes of every kind, by Draco: each way to code connectivity, and predictions; quantised and not.
void WriteDraco(const Folder& folder);
// Each mode and each filter of EXT_meshopt_compression.
void WriteMeshopt(const Folder& folder);
// Every subsampling and colour space of JPEG, baseline and progressive, from each transform.
void WriteJpeg(const Folder& folder);
// Every colour type and depth of PNG, interlaced and not.
void WritePng(const Folder& folder);
// A Radiance environment: run lengths and single pixels.
void WriteRadiance(const Folder& folder);
// WebP, and environments in OpenEXR and TIFF with each compression, by OpenImageIO.
void WriteByOpenImageIo(const Folder& folder);

// A picture with smooth parts, sharp edges, saturated colours and noise: rounding and clamping are at work everywhere.
// Channels 0 to 3 are red, green, blue, alpha; values in [0, 1].
float PatternAt(int x, int y, int channel);
constexpr int kPatternWidth = 61, kPatternHeight = 43;  // odd, so that no block is whole at the edges

// Values of PatternAt row by row, as whole numbers from 0 to `most`.
template <class Integer>
std::vector<Integer> Pattern(int channels, unsigned most) {
  std::vector<Integer> values;
  for (int y = 0; y < kPatternHeight; ++y) {
    for (int x = 0; x < kPatternWidth; ++x) {
      for (int c = 0; c < channels; ++c) {
        values.push_back(static_cast<Integer>(PatternAt(x, y, c) * static_cast<float>(most) + 0.5f));
      }
    }
  }
  return values;
}

void WriteWhole(const std::filesystem::path& path, const std::string& bytes);

}  // namespace facet::decoder_files
