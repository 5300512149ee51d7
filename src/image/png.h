// Portable Network Graphics (ISO/IEC 15948:2004), by libpng. Writing is declared in codec.h.
#pragma once

#include <cstddef>
#include <map>
#include <span>
#include <string>

#include "facet/image.h"
#include "image/file_start.h"
#include "image/limits.h"

namespace facet {

// See ImageFormat::probe.
void ProbePng(const FileStart& file, ImageHeader& header);

// See DecodeImage(); gives pieces of `piece_rows` rows, of which the last may have fewer. All pixels must be there, and
// the checksums of all chunks that they depend on must be right; other damage is reported as Image::damage of the last
// piece.
void DecodePng(std::span<const std::byte> bytes, const std::string& name, int piece_rows, const PieceReceiver& receive);

// See ReadImageText.
std::map<std::string, std::string> ReadPngText(std::span<const std::byte> bytes, const std::string& name);

}  // namespace facet
