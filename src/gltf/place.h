// Where in a file something stands, spelled only when a message needs it.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "facet/error.h"

namespace facet::gltf {

// A step on the way from the file to a value in it. Made on the stack while walking down; refers to its parent.
class Place {
 public:
  explicit Place(std::string_view file) : key_(file) {}
  Place(const Place& parent, std::string_view key) : parent_(&parent), key_(key) {}
  Place(const Place& parent, std::size_t index) : parent_(&parent), index_(index), is_index_(true) {}

  // "accessors[3].bufferView": without the file.
  std::string Path() const {
    if (!parent_) return {};
    std::string path = parent_->Path();
    if (is_index_) return path + "[" + std::to_string(index_) + "]";
    return path.empty() ? std::string(key_) : path + "." + std::string(key_);
  }
  // "scene.glb: accessors[3].bufferView".
  std::string Full() const {
    const Place* root = this;
    while (root->parent_) root = root->parent_;
    const std::string path = Path();
    return path.empty() ? std::string(root->key_) : std::string(root->key_) + ": " + path;
  }

 private:
  const Place* parent_ = nullptr;
  std::string_view key_;
  std::size_t index_ = 0;
  bool is_index_ = false;
};

[[noreturn]] inline void Fail(const Place& place, const std::string& message, const std::string& hint = {},
                              ErrorCode code = ErrorCode::InvalidInput) {
  throw Error(code, message, place.Full(), hint);
}

}  // namespace facet::gltf
