#include "cli/output_path.h"

#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <string>
#include <system_error>

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
    {.extension = ".webp", .alpha = false},  // OpenImageIO writes it without
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

bool IsPlainFile(const std::filesystem::path& path) {
  std::error_code ignored;
  const std::filesystem::file_status status = std::filesystem::status(path, ignored);
  return std::filesystem::is_regular_file(status) || !std::filesystem::exists(status);
}

void CheckWritable(const std::filesystem::path& path) {
  const std::string name = Printable(path.string());
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) {
    throw Error(ErrorCode::OutputFailed, "is a folder", name, "give the name of a file");
  }
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
  if (!std::filesystem::is_directory(folder, ignored)) {
    throw Error(ErrorCode::OutputFailed, "the folder " + Quoted(folder.string()) + " does not exist", name,
                "create it first");
  }
  // Files are written beside their place and renamed into it, so it is the folder that has to be writable.
  if (access(folder.c_str(), W_OK | X_OK) != 0) {
    throw Error(ErrorCode::OutputFailed,
                "the folder " + Quoted(folder.string()) + " cannot be written: " + std::strerror(errno), name);
  }
}

}  // namespace facet::cli
