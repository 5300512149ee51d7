// What a picture is, told from its first bytes.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "facet/image.h"

namespace facet {

// The header of a PNG, JPEG, WebP, KTX2 or Radiance HDR file of which `bytes` are all, or the start: what is not among
// them is 0, and `ImageHeader::bytes` is the size of `bytes`. Nothing is decoded and no checksum is verified; sizes
// beyond int are 0. nullopt: another format. Takes time linear in the size of `bytes`, and throws nothing.
// Sources: ISO/IEC 15948 (PNG), ITU-T T.81 annex B (JPEG), RFC 9649 (WebP), Khronos KTX File Format Specification 2.0
// and Data Format Specification 1.3 (KTX2), G. Ward, "Real Pixels", Graphics Gems II, 1991 (Radiance).
std::optional<ImageHeader> ProbeImage(std::span<const std::byte> bytes);

}  // namespace facet
