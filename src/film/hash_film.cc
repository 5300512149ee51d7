#include "film/hash_film.h"

#include <iterator>
#include <span>
#include <string>

#include "facet/error.h"

namespace facet {

Sha256 BeginFilmHash(int width, int height) {
  Sha256 hash;
  hash.Add("facet film " + std::to_string(width) + " " + std::to_string(height) + "\n");
  return hash;
}

void CheckFilm(const Film& film) {
  const bool sized = film.width >= 0 && film.height >= 0;
  if (sized && film.pixels.size() == std::size_t(film.width) * std::size_t(film.height)) {
    if (film.through.empty() || film.through.size() == film.pixels.size()) return;
    throw Error(ErrorCode::InvalidUsage,
                "it has " + std::to_string(film.pixels.size()) + " pixels and says of " +
                    std::to_string(film.through.size()) + " what shows through them",
                "film");
  }
  throw Error(ErrorCode::InvalidUsage,
              "it has " + std::to_string(film.pixels.size()) + " pixels and says that it is " +
                  std::to_string(film.width) + " x " + std::to_string(film.height),
              "film");
}

Digest HashFilm(const Film& film) {
  CheckFilm(film);
  static_assert(sizeof(glm::vec4) == 4 * sizeof(float));
  Sha256 hash = BeginFilmHash(film.width, film.height);
  hash.Add(std::as_bytes(std::span(film.pixels)));
  return hash.Finish();
}

Sha256 BeginPlaneHash(const PlaneInfo& plane, int width, int height) {
  Sha256 hash;
  hash.Add("facet plane " + std::string(plane.name) + " " + std::to_string(width) + " " + std::to_string(height) + " " +
           std::to_string(plane.channels) + " " + std::string(NameOf(plane.type)) + "\n");
  return hash;
}

Digest HashPlane(const Film& film, std::size_t plane) {
  CheckFilm(film);
  if (plane >= film.planes.size()) {
    throw Error(ErrorCode::InvalidUsage,
                "plane " + std::to_string(plane) + " of a film that has " + std::to_string(film.planes.size()), "film",
                "ask for planes with RenderSettings::planes");
  }
  const auto& [kind, bytes] = film.planes[plane];
  if (std::size_t(kind) >= std::size(kPlanes)) {
    throw Error(ErrorCode::InvalidUsage, "its plane " + std::to_string(plane) + " has an unknown kind", "film");
  }
  const PlaneInfo& info = InfoOf(kind);
  if (bytes.size() != film.pixels.size() * info.PixelBytes()) {
    throw Error(ErrorCode::InvalidUsage,
                "its plane " + std::string(info.name) + " has " + std::to_string(bytes.size()) +
                    " bytes and should have " + std::to_string(film.pixels.size() * info.PixelBytes()),
                "film");
  }
  Sha256 hash = BeginPlaneHash(info, film.width, film.height);
  hash.Add(bytes);
  return hash.Finish();
}

}  // namespace facet
