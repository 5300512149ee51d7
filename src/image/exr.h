// The header of OpenEXR files.
#pragma once

#include <cstddef>
#include <map>
#include <span>
#include <string>

namespace facet {

// Reads the header's attributes of type string, by name; see ReadImageText(). Of several parts, only the first is read.
// Source: OpenEXR, "The OpenEXR File Layout", section "Header". Throws Error(InvalidInput) where it is cut off.
std::map<std::string, std::string> ReadExrText(std::span<const std::byte> bytes, const std::string& name);

// Refuses headers whose sizes cannot be right, because OpenEXR allocates memory by them before it reads the data.
// Throws Error: InvalidInput if attributes reach beyond the file or contradict themselves, OutOfMemory for an image
// beyond the limits of image/codec.h.
void CheckExrHeader(std::span<const std::byte> bytes, const std::string& name);

}  // namespace facet
