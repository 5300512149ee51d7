#include "film/hash_film.h"

#include <span>
#include <string>

#include "facet/digest.h"

namespace facet {

Sha256 BeginFilmHash(int width, int height) {
  Sha256 hash;
  hash.Add("facet film " + std::to_string(width) + " " + std::to_string(height) + "\n");
  return hash;
}

Digest HashFilm(const Film& film) {
  static_assert(sizeof(glm::vec4) == 4 * sizeof(float));
  Sha256 hash = BeginFilmHash(film.width, film.height);
  hash.Add(std::as_bytes(std::span(film.pixels)));
  return hash.Finish();
}

}  // namespace facet
