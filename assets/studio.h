// The built-in studio environment as a file.
#pragma once

#include <filesystem>

namespace facet::assets {

// Radiance RGBE, 256 x 128, equirectangular: `--environment assets/studio.hdr` lights about as no option at all does.
void WriteStudio(const std::filesystem::path& path);

}  // namespace facet::assets
