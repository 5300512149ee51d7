// The file that lists golden tests.
#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "facet/compare.h"
#include "facet/digest.h"
#include "facet/error.h"
#include "settings/render_request.h"

namespace facet {

// Hashes of what a rendering starts from; none where the manifest has none.
struct ExpectedInputs {
  std::optional<Digest> description, geometry, textures, environment;
};

struct Expectation {
  std::optional<Digest> film;
  std::optional<ExpectedInputs> inputs;
  std::optional<std::filesystem::path> picture;  // relative to the manifest
  CompareThresholds thresholds;
  bool has_thresholds = false;
};

struct ManifestEntry {
  std::string pointer;  // a JSON pointer: "/entries/3"
  std::string name;
  std::filesystem::path scene;  // relative to the manifest
  RenderRequest request;
  std::set<std::string, std::less<>> own_settings;  // names; the others come from the manifest's common ones
  Expectation expect;
  std::optional<Error> problem;  // why it cannot be run
};

struct Manifest {
  std::string name;            // what messages call it
  std::filesystem::path path;  // what it was read from: paths in it are relative to its folder
  std::string text;
  std::vector<ManifestEntry> entries;
  std::vector<Error> problems;  // that concern no single entry
};

// Reads a manifest. What is wrong with one entry is kept in it. Throws Error where there is nothing to run: NotFound;
// InvalidInput for a syntax error (with line and column), a missing version or list of entries, or bad common settings.
Manifest ReadManifest(const std::filesystem::path& path);

// "goldens.json: /entries/3/scene".
std::string PlaceIn(const Manifest& manifest, std::string_view pointer);

// Where the value of a setting of an entry stands: its own, else the common one.
std::string SettingPointer(const ManifestEntry& entry, std::string_view setting);

// What an update writes into an entry.
struct NewExpectation {
  std::size_t entry;  // index
  Digest film;
  ExpectedInputs inputs;
};

// The manifest's text with other films and inputs; all else, and its order, stays. Indented by 2.
std::string Rewritten(const Manifest& manifest, const std::vector<NewExpectation>& expectations);

}  // namespace facet
