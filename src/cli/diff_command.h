// `facet diff`: measures the difference between two images.
#pragma once

#include <filesystem>
#include <optional>

#include "facet/compare.h"

namespace facet::cli {

struct DiffOptions {
  std::filesystem::path a, b;                   // the reference and the test image
  std::optional<std::filesystem::path> output;  // the heat map
  bool json = false;
  CompareOptions compare;
  CompareThresholds thresholds;
};

// Prints the measures to standard output. Returns the exit code: 0 if the images are equal or, if thresholds are given,
// within all of them; otherwise 1. Throws Error.
int RunDiff(const DiffOptions& options);

}  // namespace facet::cli
