// The header of OpenEXR files.
#pragma once

#include <cstddef>
#include <map>
#include <span>
#include <string>

namespace facet {

// Its attributes of type string, by name; see ReadImageText. Of a file with several parts, those of the first.
// Source: OpenEXR, "The OpenEXR File Layout", section "Header". Throws Error(InvalidInput) where it is cut off.
std::map<std::string, std::string> ReadExrText(std::span<const std::byte> bytes, const std::string& name);

// OpenEXR makes room for what a header's numbers say before it looks for it in the file: this refuses those that cannot
// be right. Throws Error: InvalidInput where attributes reach beyond the file, or where they do not hold what they say;
// OutOfMemory for a picture beyond the limits of image/codec.h.
void CheckExrHeader(std::span<const std::byte> bytes, const std::string& name);

}  // namespace facet
