// What every part of the loader is handed: the document, the bounds, and where to complain.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "facet/load.h"
#include "gltf/document.h"
#include "gltf/files.h"

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
        place(file_name, &warnings),
        files(path, options, report) {}
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  // Calls `read`, which throws Error for what it cannot read. Where the picture shows that, the error stands; elsewhere
  // it becomes a warning of `consequence`, what `read` charged is given back, and the result is false. What is fatal
  // stands everywhere.
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

  // The same for what the picture does not show in any case. In a file with very many failures the rest is not tried
  // any more, because a million errors take too long.
  template <class Read>
  bool TryUnused(const Place& where, const char* consequence, const Read& read) {
    constexpr std::size_t kMostFailures = 10000;
    if (failures_ == kMostFailures) return false;
    if (Try(false, where, consequence, read)) return true;
    if (++failures_ == kMostFailures) where.Warn("what comes after it, and is not shown, was not looked at");
    return false;
  }

  // Charges what the scene takes to the memory budget. What many parts of a file share, or no buffer holds, is bounded
  // by a multiple of the file's size as well: a few kilobytes must not unfold to gigabytes. Throws Error(OutOfMemory).
  void Charge(std::size_t count, std::size_t size_each, const Place& where);
  // What has been charged since Charged() was `before` stays for good, whatever becomes of the part that asked for it:
  // others use it too.
  void KeepSince(std::size_t before);
  std::size_t Charged() const { return charged_; }

  // Of a list at the root.
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
  std::vector<std::vector<std::size_t>> primitives_read;  // by mesh: which of the file's became its primitives

 private:
  const ExtensionUse* FindExtension(std::string_view name) const;

  void GiveBack(std::size_t charged_before);

  std::size_t charged_ = 0;   // bytes, of those that may be given back
  std::size_t kept_ = 0;      // of the others
  std::size_t failures_ = 0;  // of parts that the picture does not show
};

}  // namespace facet::gltf
