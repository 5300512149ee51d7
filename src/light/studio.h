// The studio that lights a scene when no environment is given.
#pragma once

#include <memory>

#include "facet/image.h"
#include "light/environment.h"

namespace facet {

// A neutral photographer's studio: a grey room, brighter above, with a large soft box overhead, a key light to the
// front left, a fill to the right and two strips behind for edges. No file is needed. Linear RGB, F32, equirectangular,
// mean radiance over the sphere 0.65 (white that faces the lamps comes out just below white at exposure 0). `width` is
// twice `height`.
Image StudioPicture(int width, int height);

// The size of the picture that lights scenes: nothing in the room is sharper than its pixels.
inline constexpr int kStudioWidth = 512, kStudioHeight = 256;

// The sharpest level that it is prepared with: finer ones change no picture by what one could see (docs/accuracy.md).
inline constexpr int kStudioMaxSize = 128;

// The same, prepared: for the default options by the build, else once per process and value of `options`. Thread-safe.
std::shared_ptr<const EnvironmentMap> StudioEnvironment(EnvironmentOptions options = {});

}  // namespace facet
