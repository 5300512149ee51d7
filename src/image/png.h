// Portable Network Graphics (ISO/IEC 15948:2004), by libpng. Writing is declared in codec.h.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "facet/image.h"
#include "image/limits.h"

namespace facet {

bool LooksLikePng(std::span<const std::byte> bytes);

// See DecodeImage; gives pieces of `piece_rows` rows, the last maybe fewer. The whole file must be there and every
// checksum right.
void DecodePng(std::span<const std::byte> bytes, const std::string& name, int piece_rows, const PieceReceiver& receive);

}  // namespace facet
