#include "cli/output_path.h"

#include <array>
#include <string>

#include "base/printable.h"
#include "facet/error.h"

namespace facet::cli {
namespace {

constexpr std::array<OutputFormat, 11> kFormats = {{
    {.extension = ".png", .sixteen_bits = true},
    {.extension = ".exr", .linear = true},
    {.extension = ".hdr", .linear = true, .alpha = false},
    {.extension = ".tif", .sixteen_bits = true},
    {.extension = ".tiff", .sixteen_bits = true},
    {.extension = ".webp"},
    {.extension = ".jpg", .alpha = false},
    {.extension = ".jpeg", .alpha = false},
    {.extension = ".tga"},
    {.extension = ".bmp", .alpha = false},
    {.extension = ".ppm", .alpha = false, .sixteen_bits = false},
}};

}  // namespace

const OutputFormat& FormatOf(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  std::string list;
  for (const OutputFormat& format : kFormats) {
    if (format.extension == extension) return format;
    if (!list.empty()) list += ", ";
    list += format.extension;
  }
  throw Error(ErrorCode::InvalidUsage,
              extension.empty() ? "the name has no extension to tell the format by"
                                : "facet writes no " + Quoted(extension) + " files",
              Printable(path.string()), "use one of " + list);
}

}  // namespace facet::cli
