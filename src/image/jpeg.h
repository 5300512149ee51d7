// JPEG (ITU-T T.81, T.871), by libjpeg-turbo.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "facet/image.h"
#include "image/limits.h"

namespace facet {

bool LooksLikeJpeg(std::span<const std::byte> bytes);

// See DecodeImage; gives pieces of `piece_rows` rows, the last maybe fewer. Baseline and progressive; grey, YCbCr, RGB,
// CMYK and YCCK. The accurate integer DCT and the smooth ("fancy") chroma upsampling are fixed: both give the same bits
// with and without SIMD.
void DecodeJpeg(std::span<const std::byte> bytes, const std::string& name, int piece_rows, const PieceReceiver& receive);

}  // namespace facet
