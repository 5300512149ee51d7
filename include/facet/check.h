// Golden tests: a manifest lists scenes, their settings and the expected results (docs/golden-tests.md).
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "facet/compare.h"
#include "facet/digest.h"
#include "facet/load.h"

namespace facet {

enum class Verdict : std::uint8_t {
  Passed,   // as expected
  Within,   // not equal, but within the entry's thresholds
  Updated,  // not as expected; the expectation was rewritten
  Failed,   // not as expected, or nothing is expected
  Error,    // could not be decided: the entry, its scene or its golden picture is broken
};

// "passed", "within", "updated", "failed" or "error".
const char* NameOf(Verdict verdict);

struct CheckOptions {
  bool update = false;    // rewrite expectations that are not met
  std::string only;       // an ECMAScript regular expression that entries' names must match in part; empty: all entries
  int threads = 0;        // for all entries together; 0: one per core
  bool pictures = false;  // keep the pictures of entries that were not equal, for reports
  bool strict = false;    // entries with warnings fail
  // Used for every entry's scene. `memory_limit` bounds loading and rendering of all entries together. `root`: the
  // folder in which all files named by the manifest and by its scenes must lie, including those that an update writes;
  // empty: the manifest's folder, and for each scene its own.
  LoadOptions load;
};

// The result of one entry.
struct CheckedEntry {
  std::string name;
  std::string place;  // where in the manifest, like "goldens.json: /entries/3/scene"
  Verdict verdict = Verdict::Error;
  std::string message;                        // one line; may be empty
  double seconds = 0.0;                       // wall clock; other entries run at the same time
  std::optional<Digest> film;                 // HashFilm() of the rendered film; none: not rendered
  std::optional<Digest> expected_film;        // from the manifest
  std::optional<ImageDifference> difference;  // from the golden picture, if compared; its flip_map is empty
  std::vector<std::string> warnings;          // of loading and rendering
  std::vector<std::filesystem::path> files;   // all input files, including the golden picture
  // PNG files, if CheckOptions::pictures, of entries that were rendered and are not equal. Empty: there is none.
  std::vector<std::byte> expected, actual, heat_map;
};

struct CheckReport {
  std::string manifest;               // the path as it was given
  std::vector<std::string> problems;  // of the manifest as a whole, one line each
  std::vector<CheckedEntry> entries;  // the selected ones, in the manifest's order
  double seconds = 0.0;               // wall clock

  std::size_t Count(Verdict verdict) const;
};

// Renders the entries of a manifest, several at a time, and compares them with what is expected. The hash of the film
// decides; if it differs, or the manifest has none, the golden picture does. A golden picture is compared in any case,
// so that tone mapping and encoding are tested as well. An error in one entry becomes its verdict, and the others still
// run. Except for the times, the report does not depend on the number of threads. With options.update, golden pictures
// and manifest are rewritten where they are not met, each file completely or not at all; entries that cannot be
// rendered are not changed. Throws Error if nothing can be run: NotFound, InvalidInput (no JSON, no manifest, or one
// without entries), InvalidUsage (a bad option, or no entry is selected), OutputFailed (the manifest cannot be
// rewritten).
CheckReport CheckManifest(const std::filesystem::path& manifest, const CheckOptions& options = {});

// The report as one self-contained HTML file: the table of all entries, and the pictures that were kept, side by side
// and alternating.
std::string CheckHtml(const CheckReport& report);

// The report as the JUnit XML that continuous integration reads. Failed entries are failures, errors are errors.
std::string JUnitXml(const CheckReport& report);

}  // namespace facet
