// Whether a frame can be rendered with these settings.
#pragma once

#include "facet/settings.h"

namespace facet {

// Throws Error(InvalidUsage), which says what is accepted, for settings that are out of range.
void CheckSettings(const RenderSettings& settings);

}  // namespace facet
