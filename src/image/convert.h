// Conversions between image formats: encoding, component type, channels.
#pragma once

#include <cstddef>

#include "facet/image.h"

namespace facet {

// Throws Error(InvalidUsage) unless sizes are positive, channels are 1 to 4 and `bytes` has the length that they say.
// `name`: of the image, for messages.
void CheckImage(const Image& image, const char* name);

// To linear light as 32-bit floats, 3 channels (grey is repeated, alpha is dropped), as environments need it.
// Components that are negative or not finite become 0, those above kMaxRadiance become kMaxRadiance; `*repaired`, if
// given, receives their number.
Image ToLinearRgb32F(const Image& image, std::size_t* repaired = nullptr);
inline constexpr float kMaxRadiance = 1.0e9f;

// To linear light as 32-bit floats, 4 channels, straight alpha. Nothing is repaired.
Image ToLinearRgba32F(const Image& image);

// To linear light as 32-bit floats with the same number of channels; alpha stays straight.
Image ToLinear32F(const Image& image);

// To another component type, U8 or U16: 16 to 8 bits rounds to nearest, 8 to 16 bits multiplies by 257, F32 is clamped
// to [0, 1] (NaN becomes 0) and rounded. The encoding does not change.
Image WithType(const Image& image, ChannelType type);

// To another number of channels, 1 to 4: grey is repeated into RGB; an opaque alpha is added, or alpha is dropped. RGB
// is not converted to grey (InvalidUsage), because the right weights depend on the use.
Image WithChannels(const Image& image, int channels);

}  // namespace facet
