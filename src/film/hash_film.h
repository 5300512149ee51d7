// The digests of facet/film.h for a film that comes in bands: the bytes of all its rows follow, top row first.
#pragma once

#include "base/sha256.h"
#include "facet/film.h"

namespace facet {

// HashFilm()'s beginning.
Sha256 BeginFilmHash(int width, int height);

// HashPlane()'s beginning.
Sha256 BeginPlaneHash(const PlaneInfo& plane, int width, int height);

// Throws Error(InvalidUsage) unless a film has as many pixels as it says.
void CheckFilm(const Film& film);

}  // namespace facet
