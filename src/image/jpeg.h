// JPEG (ITU-T T.81, T.871), by libjpeg-turbo.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "facet/image.h"
#include "image/file_start.h"
#include "image/limits.h"

namespace facet {

// See ImageFormat::probe.
void ProbeJpeg(const FileStart& file, ImageHeader& header);

// See DecodeImage(); gives pieces of `piece_rows` rows, of which the last may have fewer. Baseline and progressive;
// grey, YCbCr, RGB, CMYK and YCCK. Always uses the accurate integer DCT and the smooth ("fancy") chroma upsampling,
// which give the same bits with and without SIMD. A missing end marker is reported as Image::damage if no coefficient
// is missing.
void DecodeJpeg(std::span<const std::byte> bytes, const std::string& name, int piece_rows,
                const PieceReceiver& receive);

// Encodes as baseline JPEG of quality 95, with chroma at half the resolution. `image`: U8, grey or RGB. Throws Error:
// InvalidUsage for more than 65500 pixels a side, OutOfMemory.
std::vector<std::byte> EncodeJpeg(const Image& image);

}  // namespace facet
