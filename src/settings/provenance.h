// What a picture that facet wrote says of itself, so that it can be made again.
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
  Digest pixels;                                // HashImage() of StoredForm() of the picture
};

// Keyword and value pairs for the text in a PNG or EXR file: "Software", "facet:scene", "facet:settings" (a JSON
// object), "facet:film" and "facet:pixels". Nothing in them depends on the machine or the time.
std::vector<std::array<std::string, 2>> ToImageText(const Provenance& provenance);

// What a picture's file says of itself; messages call it `name`. Throws Error(InvalidInput) for one that is neither PNG
// nor EXR, or was not written by facet, or says something that no version of facet writes.
Provenance ReadProvenance(std::span<const std::byte> picture, const std::string& name);

}  // namespace facet
