#include "gltf/place.h"

namespace facet::gltf {

std::string Shortened(std::string_view text, std::size_t most) {
  if (text.size() <= most) return std::string(text);
  const auto continues = [&] { return (static_cast<unsigned char>(text[most]) & 0xC0) == 0x80; };
  while (most > 0 && continues()) --most;  // not within a character
  return std::string(text.substr(0, most)) + "...";
}

}  // namespace facet::gltf
