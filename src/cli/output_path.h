// What can be said about an output file before anything is drawn: nobody waits ten seconds for "no such folder".
#pragma once

#include <filesystem>
#include <string_view>

namespace facet::cli {

// A kind of picture file.
struct OutputFormat {
  std::string_view extension;  // lower case, with its dot
  bool linear = false;         // 32-bit float or the like: linear light, never tone-mapped
  bool alpha = true;           // has a place for transparency
  bool sixteen_bits = false;   // takes 16 bits a channel
};

// The format that the extension of `path` names (letter case ignored). Throws Error(InvalidUsage).
const OutputFormat& FormatOf(const std::filesystem::path& path);

}  // namespace facet::cli
