// The studio's prepared light as the build computes it, for the options that nearly all images use.
#pragma once

#include <cstddef>
#include <cstdint>

#include "light/environment.h"
#include "light/studio.h"

namespace facet {

inline constexpr EnvironmentOptions kStudioOptions{.max_size = kStudioMaxSize};

// The bits of the red number of each of the map's texels; the studio is grey.
extern const std::uint32_t kStudioTable[];
extern const std::size_t kStudioTableSize;

}  // namespace facet
