// HashImage() of facet/image.h for an image that comes in bands.
#pragma once

#include "base/sha256.h"
#include "facet/image.h"

namespace facet {

// Begins the digest; the caller then adds the bytes of all rows, top row first. `form`: the size and format of the
// whole image; its bytes are not read.
Sha256 BeginImageHash(const Image& form);

}  // namespace facet
