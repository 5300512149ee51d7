// The digests of facet/film.h for a film that arrives in bands: begin with these, and add the bytes of all rows, top
// row first.
#pragma once

#include "base/sha256.h"
#include "facet/film.h"

namespace facet {

// The beginning of HashFilm().
Sha256 BeginFilmHash(int width, int height);

// The beginning of HashPlane().
Sha256 BeginPlaneHash(const PlaneInfo& plane, int width, int height);

// Throws Error(InvalidUsage) unless the film has width * height pixels.
void CheckFilm(const Film& film);

}  // namespace facet
