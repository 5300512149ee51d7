// The studio: the environment that lights a scene when no other is given.
#pragma once

#include <memory>

#include "facet/image.h"
#include "light/environment.h"

namespace facet {

// A neutral photographer's studio: a grey room, brighter above, with a large soft box overhead, a key light to the
// front left, a fill to the right and two strips behind for edges. No file is needed. Linear RGB, F32, equirectangular,
// mean radiance over the sphere 0.65 (white that faces the lamps comes out just below white at exposure 0). `width` is
// twice `height`.
Image StudioImage(int width, int height);

// The size of the image that lights scenes. Nothing in the studio is sharper than one of its pixels.
inline constexpr int kStudioWidth = 512, kStudioHeight = 256;

// The size of its sharpest prefiltered level: finer ones make no visible difference (docs/accuracy.md).
inline constexpr int kStudioMaxSize = 128;

// The prefiltered studio. The build prefilters it for the default options; for others it is done once per process and
// value of `options`. Thread-safe.
std::shared_ptr<const EnvironmentMap> StudioEnvironment(EnvironmentOptions options = {});

}  // namespace facet
