// Verification that a picture file is still what its scene renders to.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "facet/digest.h"
#include "facet/load.h"

namespace facet {

struct VerifySettings {
  // The environment image that lit the scene. None: the file that the picture names, in the scene's folder (or anywhere
  // within load.root, if that is given).
  std::optional<std::filesystem::path> environment;
  std::optional<std::filesystem::path> materials;  // the material file, likewise
  int threads = 0;  // 0: one per core
  LoadOptions load;
};

// The result of VerifyPicture().
struct Verification {
  std::string written_by;   // the version of facet that wrote the picture
  std::string scene;        // the file name of the scene at that time
  bool intact = false;      // the picture's pixels are still those that facet wrote
  bool film_equal = false;  // the scene renders to the same film as then, bit for bit
  Digest film_before, film_now;
  std::vector<std::string> warnings;  // of loading and rendering
  std::size_t differing_pixels = 0;   // between the file and what is rendered now
  std::size_t pixels = 0;             // of the picture
  double max_difference = 0.0;        // the largest of one channel, in [0, 1]
  int max_x = 0, max_y = 0;           // the pixel where that is
  int left = 0, top = 0, right = -1,
      bottom = -1;  // the smallest rectangle, both ends included, around the differing pixels

  bool Equal() const { return intact && film_equal && differing_pixels == 0; }
};

// Renders `scene` with the settings that are stored in `picture`, a PNG or EXR file that facet wrote, and compares.
// Throws Error: NotFound; InvalidInput for a picture that facet did not write; what LoadGltf, LoadImage and Render
// throw.
Verification VerifyPicture(const std::filesystem::path& picture, const std::filesystem::path& scene,
                           const VerifySettings& settings = {});

}  // namespace facet
