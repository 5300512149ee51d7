// Radiance HDR files (.hdr, .pic).
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "facet/image.h"
#include "image/file_start.h"

namespace facet {

// See ImageFormat::probe.
void ProbeRadiance(const FileStart& file, ImageHeader& header);

// See DecodeImage: F32, 3 channels, linear. RGBE in any of the three packings (flat, old and new run lengths), rows in
// either direction; XYZE and images stored by columns are Unsupported. A component is exactly mantissa * 2^(exponent -
// 136); EXPOSURE lines are ignored, as all other readers do. Source: Ward, "Real Pixels", Graphics Gems II, 1991; and
// the format's description in the Radiance file formats paper.
Image DecodeRadiance(std::span<const std::byte> bytes, const std::string& name);

}  // namespace facet
