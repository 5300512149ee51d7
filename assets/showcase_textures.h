// The images of the showcase. Each returns a PNG.
#pragma once

#include <cstdint>
#include <vector>

namespace facet::assets {

// Glazed tiles in two colours with grout, four by four tiles in an image. Orm: occlusion, roughness, metalness.
std::vector<std::uint8_t> TileColor();
std::vector<std::uint8_t> TileNormal();
std::vector<std::uint8_t> TileOrm();
// Granite with lichen.
std::vector<std::uint8_t> StoneColor();
std::vector<std::uint8_t> StoneNormal();
std::vector<std::uint8_t> StoneOrm();
// Copper, with verdigris where water stood.
std::vector<std::uint8_t> CopperColor();
std::vector<std::uint8_t> CopperMetallicRoughness();
// Enamel paint, chipped to the metal.
std::vector<std::uint8_t> PaintColor();
std::vector<std::uint8_t> PaintMetallicRoughness();
// A pale leaf, to be tinted, with its outline in alpha; the stalk at the bottom.
std::vector<std::uint8_t> LeafColor();
// A flame from its tip (top) to its base.
std::vector<std::uint8_t> FlameEmission();

}  // namespace facet::assets
