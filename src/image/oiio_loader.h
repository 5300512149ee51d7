// The OpenImageIO module, opened when the first file needs it.
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

// Decodes a format that OpenImageIO knows by its extension; see DecodeImage and FormatOf. `as_stored`: colours that
// stand in the file multiplied by alpha stay so. Throws Error: MissingModule, InvalidInput, OutOfMemory, Unsupported.
Image DecodeWithOiio(std::span<const std::byte> bytes, std::string_view extension, const std::string& name,
                     bool as_stored = false);

// A whole file of the format that `extension`, without its dot, names. `premultiplied`: the image's alpha is
// associated. `text`: keywords and values, for formats that hold such. Throws Error: MissingModule, OutputFailed.
std::vector<std::byte> EncodeWithOiio(const std::string& extension, const Image& image, bool premultiplied,
                                      const std::vector<std::array<std::string, 2>>& text = {});

// Where the module is looked for, in order: the folders of the environment variable FACET_MODULE_PATH, that of the
// program, the build tree, and the installed ones beside the program. The last entry has no folder: the system's
// search path.
std::vector<std::filesystem::path> OiioModuleCandidates();

// For tests: while `folders` is given, they alone are searched, and a module that is open already is not used.
void OverrideOiioSearch(const std::vector<std::filesystem::path>* folders);

}  // namespace facet
