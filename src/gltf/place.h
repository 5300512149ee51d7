// The location of a value in a file, which is converted to text only when a message needs it.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "facet/error.h"
#include "gltf/warnings.h"

namespace facet::gltf {

// Limits the length of names in messages, since they may be as long as the file.
inline constexpr std::size_t kMostOfKey = 100, kMostOfMessage = 1000;
std::string Shortened(std::string_view text, std::size_t most);

// One step on the path from the file to a value in it. It is made on the stack while the file is read, and refers to
// its parent.
class Place {
 public:
  // `warnings`: receives the warnings about locations in the file; null: they are discarded.
  explicit Place(std::string_view file, Warnings* warnings = nullptr) : key_(file), warnings_(warnings) {}
  Place(const Place& parent, std::string_view key) : parent_(&parent), key_(key) {}
  Place(const Place& parent, std::size_t index) : parent_(&parent), index_(index), is_index_(true) {}

  // "accessors[3].bufferView": without the file.
  std::string Path() const {
    if (!parent_) return {};
    std::string path = parent_->Path();
    if (is_index_) return path + "[" + std::to_string(index_) + "]";
    return path.empty() ? Shortened(key_, kMostOfKey) : path + "." + Shortened(key_, kMostOfKey);
  }
  // "scene.glb: accessors[3].bufferView".
  std::string Full() const {
    const std::string path = Path(), file(Root().key_);
    return path.empty() ? file : file + ": " + path;
  }

  void Warn(const std::string& what) const {
    if (Warnings* const warnings = Root().warnings_) warnings->Add(Path(), Shortened(what, kMostOfMessage));
  }
  // Warns of `consequence` here, with its cause, an error here or elsewhere in the file.
  void Warn(const std::string& consequence, const Error& why) const {
    const std::string here = Full(), file = std::string(Root().key_) + ": ";
    std::string where = why.where() == here ? "" : why.where() + ": ";
    if (where.starts_with(file)) where.erase(0, file.size());
    Warn(consequence + " (" + where + why.message() + (why.hint().empty() ? "" : "; " + why.hint()) + ")");
  }

 private:
  const Place& Root() const {
    const Place* root = this;
    while (root->parent_) root = root->parent_;
    return *root;
  }

  const Place* parent_ = nullptr;
  std::string_view key_;
  std::size_t index_ = 0;
  bool is_index_ = false;
  Warnings* warnings_ = nullptr;  // the root's
};

[[noreturn]] inline void Fail(const Place& place, const std::string& message, const std::string& hint = {},
                              ErrorCode code = ErrorCode::InvalidInput) {
  throw Error(code, Shortened(message, kMostOfMessage), place.Full(), hint);
}

}  // namespace facet::gltf
