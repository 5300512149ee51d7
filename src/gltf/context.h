// What every part of the loader is handed: the document, the bounds, and where to complain.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/bytes_text.h"
#include "facet/load.h"
#include "gltf/bytes.h"
#include "gltf/document.h"

namespace facet::gltf {

// True for what is no fault of the part of the file that is being read.
inline bool IsFatal(const Error& error) {
  return error.code() == ErrorCode::OutOfMemory || error.code() == ErrorCode::Internal;
}

struct Context {
  Context(std::filesystem::path file_path, std::string shown_name, const LoadOptions& load_options)
      : path(std::move(file_path)),
        file_name(std::move(shown_name)),
        options(load_options),
        place(file_name, &warnings) {}
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  // Calls `read`, which throws Error for what it cannot read. Where the picture shows that, the error stands; elsewhere
  // it becomes a warning of `consequence`, and the result is false. What is fatal stands everywhere.
  template <class Read>
  bool Try(bool shown, const Place& where, const char* consequence, const Read& read) {
    try {
      read();
      return true;
    } catch (const Error& error) {
      if (shown || IsFatal(error)) throw;
      where.Warn(consequence, error);
      return false;
    }
  }

  // Counts memory for geometry before it is taken. The bound is the options', and for what many primitives share or no
  // buffer holds, a multiple of the file's size: a few kilobytes must not unfold to gigabytes. Throws
  // Error(OutOfMemory).
  void Charge(std::size_t count, std::size_t size_each, const Place& where) {
    constexpr std::size_t kSmall = std::size_t(256) << 20, kUnfolding = 1024;
    const std::size_t unfolded = kSmall + report.file_bytes * kUnfolding;
    const std::size_t bound = unfolded < options.max_geometry_bytes ? unfolded : options.max_geometry_bytes;
    if (geometry_bytes > bound || (size_each != 0 && count > (bound - geometry_bytes) / size_each)) {
      Fail(where, "the geometry needs more memory than the limit of " + BytesText(double(bound)),
           bound == unfolded ? "so small a file should not unfold so far" : "raise the limit", ErrorCode::OutOfMemory);
    }
    geometry_bytes += count * size_each;
  }

  // Of a list at the root.
  const Json& Object(const char* list, std::size_t index) const { return document.root[list][index]; }
  bool IsRequired(const std::string& extension) const {
    for (const auto& use : report.extensions) {
      if (use.name == extension) return use.required;
    }
    return false;
  }
  bool IsUsed(const std::string& extension) const {
    for (const auto& use : report.extensions) {
      if (use.name == extension) return true;
    }
    return false;
  }

  std::filesystem::path path;
  std::string file_name;
  LoadOptions options;
  Warnings warnings;
  Place place;
  Document document;
  LoadReport report;
  std::vector<std::vector<std::size_t>> primitives_read;  // by mesh: which of the file's became its primitives
  std::size_t geometry_bytes = 0;
};

}  // namespace facet::gltf
