// Which format an image file has, told by its first bytes.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

namespace facet {

struct ImageFormat {
  std::size_t at;  // where its signature stands
  std::string_view signature;
  std::string_view extension;  // by which OpenImageIO finds its reader
  std::string_view name;       // for messages
};

// Null for what is not known. Targa has no signature; it is told by `name`, a file name that ends in ".tga".
const ImageFormat* FormatOf(std::span<const std::byte> bytes, std::string_view name);

}  // namespace facet
