// What a picture that facet wrote says of itself, so that it can be made again.
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "facet/digest.h"

namespace facet {

struct Provenance {
  std::string version;                          // of facet
  std::string scene;                            // the file's name, without its folder
  std::map<std::string, std::string> settings;  // as SpelledOut() gives them
  Digest film;                                  // HashFilm()
  Digest pixels;                                // HashImage() of the picture in the file
};

// Keyword and value pairs for a PNG file's text chunks: "Software", "facet:scene", "facet:settings" (a JSON object),
// "facet:film" and "facet:pixels". Nothing in them depends on the machine or the time.
std::vector<std::array<std::string, 2>> ToPngText(const Provenance& provenance);

// What a PNG file says of itself. Throws Error: NotFound; InvalidInput for a file that is no PNG, or was not written by
// facet, or says something that no version of facet writes.
Provenance ReadProvenance(const std::filesystem::path& png);

}  // namespace facet
