// What a picture says of itself, read as `facet verify` reads it.
#pragma once

#include <string_view>

namespace facet::fuzz {

// `bytes`: a PNG or OpenEXR file.
void ReadSettingsOf(std::string_view bytes);

}  // namespace facet::fuzz
