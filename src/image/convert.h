// Conversions between the forms that a picture can have.
#pragma once

#include <cstddef>

#include "facet/image.h"

namespace facet {

// Throws Error(InvalidUsage) unless sizes are positive, channels are 1 to 4 and `bytes` has the length that they say.
// `name` is what the message calls the picture.
void CheckImage(const Image& image, const char* name);

// Linear light as 32-bit floats, 3 channels (grey is repeated, alpha is left out): what an environment needs. Numbers
// that are not finite or below zero become 0, those above kMaxRadiance become kMaxRadiance; `*repaired`, when given,
// receives how many they were.
Image ToLinearRgb32F(const Image& image, std::size_t* repaired = nullptr);
inline constexpr float kMaxRadiance = 1.0e9f;

// Linear light as 32-bit floats with straight alpha, 4 channels; nothing is repaired.
Image ToLinearRgba32F(const Image& image);

// Linear light as 32-bit floats, the same number of channels; alpha is straight as before.
Image ToLinear32F(const Image& image);

// The same numbers with another depth, U8 or U16: 16 -> 8 bits rounds to nearest, 8 -> 16 multiplies by 257, F32 is
// clamped to [0, 1] (NaN becomes 0) and rounded. The encoding stays.
Image WithType(const Image& image, ChannelType type);

// The same picture with 1 to 4 channels: grey is repeated into RGB, alpha is added opaque or left out. RGB to grey is
// not offered (InvalidUsage): which grey would depend on the use.
Image WithChannels(const Image& image, int channels);

}  // namespace facet
