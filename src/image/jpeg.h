// JPEG (ITU-T T.81, T.871), by libjpeg-turbo.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "facet/image.h"

namespace facet {

bool LooksLikeJpeg(std::span<const std::byte> bytes);

// See DecodeImage. Baseline and progressive; grey, YCbCr, RGB, CMYK and YCCK. The accurate integer DCT and the smooth
// ("fancy") chroma upsampling are fixed: both give the same bits with and without SIMD.
Image DecodeJpeg(std::span<const std::byte> bytes, const std::string& name);

}  // namespace facet
