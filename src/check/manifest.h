// The manifest: a JSON file that lists golden tests.
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

// Digests of a rendering's inputs; none if the manifest does not give them.
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
  std::string pointer;  // JSON pointer of the entry: "/entries/3"
  std::string name;
  std::filesystem::path scene;  // relative to the manifest
  RenderRequest request;
  std::set<std::string, std::less<>> own_settings;  // names of the entry's own settings; others are common ones
  Expectation expect;
  std::optional<Error> problem;  // the reason why it cannot be run
};

struct Manifest {
  std::string name;            // the name in messages
  std::filesystem::path path;  // of the file; paths in it are relative to its folder
  std::string text;
  std::vector<ManifestEntry> entries;
  std::vector<Error> problems;  // problems that do not concern a single entry
};

// Reads a manifest. An error in an entry becomes its `problem`. Throws Error if nothing can be run: NotFound;
// InvalidInput for a syntax error (with line and column), a missing version or list of entries, or bad common settings.
Manifest ReadManifest(const std::filesystem::path& path);

// "goldens.json: /entries/3/scene".
std::string PlaceIn(const Manifest& manifest, std::string_view pointer);

// The JSON pointer of a setting's value for an entry: the entry's own, otherwise the common one.
std::string SettingPointer(const ManifestEntry& entry, std::string_view setting);

// The values that an update writes into an entry.
struct NewExpectation {
  std::size_t entry;  // index
  Digest film;
  ExpectedInputs inputs;
};

// The manifest's text with new films and inputs. All other content and the order of keys stay. Indented by 2.
std::string Rewritten(const Manifest& manifest, const std::vector<NewExpectation>& expectations);

}  // namespace facet
