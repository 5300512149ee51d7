// The text in PNG and OpenEXR files.
#include "fuzz/fuzz.h"
#include "fuzz/provenance.h"

namespace facet::fuzz {

void Run(std::span<const std::byte> input) { ReadSettingsOf(AsText(input)); }

}  // namespace facet::fuzz
