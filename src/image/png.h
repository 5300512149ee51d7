// Portable Network Graphics (ISO/IEC 15948:2004), by libpng. Writing is declared in codec.h.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "facet/image.h"

namespace facet {

bool LooksLikePng(std::span<const std::byte> bytes);

// See DecodeImage. The whole file must be there and every checksum right.
Image DecodePng(std::span<const std::byte> bytes, const std::string& name);

}  // namespace facet
