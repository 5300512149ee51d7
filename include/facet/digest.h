// Fingerprints: equal exactly where pictures, and what they are made from, are equal to the last bit.
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "facet/film.h"
#include "facet/image.h"
#include "facet/scene.h"

namespace facet {

// A SHA-256.
struct Digest {
  std::array<std::uint8_t, 32> bytes{};
  friend auto operator<=>(const Digest&, const Digest&) = default;
};

// 64 lower-case hexadecimal digits.
std::string ToHex(const Digest& digest);

// The inverse; none for any other text.
std::optional<Digest> ParseDigest(std::string_view hex);

// Of the line "facet film WIDTH HEIGHT\n" and the pixels: R, G, B, A as little-endian IEEE 754 floats, top row first.
Digest HashFilm(const Film& film);

// Of the line "facet image WIDTH HEIGHT CHANNELS BITS ENCODING\n" (32 bits are floats; srgb or linear) and the pixels
// as they lie in memory, little-endian, top row first.
Digest HashImage(const Image& image);

// What a rendering starts from, each apart: where two machines' pictures differ, these tell a decoder's difference from
// the renderer's. Names are not part of them: they change no picture.
struct SceneDigests {
  Digest description;  // nodes, materials, samplers, cameras, lights, skins, animations, variants
  Digest geometry;     // attributes, indices and morph targets, as decoded
  Digest textures;     // the images, as decoded; one that cannot be decoded counts as an empty one
};

// Decodes every image of the scene, in parallel.
SceneDigests HashScene(const Scene& scene);

}  // namespace facet
