// facet diff: how far two pictures are apart.
#pragma once

#include <filesystem>
#include <optional>

#include "facet/compare.h"

namespace facet::cli {

struct DiffOptions {
  std::filesystem::path a, b;                   // pictures: the reference and the test
  std::optional<std::filesystem::path> output;  // the heat map
  bool json = false;
  CompareOptions compare;
  CompareThresholds thresholds;
};

// Prints the measures to standard output. Returns the exit code: 0 when the pictures are equal, or within all
// thresholds where there are some; 1 when they are not. Throws Error.
int RunDiff(const DiffOptions& options);

}  // namespace facet::cli
