// Formats amounts of memory for messages.
#pragma once

#include <string>

namespace facet {

// "12.0 KiB", "512.0 MiB", "14901.2 GiB".
std::string BytesText(double bytes);

}  // namespace facet
