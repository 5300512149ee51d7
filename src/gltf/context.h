// The context that all parts of the loader share: the document, its memory budget, and the warnings.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "facet/load.h"
#include "gltf/document.h"
#include "gltf/files.h"

namespace facet::gltf {

// Whether an error is not caused by the part of the file that is being read.
inline bool IsFatal(const Error& error) {
  return error.code() == ErrorCode::OutOfMemory || error.code() == ErrorCode::Internal;
}

struct Context {
  Context(std::filesystem::path file_path, std::string shown_name, const LoadOptions& load_options)
      : path(std::move(file_path)),
        file_name(std::move(shown_name)),
        options(load_options),
        place(file_name, &warnings),
        files(path, options, report) {}
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  // Calls `read`, which throws Error for what it cannot read. If the part is visible (`shown`) or the error is fatal,
  // the error is passed on. Otherwise it becomes a warning of `consequence`, the memory that `read` charged is
  // released, and the result is false.
  template <class Read>
  bool Try(bool shown, const Place& where, const char* consequence, const Read& read) {
    const std::size_t charged = charged_;
    try {
      read();
      return true;
    } catch (const Error& error) {
      if (shown || IsFatal(error)) throw;
      GiveBack(charged);
      where.Warn(consequence, error);
      return false;
    }
  }

  // The same for parts that are never visible. After very many failures further parts are not read at all, because a
  // million errors would take too long.
  template <class Read>
  bool TryUnused(const Place& where, const char* consequence, const Read& read) {
    constexpr std::size_t kMostFailures = 10000;
    if (failures_ == kMostFailures) return false;
    if (Try(false, where, consequence, read)) return true;
    if (++failures_ == kMostFailures) where.Warn("what comes after it, and is not shown, was not looked at");
    return false;
  }

  // Charges memory of the scene to the memory budget. Data that many parts of a file share, or that no buffer contains,
  // is also limited to a multiple of the file's size, so that a few kilobytes cannot expand to gigabytes. Throws
  // Error(OutOfMemory).
  void Charge(std::size_t count, std::size_t size_each, const Place& where);
  // Makes all charges permanent that were made since Charged() was `before`, because other parts use that memory too.
  // It is not released if the part that is being read fails.
  void KeepSince(std::size_t before);
  std::size_t Charged() const { return charged_; }

  // An object of a list at the root.
  const Json& Object(const char* list, std::size_t index) const { return document.root[list][index]; }
  bool IsRequired(std::string_view extension) const;
  bool IsUsed(std::string_view extension) const;

  std::filesystem::path path;
  std::string file_name;
  LoadOptions options;
  Warnings warnings;
  Place place;
  Document document;
  LoadReport report;
  FileStore files;
  std::vector<std::vector<std::size_t>> primitives_read;  // by mesh: indices in the file of its primitives

 private:
  const ExtensionUse* FindExtension(std::string_view name) const;

  void GiveBack(std::size_t charged_before);

  std::size_t charged_ = 0;   // bytes that may be released
  std::size_t kept_ = 0;      // bytes charged permanently
  std::size_t failures_ = 0;  // of invisible parts
};

}  // namespace facet::gltf
