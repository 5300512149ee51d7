// The OpenImageIO module, opened when the first file needs it.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "facet/image.h"

namespace facet {

// Decodes any format that OpenImageIO knows; see DecodeImage. Throws Error: MissingModule, InvalidInput, OutOfMemory,
// Unsupported.
Image DecodeWithOiio(std::span<const std::byte> bytes, const std::string& name);

// Writes a file whole or leaves a broken one (the caller writes to a temporary name). `premultiplied`: the picture's
// alpha is associated. Throws Error: MissingModule, OutputFailed.
void EncodeWithOiio(const std::filesystem::path& path, const Image& image, bool premultiplied);

// Opens the module now. Throws Error(MissingModule).
void RequireOiio();

// Where the module is looked for, in order: the folders of the environment variable FACET_MODULE_PATH, that of the
// program, the build tree, and the installed ones beside the program. The last entry has no folder: the system's
// search path.
std::vector<std::filesystem::path> OiioModuleCandidates();

// For tests: while `folders` is given, they alone are searched, and a module that is open already is not used.
void OverrideOiioSearch(const std::vector<std::filesystem::path>* folders);

}  // namespace facet
