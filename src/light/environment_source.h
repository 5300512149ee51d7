// A picture that lights scenes and is decoded when it is needed, with what was prepared from it earlier.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "facet/image.h"
#include "facet/settings.h"
#include "light/environment.h"

namespace facet {

// Immutable as its users see it: what Find() gives is, bit for bit, what PrefilterEnvironment() makes of Picture().
class EnvironmentSource {
 public:
  virtual ~EnvironmentSource() = default;

  // Decodes. Throws Error, as DecodeImage() does.
  virtual std::shared_ptr<const Image> Picture() const = 0;

  // What was kept for the same options; null: nothing that is whole. `admit` is called with the bytes that it takes
  // before they are taken, and may throw.
  virtual std::shared_ptr<const EnvironmentMap> Find(const EnvironmentOptions& options,
                                                     const std::function<void(std::uint64_t)>& admit) const = 0;

  // Keeps what was prepared from Picture(). A failure changes no picture: it is returned as a warning, otherwise empty.
  virtual std::string Keep(const EnvironmentOptions& options, const EnvironmentMap& map) const = 0;
};

// Of Kind::Image.
inline std::shared_ptr<const Image> PictureOf(const EnvironmentSettings& environment) {
  return environment.image != nullptr ? environment.image : environment.source->Picture();
}

}  // namespace facet
