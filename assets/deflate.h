// DEFLATE (RFC 1951) in a zlib wrapper (RFC 1950).
#pragma once

#include <cstdint>
#include <vector>

namespace facet::assets {

std::vector<std::uint8_t> DeflateZlib(const std::vector<std::uint8_t>& data);

}  // namespace facet::assets
