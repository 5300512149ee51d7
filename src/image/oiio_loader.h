// The OpenImageIO module, which is loaded when a file first needs it.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "facet/image.h"

namespace facet {

// Decodes a format that OpenImageIO knows by its extension; see DecodeImage() and FormatOf(). `as_stored`: colours that
// are stored premultiplied by alpha stay premultiplied. Throws Error: MissingModule, InvalidInput, OutOfMemory,
// Unsupported.
Image DecodeWithOiio(std::span<const std::byte> bytes, std::string_view extension, const std::string& name,
                     bool as_stored = false);

// Encodes a file in the format that `extension`, without its dot, names. `premultiplied`: the image's alpha is
// associated. `text`: keywords and values, for formats that store them. Throws Error: MissingModule, OutputFailed.
std::vector<std::byte> EncodeWithOiio(const std::string& extension, const Image& image, bool premultiplied,
                                      const std::vector<std::array<std::string, 2>>& text = {});

// The paths where the module is searched, in order: the folders of the environment variable FACET_MODULE_PATH, the
// program's folder, the build tree, and the installation folders beside the program. The last entry has no folder,
// which stands for the system's search path.
std::vector<std::filesystem::path> OiioModuleCandidates();

// For tests: while `folders` is set, only these are searched, and a module that was loaded before is not used.
void OverrideOiioSearch(const std::vector<std::filesystem::path>* folders);

}  // namespace facet
