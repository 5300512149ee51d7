// Golden tests: a manifest lists scenes, their settings and what is expected of their pictures (docs/golden-tests.md).
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
  Updated,  // its expectation was rewritten
  Failed,   // not as expected, or nothing is expected
  Error,    // could not be decided: the entry, its scene or its golden picture is at fault
};

// "passed", "within", "updated", "failed" or "error".
const char* NameOf(Verdict verdict);

struct CheckOptions {
  bool update = false;    // rewrite expectations that do not hold
  std::string only;       // an ECMAScript regular expression that an entry's name must contain; empty: all entries
  int threads = 0;        // 0: one per core. A bound on all entries together
  bool pictures = false;  // keep the pictures of entries that were not equal, for reports
  bool strict = false;    // entries with warnings fail
  // Of every entry's scene. `memory_limit` is for all entries together, and for what is rendered. `root`: the folder
  // that all files named by the manifest, and by its scenes, must lie in, those that an update writes too; empty: for
  // the manifest its own folder, for each scene the scene's.
  LoadOptions load;
};

// What came of one entry.
struct CheckedEntry {
  std::string name;
  std::string place;  // in the manifest, like "goldens.json: /entries/3/scene"
  Verdict verdict = Verdict::Error;
  std::string message;                        // one line; empty where there is nothing to say
  double seconds = 0.0;                       // wall clock; other entries run beside it
  std::optional<Digest> film;                 // HashFilm() of what was rendered; none: not rendered
  std::optional<Digest> expected_film;        // as the manifest had it
  std::optional<ImageDifference> difference;  // to the golden picture, where they were compared; its flip_map is empty
  std::vector<std::string> warnings;          // of loading and rendering
  std::vector<std::filesystem::path> files;   // that it was made from, the golden picture among them
  // PNG files, with CheckOptions::pictures, of entries that were rendered and not equal. Empty: there is no such
  // picture.
  std::vector<std::byte> expected, actual, heat_map;
};

struct CheckReport {
  std::string manifest;               // the file's name, as given
  std::vector<std::string> problems;  // of the manifest as a whole, one line each
  std::vector<CheckedEntry> entries;  // those that were selected, in the manifest's order
  double seconds = 0.0;               // wall clock

  std::size_t Count(Verdict verdict) const;
};

// Renders the entries of a manifest, several at a time, and compares. An entry is decided by the hash of its film;
// where that differs, or is not given, by a comparison of pictures. A picture that an entry lists is compared in any
// case, which covers developing. An error in one entry ends up in its verdict and stops no other. Apart from the times
// the report does not depend on the number of threads. With options.update the golden pictures and the manifest are
// rewritten where they do not hold, each file whole or not at all; entries that cannot be rendered stay as they are.
// Throws Error where nothing could be run: NotFound, InvalidInput (no JSON, no manifest, or one without entries),
// InvalidUsage (a bad option, or no entry is selected), OutputFailed (the manifest cannot be rewritten).
CheckReport CheckManifest(const std::filesystem::path& manifest, const CheckOptions& options = {});

// The report as one HTML file that needs no other: the table of all entries, and the pictures that were kept, side by
// side and blinking.
std::string CheckHtml(const CheckReport& report);

// The report as the JUnit XML that continuous integration reads. Failed entries are failures, errors are errors.
std::string JUnitXml(const CheckReport& report);

}  // namespace facet
