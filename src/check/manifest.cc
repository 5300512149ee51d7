#include "check/manifest.h"

#include <algorithm>
#include <array>
#include <map>
#include <nlohmann/json.hpp>

#include "base/input_file.h"
#include "base/json_bounds.h"
#include "base/memory_budget.h"
#include "base/printable.h"
#include "gltf/strict_json.h"

namespace facet {
namespace {

using Json = StrictJson;
using Value = JsonValue;

Digest ReadDigest(const Value& value) {
  if (const std::optional<Digest> digest = ParseDigest(value.Text())) return *digest;
  value.Fail(Quoted(value.Text()) + " is no SHA-256", "64 hexadecimal digits; --update writes them");
}

// A setting as text, as it would be given on the command line.
std::string SettingText(const Value& value) {
  if (value.json.is_string()) return value.json.get<std::string>();
  value.Expect(value.json.is_number(), "string or number");
  return value.json.dump();
}

void ReadSettings(const Value& value, RenderRequest& request) {
  value.Expect(value.json.is_object(), "object");
  for (const auto& [key, ignored] : value.json.items()) {
    const Value setting = value[key];
    SetOption(request, key, setting.Place(), SettingText(setting));
  }
}

struct Bound {
  const char* key;
  Range range;
  std::optional<double> CompareThresholds::*member;
};
constexpr std::array<Bound, 5> kBounds = {{{"max-flip", {0.0, 1.0}, &CompareThresholds::max_flip},
                                           {"max-rmse", {0.0, 1e6}, &CompareThresholds::max_rmse},
                                           {"max-difference", {0.0, 1e6}, &CompareThresholds::max_difference},
                                           {"min-psnr", {-200.0, 200.0}, &CompareThresholds::min_psnr_db},
                                           {"min-ssim", {-1.0, 1.0}, &CompareThresholds::min_ssim}}};

void ReadThresholds(const Value& value, Expectation& expect) {
  for (const Bound& bound : kBounds) {
    if (!value.Has(bound.key)) continue;
    const Value limit = value[bound.key];
    limit.Expect(limit.json.is_number(), "number");
    expect.thresholds.*bound.member = ParseNumber(limit.Place(), limit.json.dump(), bound.range);
    expect.has_thresholds = true;
  }
  if (value.Has("max-pixels")) {
    const Value limit = value["max-pixels"];
    expect.thresholds.max_pixels =
        limit.Expect(limit.json.is_number_unsigned(), "whole number of pixels").json.get<std::size_t>();
    expect.has_thresholds = true;
  }
  if (expect.has_thresholds && !expect.picture)
    value.Fail("thresholds need a picture to compare with", "add 'picture'");
}

Expectation ReadExpectation(const Value& value) {
  value.ExpectObject(std::array{"film", "inputs", "picture", "max-flip", "max-rmse", "max-difference", "max-pixels",
                                "min-psnr", "min-ssim"});
  Expectation expect;
  if (value.Has("film")) expect.film = ReadDigest(value["film"]);
  if (value.Has("inputs")) {
    const Value inputs = value["inputs"].ExpectObject(std::array{"description", "geometry", "textures", "environment"});
    const auto read = [&](const char* key) -> std::optional<Digest> {
      if (!inputs.Has(key)) return std::nullopt;
      return ReadDigest(inputs[key]);
    };
    expect.inputs = {read("description"), read("geometry"), read("textures"), read("environment")};
  }
  if (value.Has("picture")) {
    expect.picture = value["picture"].Text();
    if (expect.picture->extension() != ".png") value["picture"].Fail("is no .png", "golden pictures are PNG files");
  }
  ReadThresholds(value, expect);
  return expect;
}

// Reads the name of an entry, which must also be valid as a file name.
const std::string& ReadName(const Value& value) {
  const std::string& name = value.Text();
  const bool good = !name.empty() && name.size() <= 200 && name[0] != '.' && name.find('/') == std::string::npos &&
                    name.find('\\') == std::string::npos && Printable(name) == name;
  if (!good) {
    value.Fail(Quoted(name) + " cannot name a file",
               "use 1 to 200 bytes without slashes and control characters that begin with no full stop");
  }
  return name;
}

void ReadEntry(const Value& value, ManifestEntry& entry) {
  value.Expect(value.json.is_object(), "object");
  for (const char* key : {"name", "scene"}) {
    if (!value.Has(key)) value.Fail("has no " + Quoted(key));
  }
  entry.name = ReadName(value["name"]);
  value.ExpectObject(std::array{"name", "scene", "settings", "expect"});
  entry.scene = value["scene"].Text();
  if (value.Has("settings")) {
    ReadSettings(value["settings"], entry.request);
    for (const auto& [key, ignored] : value.json.at("settings").items()) entry.own_settings.insert(key);
  }
  if (value.Has("expect")) entry.expect = ReadExpectation(value["expect"]);
}

Json DigestsAsJson(const ExpectedInputs& inputs) {
  Json json = Json::object();
  const auto put = [&json](const char* key, const std::optional<Digest>& digest) {
    if (digest) json[key] = ToHex(*digest);
  };
  put("description", inputs.description);
  put("geometry", inputs.geometry);
  put("textures", inputs.textures);
  put("environment", inputs.environment);
  return json;
}

}  // namespace

std::string PlaceIn(const Manifest& manifest, std::string_view pointer) {
  return manifest.name + ": " + Printable(pointer);
}

std::string SettingPointer(const ManifestEntry& entry, std::string_view setting) {
  const bool own = entry.own_settings.contains(setting);
  return (own ? entry.pointer : std::string()) + "/settings/" + std::string(setting);
}

Manifest ReadManifest(const std::filesystem::path& path) {
  Manifest manifest;
  manifest.name = Printable(path.string());
  manifest.path = path;
  manifest.text = ReadFile(path).Text();
  const MemoryLease lease(JsonMemory(manifest.text), 2, "JSON", manifest.name);
  const Json json = ParseStrictJson(manifest.text, manifest.name);
  const Value root{json, Json::json_pointer(), manifest.name};
  root.Expect(json.is_object(), "manifest: a JSON object");
  if (!root.Has("version")) root.Fail("has no 'version'", "a manifest begins with \"version\": 1");
  if (json["version"] != 1) root["version"].Fail("is no version that this facet reads", "it reads version 1");
  try {
    root.ExpectObject(std::array{"version", "settings", "entries"});
  } catch (const Error& error) {
    manifest.problems.push_back(error);
  }
  RenderRequest common;
  if (root.Has("settings")) ReadSettings(root["settings"], common);
  if (!root.Has("entries")) root.Fail("has no 'entries'");
  const Value entries = root["entries"];
  entries.Expect(entries.json.is_array(), "list");
  if (entries.json.empty()) entries.Fail("is empty: there is nothing to check", "list a scene at least");

  constexpr std::size_t kEntry = sizeof(ManifestEntry) + 1024;  // with its strings and its result
  MemoryBudget::Current().Charge(entries.json.size(), kEntry, "entries", manifest.name);
  manifest.entries.reserve(entries.json.size());
  std::map<std::string, std::string> pointer_of_name, pointer_of_picture;
  for (std::size_t i = 0; i < entries.json.size(); ++i) {
    const Value value{entries.json[i], entries.pointer / i, manifest.name};
    ManifestEntry& entry = manifest.entries.emplace_back();
    entry.pointer = value.pointer.to_string();
    entry.request = common;
    try {
      ReadEntry(value, entry);
      const auto [first, is_new] = pointer_of_name.emplace(entry.name, entry.pointer);
      if (!is_new) value["name"].Fail(Quoted(entry.name) + " is the name of " + first->second + " too");
      if (entry.expect.picture) {
        const std::string picture = entry.expect.picture->lexically_normal().string();
        const auto [owner, is_own] = pointer_of_picture.emplace(picture, entry.pointer);
        if (!is_own) value["expect"]["picture"].Fail("is the picture of " + owner->second + " too");
      }
    } catch (const Error& error) {
      entry.problem = error;
    }
    if (entry.name.empty()) entry.name = "entry " + std::to_string(i);
  }
  return manifest;
}

std::string Rewritten(const Manifest& manifest, const std::vector<NewExpectation>& expectations) {
  const MemoryLease lease(JsonMemory(manifest.text), 2, "JSON", manifest.name);
  Json json = Json::parse(manifest.text);
  for (const NewExpectation& expectation : expectations) {
    Json& expect = json["entries"][expectation.entry]["expect"];
    expect["film"] = ToHex(expectation.film);
    expect["inputs"] = DigestsAsJson(expectation.inputs);
  }
  return json.dump(2) + "\n";
}

}  // namespace facet
