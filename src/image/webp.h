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

// See DecodeImage: U8, RGB or RGBA with straight alpha, as it stands in the file. Of an animation, its first frame. All
// of libwebp's arithmetic is in integers, and its vector code gives the bits of its plain code.
Image DecodeWebP(std::span<const std::byte> bytes, const std::string& name);

// Without loss: the pixels come back as they are, also those under alpha 0. `image`: U8, RGB or RGBA. Throws
// Error(InvalidUsage) for more than 16383 pixels a side, which the format cannot hold.
std::vector<std::byte> EncodeWebP(const Image& image);

}  // namespace facet
