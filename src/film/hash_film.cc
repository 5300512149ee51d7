#include <span>
#include <string>

#include "base/sha256.h"
#include "facet/digest.h"

namespace facet {

Digest HashFilm(const Film& film) {
  static_assert(sizeof(glm::vec4) == 4 * sizeof(float));
  Sha256 hash;
  hash.Add("facet film " + std::to_string(film.width) + " " + std::to_string(film.height) + "\n");
  hash.Add(std::as_bytes(std::span(film.pixels)));
  return hash.Finish();
}

}  // namespace facet
