// The images of the gallery. Each returns a PNG.
#pragma once

#include <cstdint>
#include <vector>

namespace facet::assets {

// Normals of metal flakes, each tilted its own way, 128 by 128 of them.
std::vector<std::uint8_t> FlakeNormal();
// Normals of lacquer that did not flow out quite level.
std::vector<std::uint8_t> OrangePeelNormal();
// Thickness (green) of a soap film that runs down: thin at the top, with swirls.
std::vector<std::uint8_t> SoapThickness();
// Paper of a lantern, one rib from top to bottom: fibres, darker at the hoops.
std::vector<std::uint8_t> PaperColor();
// Roughness (green) of metal with grooves along u.
std::vector<std::uint8_t> GrooveRoughness();

}  // namespace facet::assets
