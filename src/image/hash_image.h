// The digest of facet/image.h for a picture that comes in bands: the bytes of all its rows follow, top row first.
#pragma once

#include "base/sha256.h"
#include "facet/image.h"

namespace facet {

// HashImage()'s beginning. `form`: the whole picture's size and kind; its bytes are not looked at.
Sha256 BeginImageHash(const Image& form);

}  // namespace facet
