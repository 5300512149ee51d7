// WebP (RFC 9649), by libwebp.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "facet/image.h"
#include "image/file_start.h"

namespace facet {

// See ImageFormat::probe.
void ProbeWebP(const FileStart& file, ImageHeader& header);

// See DecodeImage(): U8, RGB or RGBA with straight alpha, as stored. Of an animation, the first frame. libwebp computes
// in integers only, and its vector code gives the same bits as its scalar code.
Image DecodeWebP(std::span<const std::byte> bytes, const std::string& name);

// Encodes losslessly, including the colours of pixels with alpha 0. `image`: U8, RGB or RGBA. Throws
// Error(InvalidUsage) for more than 16383 pixels a side, the limit of the format.
std::vector<std::byte> EncodeWebP(const Image& image);

}  // namespace facet
