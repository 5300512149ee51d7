// Digests of films, images and scenes: equal exactly if these are equal, bit for bit.
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

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

}  // namespace facet
