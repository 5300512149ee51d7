// Time and memory that a rendering took, as a table and as JSON.
#pragma once

#include <cstddef>
#include <string>

#include "facet/render.h"

namespace facet::cli {

// The library's RenderStats, and the program's own stages around it. Times are wall-clock seconds.
struct CommandStats {
  std::string input, output;
  int width = 0, height = 0, samples = 0;
  double load_seconds = 0;         // scene file
  double environment_seconds = 0;  // environment file
  double render_seconds = 0;
  double encode_seconds = 0;  // from exposure to encoding
  double write_seconds = 0;
  double total_seconds = 0;  // since the program's start
  std::size_t input_bytes = 0;
  RenderStats render;
};

// A table for standard error.
std::string StatsTable(const CommandStats& stats);

// One JSON object and a newline. Keys are stable: "input", "output", "width", "height", "samples", "threads",
// "target", "camera" {...}, "facet", "seconds" {...}, "counts" {...}, "bytes" {...}, "warnings" [...].
std::string StatsJson(const CommandStats& stats);

}  // namespace facet::cli
