// Writes an Explanation as text tables and as JSON.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "base/number_text.h"
#include "base/printable.h"
#include "facet/explain.h"

namespace facet {
namespace {

using Json = nlohmann::ordered_json;

// --- Tables ---------------------------------------------------------------------------------------------------------

std::size_t Columns(const std::string& text) {  // on a terminal, for text without combining or wide characters
  return std::size_t(std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

// Formats a table whose columns are as wide as their widest cells. Rows below the first are indented. `alignment` has
// one letter per column: 'l' or 'r'.
std::string Table(std::vector<std::vector<std::string>> rows, const std::string& alignment) {
  for (std::size_t r = 1; r < rows.size(); ++r) rows[r][0] = std::string(2, ' ').append(rows[r][0]);
  std::vector<std::size_t> widths(alignment.size(), 0);
  for (const auto& row : rows) {
    for (std::size_t c = 0; c < row.size(); ++c) widths[c] = std::max(widths[c], Columns(row[c]));
  }
  std::string text;
  for (const auto& row : rows) {
    std::string line;
    for (std::size_t c = 0; c < row.size(); ++c) {
      const std::string space(widths[c] - Columns(row[c]), ' ');
      line += (c == 0 ? "" : "  ") + (alignment[c] == 'r' ? space + row[c] : row[c] + space);
    }
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  return text;
}

std::string Fixed(double value, int digits) {
  std::array<char, 64> text;
  std::snprintf(text.data(), text.size(), "%.*f", digits, value);
  return text.data();
}

std::string Milliseconds(double seconds) { return Fixed(seconds * 1e3, 2); }

std::string Bytes(double bytes) {
  if (bytes == 0.0) return "0";
  return std::string(bytes < 0.0 ? "-" : "") + BytesWords(bytes < 0.0 ? -bytes : bytes);
}

// --- Sections -------------------------------------------------------------------------------------------------------

std::string GeometryText(const RenderStats& stats) {
  return Table({{"Geometry", ""},
                {"drawables", Grouped(stats.drawables)},
                {"vertices", Grouped(stats.vertices)},
                {"triangles, lines and points", Grouped(stats.triangles_in)},
                {"triangles on the screen", Grouped(stats.triangles_binned)},
                {"fragments shaded", Grouped(stats.fragments_shaded + stats.fragments_blended)},
                {"deformed or completed copies", Bytes(double(stats.pose_bytes))}},
               "lr");
}

std::string NameOf(const ExplainedMaterial& material) {
  if (material.index < 0) return "(glTF's default)";
  return material.name.empty() ? "(number " + std::to_string(material.index) + ")" : Printable(material.name);
}

std::string MaterialsText(const Explanation& e) {
  std::vector<std::vector<std::string>> rows = {{"Materials", "drawables", "triangles", "features"}};
  for (const ExplainedMaterial& m : e.materials) {
    std::vector<std::string> words = m.features;
    words.insert(words.begin(), m.lit ? "lit" : "unlit");
    if (m.model != "metallic-roughness" && m.model != "unlit") words.insert(words.begin(), m.model);
    rows.push_back({NameOf(m), Grouped(m.drawables), Grouped(m.triangles), Joined(words)});
  }
  return Table(rows, "lrrl");
}

std::string FileWords(const ImageHeader& file) {
  if (file.width == 0) return "unknown";
  return std::to_string(file.width) + "x" + std::to_string(file.height) + " " + file.format;
}

std::string TexturesText(const Explanation& e) {
  std::vector<std::vector<std::string>> rows = {{"Textures", "role", "file", "levels", "channels", "bits", "kept"}};
  for (const ExplainedTexture& t : e.textures) {
    std::vector<std::string> row = {Printable(t.image), Joined(t.roles), FileWords(t.file)};
    if (t.kept) {
      row.insert(row.end(),
                 {std::to_string(t.kept->levels), std::to_string(t.kept->channels), std::to_string(t.kept->bits),
                  Bytes(double(t.kept->bytes)) +
                      (t.kept->empty > 0.0 ? ", " + Fixed(std::floor(100.0 * t.kept->empty), 0) + " % black" : "")});
    } else {
      row.insert(row.end(), {"", "", "", "not decoded: nothing visible reads it, or it is broken"});
    }
    rows.push_back(std::move(row));
  }
  return Table(rows, "lllrrrl");
}

std::string LightText(const Explanation& e) {
  std::vector<std::vector<std::string>> rows = {{"Light", ""}};
  if (e.environment_light || e.environment_background) {
    rows.push_back({"environment", e.environment + ", " + std::to_string(e.first.environment_size) +
                                       " texels along its sharpest map, " + Bytes(double(e.first.environment_bytes)) +
                                       ": " + (e.environment_light ? "it lights" : "it does not light") +
                                       (e.environment_background ? ", and is shown" : "")});
  }
  const auto lights = [&](int count, const char* kind) {
    if (count > 0) rows.push_back({std::string(kind) + " lights", std::to_string(count)});
  };
  lights(e.lights.directional, "directional");
  lights(e.lights.point, "point");
  lights(e.lights.spot, "spot");
  if (rows.size() == 1) rows.push_back({"none", ""});
  return Table(rows, "ll");
}

std::string PlanesText(const Explanation& e) {
  std::vector<std::vector<std::string>> rows = {{"Planes besides colour", "bytes", "what"}};
  for (const PlaneKind plane : e.planes) {
    const PlaneInfo& info = InfoOf(plane);
    const std::size_t pixels = std::size_t(e.width) * std::size_t(e.height);
    rows.push_back({std::string(info.name), Bytes(double(pixels * info.PixelBytes())), std::string(info.meaning)});
  }
  return Table(rows, "lrl");
}

// Splits "WHAT: WHY" into its two parts.
std::pair<std::string, std::string> Split(const std::string& line) {
  const std::size_t colon = line.find(": ");
  return {line.substr(0, colon), colon == std::string::npos ? std::string() : line.substr(colon + 2)};
}

std::string DisabledText(const Explanation& e) {
  std::vector<std::vector<std::string>> rows = {{"Disabled", "because"}};
  for (const std::string& line : e.first.disabled) {
    const auto [what, why] = Split(line);
    rows.push_back({what, why});
  }
  return Table(rows, "ll");
}

std::string FirstFrameText(const Explanation& e) {
  const RenderStats& s = e.first;
  const auto decoded = s.images_decoded == 1 ? " image)" : " images)";
  return Table(
      {{"The first frame", "ms"},
       {"pose", Milliseconds(s.pose_seconds)},
       {"textures (" + std::to_string(s.images_decoded) + decoded + ", tangents", Milliseconds(s.texture_seconds)},
       {"prepare the environment", Milliseconds(s.environment_seconds)},
       {"albedo tables", Milliseconds(s.table_seconds)},
       {"geometry", Milliseconds(s.geometry_seconds)},
       {"pixels", Milliseconds(s.raster_seconds)},
       {"all", Milliseconds(s.total_seconds)}},
      "lr");
}

std::string CostsText(const Explanation& e) {
  std::string text = "A later frame takes " + Milliseconds(e.steady_seconds) + " ms, the median of " +
                     std::to_string(e.frames) + ". Without a feature it takes less by\n\n";
  std::vector<std::vector<std::string>> rows = {
      {"feature", "ms", "share", "quartiles", "prepare, ms", "memory", "leave it out by"}};
  for (const FeatureCost& c : e.costs) {
    rows.push_back({c.feature, Milliseconds(c.seconds), Fixed(100.0 * c.seconds / e.steady_seconds, 1) + " %",
                    Milliseconds(c.seconds_low) + " to " + Milliseconds(c.seconds_high), Milliseconds(c.first_seconds),
                    Bytes(double(c.bytes)), c.option});
  }
  return text + Table(rows, "lrrrrrl");
}

// --- JSON -----------------------------------------------------------------------------------------------------------

Json TexturesJson(const Explanation& e) {
  Json list = Json::array();
  for (const ExplainedTexture& t : e.textures) {
    Json texture = {{"image", t.image},         {"roles", t.roles},           {"format", t.file.format},
                    {"width", t.file.width},    {"height", t.file.height},    {"channels", t.file.channels},
                    {"file_bits", t.file.bits}, {"file_bytes", t.file.bytes}, {"decoded", t.kept.has_value()}};
    if (t.kept) {
      texture["levels"] = t.kept->levels;
      texture["channels"] = t.kept->channels;
      texture["bits"] = t.kept->bits;
      texture["bytes"] = t.kept->bytes;
      texture["empty"] = t.kept->empty;
    }
    list.push_back(std::move(texture));
  }
  return list;
}

Json MaterialsJson(const Explanation& e) {
  Json list = Json::array();
  for (const ExplainedMaterial& m : e.materials) {
    list.push_back({{"name", m.name},
                    {"index", m.index},
                    {"model", m.model},
                    {"lit", m.lit},
                    {"features", m.features},
                    {"drawables", m.drawables},
                    {"triangles", m.triangles}});
  }
  return list;
}

Json PlanesJson(const Explanation& e) {
  Json list = Json::array();
  for (const PlaneKind plane : e.planes) list.push_back(InfoOf(plane).name);
  return list;
}

Json DisabledJson(const Explanation& e) {
  Json list = Json::array();
  for (const std::string& line : e.first.disabled) {
    const auto [what, why] = Split(line);
    list.push_back({{"what", what}, {"why", why}});
  }
  return list;
}

Json CostsJson(const Explanation& e) {
  Json list = Json::array();
  for (const FeatureCost& c : e.costs) {
    list.push_back({{"feature", c.feature},
                    {"option", c.option},
                    {"pairs", c.pairs},
                    {"seconds", c.seconds},
                    {"seconds_low", c.seconds_low},
                    {"seconds_high", c.seconds_high},
                    {"first_seconds", c.first_seconds},
                    {"bytes", c.bytes}});
  }
  return list;
}

}  // namespace

std::string ToText(const Explanation& e, const std::string& scene) {
  const RenderStats& s = e.first;
  return Printable(scene) + ", " + std::to_string(e.width) + "x" + std::to_string(e.height) + ", " +
         std::to_string(e.samples) + (e.samples == 1 ? " sample" : " samples") + " a pixel, " +
         std::to_string(s.threads) + (s.threads == 1 ? " thread, " : " threads, ") + s.target + "\n\n" +
         GeometryText(s) + "\n" + MaterialsText(e) + "\n" + (e.textures.empty() ? "" : TexturesText(e) + "\n") +
         LightText(e) + "\n" + (e.planes.empty() ? "" : PlanesText(e) + "\n") + DisabledText(e) + "\n" +
         FirstFrameText(e) + "\n" + CostsText(e);
}

std::string ToJson(const Explanation& e, const std::string& scene) {
  const RenderStats& s = e.first;
  const Json json = {
      {"facet", e.version},
      {"scene", scene},
      {"width", e.width},
      {"height", e.height},
      {"samples", e.samples},
      {"threads", s.threads},
      {"target", s.target},
      {"geometry",
       {{"drawables", s.drawables},
        {"vertices", s.vertices},
        {"triangles_in", s.triangles_in},
        {"triangles_binned", s.triangles_binned},
        {"fragments_shaded", s.fragments_shaded},
        {"fragments_blended", s.fragments_blended},
        {"pose_bytes", s.pose_bytes}}},
      {"materials", MaterialsJson(e)},
      {"textures", TexturesJson(e)},
      {"environment",
       {{"picture", e.environment},
        {"lights", e.environment_light},
        {"shown", e.environment_background},
        {"size", s.environment_size},
        {"bytes", s.environment_bytes}}},
      {"punctual_lights", {{"directional", e.lights.directional}, {"point", e.lights.point}, {"spot", e.lights.spot}}},
      {"planes", PlanesJson(e)},
      {"disabled", DisabledJson(e)},
      {"first_frame",
       {{"pose_seconds", s.pose_seconds},
        {"texture_seconds", s.texture_seconds},
        {"images_decoded", s.images_decoded},
        {"environment_seconds", s.environment_seconds},
        {"table_seconds", s.table_seconds},
        {"geometry_seconds", s.geometry_seconds},
        {"raster_seconds", s.raster_seconds},
        {"total_seconds", s.total_seconds}}},
      {"steady_frame", {{"seconds", e.steady_seconds}, {"frames", e.frames}}},
      {"costs", CostsJson(e)},
      {"warnings", s.warnings},
  };
  // Names from files need not be UTF-8; JSON must be.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace facet
