#include "render/check_settings.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>

#include "base/bytes_text.h"
#include "facet/error.h"
#include "facet/image.h"
#include "frame/constants.h"

namespace facet {
namespace {

void Refuse(const std::string& what, const std::string& accepted) {
  throw Error(ErrorCode::InvalidUsage, what, "render settings", accepted);
}

void CheckPlanes(const std::vector<PlaneKind>& planes) {
  for (auto plane = planes.begin(); plane != planes.end(); ++plane) {
    if (std::size_t(*plane) >= std::size(kPlanes)) {
      Refuse("a plane of kind " + std::to_string(int(*plane)),
             "0 to " + std::to_string(std::size(kPlanes) - 1) + " are accepted");
    }
    if (std::find(planes.begin(), plane, *plane) != plane) {
      Refuse("the plane " + std::string(InfoOf(*plane).name) + " is asked for twice", "name each plane once");
    }
  }
}

}  // namespace

void CheckSettings(const RenderSettings& s) {
  const auto size_ok = [](int n) { return n >= 1 && n <= kMaxImageSize; };
  if (!size_ok(s.width) || !size_ok(s.height)) {
    const double bytes = double(s.width) * s.height * sizeof(glm::vec4);
    const double most = double(kMaxImageSize) * kMaxImageSize * sizeof(glm::vec4);
    Refuse("a picture of " + std::to_string(s.width) + " x " + std::to_string(s.height) + " pixels" +
               (bytes > most && s.width > 0 ? " needs " + BytesText(bytes) : ""),
           "each side is 1 to " + std::to_string(kMaxImageSize) + ", " + BytesText(most) + " in all");
  }
  if (s.samples != 1 && s.samples != 2 && s.samples != 4 && s.samples != 8) {
    Refuse(std::to_string(s.samples) + " samples per pixel", "1, 2, 4 or 8 are accepted");
  }
  if (s.max_anisotropy < 1 || s.max_anisotropy > 16) {
    Refuse("a maximal anisotropy of " + std::to_string(s.max_anisotropy), "1 to 16 are accepted");
  }
  const int size = s.environment_size;
  if (size < 64 || size > 1024 || (size & (size - 1)) != 0) {
    Refuse("an environment of " + std::to_string(size) + " texels", "64, 128, 256, 512 or 1024 are accepted");
  }
  if (s.environment_samples < 6 || s.environment_samples > 768) {
    Refuse(std::to_string(s.environment_samples) + " samples of the environment", "6 to 768 are accepted");
  }
  if (s.tile_size != 8 && s.tile_size != 16 && s.tile_size != 32 && s.tile_size != 64) {
    Refuse("tiles of " + std::to_string(s.tile_size) + " pixels", "8, 16, 32 or 64 are accepted");
  }
  CheckPlanes(s.planes);
  if (std::isnan(s.time)) Refuse("a time that is not a number", "seconds are accepted");
  if (!std::isfinite(s.environment.rotation)) Refuse("an environment rotation that is not finite", "give radians");
  if (!(s.environment.intensity >= 0.0 && s.environment.intensity <= 1e30)) {
    Refuse("an environment intensity of " + std::to_string(s.environment.intensity), "0 to 1e30 are accepted");
  }
  if (s.environment.kind == EnvironmentSettings::Kind::Image && s.environment.image == nullptr &&
      s.environment.source == nullptr) {
    Refuse("no environment picture", "set environment.image, environment.source or another environment.kind");
  }
}

}  // namespace facet
