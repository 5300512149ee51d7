// Provenance: the text in a picture file that facet wrote, from which it can be rendered again.
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "facet/digest.h"

namespace facet {

struct Provenance {
  std::string version;                          // of facet
  std::string scene;                            // the file's name, without its folder
  std::map<std::string, std::string> settings;  // as SpelledOut() gives them
  Digest film;                                  // HashFilm()
  Digest pixels;                                // HashImage() of StoredForm() of the image
};

// Keyword and value pairs for the text in a PNG or EXR file: "Software", "facet:scene", "facet:settings" (a JSON
// object), "facet:film" and "facet:pixels". Nothing in them depends on the machine or the time.
std::vector<std::array<std::string, 2>> ToImageText(const Provenance& provenance);

// Reads the provenance of a picture file; `name` is used in messages. Throws Error(InvalidInput) for a file that is
// neither PNG nor EXR, was not written by facet, or has content that no version of facet writes.
Provenance ReadProvenance(std::span<const std::byte> picture, const std::string& name);

}  // namespace facet
