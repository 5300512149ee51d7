// What a rendering took, for people and for programs.
#pragma once

#include <cstddef>
#include <string>

#include "facet/render.h"

namespace facet::cli {

// Around the RenderStats of the library: what the program itself did. Times are wall-clock seconds.
struct CommandStats {
  std::string input, output;
  int width = 0, height = 0, samples = 0;
  double load_seconds = 0;         // the scene's file
  double environment_seconds = 0;  // the environment's file
  double render_seconds = 0;
  double encode_seconds = 0;  // exposure to encoding
  double write_seconds = 0;
  double total_seconds = 0;  // since the program's start
  std::size_t input_bytes = 0;
  RenderStats render;
};

// Lines for standard error.
std::string StatsTable(const CommandStats& stats);

// One JSON object and a line end. Keys are stable: "input", "output", "width", "height", "samples", "threads",
// "target", "camera" {...}, "facet", "seconds" {...}, "counts" {...}, "bytes" {...}, "warnings" [...].
std::string StatsJson(const CommandStats& stats);

}  // namespace facet::cli
