// A folder for one test, with the tiny scene in it.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

#include "cli/tiny_scene.h"

namespace facet::test {

class Scratch : public testing::Test {
 protected:
  Scratch() {
    std::string pattern = testing::TempDir() + "facet-check-XXXXXX";
    if (mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("mkdtemp failed");
    folder_ = pattern;
    Write("tiny.gltf", TinyScene());
  }
  ~Scratch() override {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }

  std::filesystem::path Write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return folder_ / name;
  }
  std::string Read(const std::string& name) const {
    std::ifstream file(folder_ / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  }
  bool Exists(const std::string& name) const { return std::filesystem::exists(folder_ / name); }

  // A manifest of 48 x 32 pixels a picture with the given entries.
  std::filesystem::path Manifest(const std::string& entries) const {
    return Write("goldens.json", R"({"version": 1, "settings": {"size": "48x32"}, "entries": [)" + entries + "]}");
  }

  std::filesystem::path folder_;
};

}  // namespace facet::test
