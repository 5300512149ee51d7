// Is this picture still what its scene gives?
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
  // The picture that lit the scene. None: the file of the name that the picture gives, in the scene's folder (or, where
  // load.root is given, anywhere within that).
  std::optional<std::filesystem::path> environment;
  int threads = 0;  // 0: one per core
  LoadOptions load;
};

// What VerifyPicture() finds.
struct Verification {
  std::string written_by;   // the version of facet that wrote the picture
  std::string scene;        // the name of the scene's file at that time
  bool intact = false;      // the file's pixels are those that facet wrote
  bool film_equal = false;  // the scene gives the film that it gave then, to the last bit
  Digest film_before, film_now;
  std::vector<std::string> warnings;  // of loading and rendering
  std::size_t differing_pixels = 0;   // of the file, against those rendered now
  std::size_t pixels = 0;             // in all
  double max_difference = 0.0;        // of one channel, in [0, 1]
  int max_x = 0, max_y = 0;           // where that is
  int left = 0, top = 0, right = -1,
      bottom = -1;  // the smallest rectangle, both ends included, around the differing pixels

  bool Equal() const { return intact && film_equal && differing_pixels == 0; }
};

// Renders `scene` with the settings that stand in `picture`, a PNG or EXR file that facet wrote, and compares.
// Throws Error: NotFound; InvalidInput for a picture that facet did not write; what LoadGltf, LoadImage and Render
// throw.
Verification VerifyPicture(const std::filesystem::path& picture, const std::filesystem::path& scene,
                           const VerifySettings& settings = {});

}  // namespace facet
