#include "cli/stats_output.h"

#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "base/number_text.h"
#include "base/printable.h"
#include "cli/camera_text.h"
#include "facet/version.h"

namespace facet::cli {
namespace {

std::uint64_t PeakResidentBytes() {
  rusage usage{};
  if (getrusage(RUSAGE_SELF, &usage) != 0) return 0;
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024u;  // Linux reports kibibytes
}

struct Time {
  const char* key;
  const char* label;
  double seconds;
};

// The stages in order; the indented stages of the library are parts of "render".
std::array<Time, 12> Times(const CommandStats& s) {
  const RenderStats& r = s.render;
  return {{{"load", "load", s.load_seconds},
           {"environment_file", "environment file", s.environment_seconds},
           {"pose", "  pose", r.pose_seconds},
           {"environment", "  environment", r.environment_seconds},
           {"albedo_tables", "  albedo tables", r.table_seconds},
           {"textures", "  textures", r.texture_seconds},
           {"geometry", "  geometry", r.geometry_seconds},
           {"raster", "  raster", r.raster_seconds},
           {"render", "render", s.render_seconds},
           {"encode", "encode", s.encode_seconds},
           {"write", "write", s.write_seconds},
           {"total", "total", s.total_seconds}}};
}

struct Count {
  const char* key;
  const char* label;
  std::uint64_t value;
};

std::array<Count, 12> Counts(const RenderStats& r) {
  return {{{"drawables", "drawables", r.drawables},
           {"vertices", "vertices", r.vertices},
           {"triangles_in", "triangles in", r.triangles_in},
           {"triangles_culled", "triangles culled", r.triangles_culled},
           {"triangles_clipped", "triangles clipped", r.triangles_clipped},
           {"triangles_binned", "triangles binned", r.triangles_binned},
           {"tiles", "tiles", r.tiles},
           {"fragments_shaded", "fragments shaded", r.fragments_shaded},
           {"fragments_blended", "fragments blended", r.fragments_blended},
           {"covered_pixels", "covered pixels", r.covered_pixels},
           {"images_decoded", "images decoded", r.images_decoded},
           {"non_finite_fragments", "non-finite fragments", r.non_finite_fragments}}};
}

std::string Row(const char* label, const std::string& value, const char* unit) {
  std::array<char, 96> line;
  const int length = std::snprintf(line.data(), line.size(), "  %-22s %16s%s%s\n", label, value.c_str(),
                                   *unit != '\0' ? " " : "", unit);
  return std::string(line.data(), std::min(static_cast<std::size_t>(length), line.size() - 1));
}

std::string Milliseconds(double seconds) {
  std::array<char, 48> text;
  const int length = std::snprintf(text.data(), text.size(), "%.2f", seconds * 1e3);
  return std::string(text.data(), static_cast<std::size_t>(length));
}

std::string Mebibytes(std::uint64_t bytes) {
  std::array<char, 48> text;
  const int length = std::snprintf(text.data(), text.size(), "%.1f", static_cast<double>(bytes) / 1048576.0);
  return std::string(text.data(), static_cast<std::size_t>(length));
}

}  // namespace

std::string StatsTable(const CommandStats& stats) {
  const RenderStats& r = stats.render;
  std::string table = Printable(stats.output) + ": " + std::to_string(stats.width) + "x" +
                      std::to_string(stats.height) + ", " + std::to_string(stats.samples) +
                      (stats.samples == 1 ? " sample" : " samples") + " a pixel, " + std::to_string(r.threads) +
                      (r.threads == 1 ? " thread, " : " threads, ") + Printable(r.target) + "\n";
  table += "  camera: " + CameraText(r.camera, r.camera_target_distance) + "\n";
  for (const Time& time : Times(stats)) table += Row(time.label, Milliseconds(time.seconds), "ms");
  for (const Count& count : Counts(r)) table += Row(count.label, Grouped(count.value), "");
  table += Row("input files", Mebibytes(stats.input_bytes), "MiB");
  table += Row("textures", Mebibytes(r.texture_bytes), "MiB");
  table += Row("peak memory", Mebibytes(PeakResidentBytes()), "MiB");
  return table;
}

std::string StatsJson(const CommandStats& stats) {
  using Json = nlohmann::ordered_json;
  Json seconds, counts;
  for (const Time& time : Times(stats)) seconds[time.key] = time.seconds;
  for (const Count& count : Counts(stats.render)) counts[count.key] = count.value;
  const Json json = {
      {"facet", Version()},
      {"input", stats.input},
      {"output", stats.output},
      {"width", stats.width},
      {"height", stats.height},
      {"samples", stats.samples},
      {"threads", stats.render.threads},
      {"target", stats.render.target},
      {"camera", CameraJson(stats.render.camera, stats.render.camera_target_distance)},
      {"seconds", seconds},
      {"counts", counts},
      {"bytes",
       {{"input", stats.input_bytes},
        {"textures", stats.render.texture_bytes},
        {"peak_resident", PeakResidentBytes()}}},
      {"disabled", stats.render.disabled},
      {"warnings", stats.render.warnings},
  };
  // File names need not be UTF-8; JSON must be.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace facet::cli
