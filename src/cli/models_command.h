// `facet models`.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace facet::cli {

struct ModelsOptions {
  std::string name;  // empty: all
  std::optional<std::filesystem::path> chart, compare;
  bool schema = false;
  bool json = false;
};

void RunModels(const ModelsOptions& options);

}  // namespace facet::cli
