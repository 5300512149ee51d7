// An environment image that is decoded when it is needed, with a store of the maps that were prefiltered from it.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "facet/image.h"
#include "facet/settings.h"
#include "light/environment.h"

namespace facet {

// Behaves as if it were immutable: Find() returns, bit for bit, what PrefilterEnvironment() computes from Decode().
class EnvironmentSource {
 public:
  virtual ~EnvironmentSource() = default;

  // Decodes the image. Throws Error, as DecodeImage() does.
  virtual std::shared_ptr<const Image> Decode() const = 0;

  // The maps that are stored for these options; null if there are none, or if they are damaged. Calls `admit` with the
  // number of bytes that they take before allocating them; it may throw.
  virtual std::shared_ptr<const EnvironmentMap> Find(const EnvironmentOptions& options,
                                                     const std::function<void(std::uint64_t)>& admit) const = 0;

  // Stores maps that were prefiltered from Decode(). A failure is returned as a warning, since it does not affect the
  // frame; otherwise the text is empty.
  virtual std::string Keep(const EnvironmentOptions& options, const EnvironmentMap& map) const = 0;
};

// The environment's image, decoded if need be. For EnvironmentSettings::Kind::Image.
inline std::shared_ptr<const Image> ImageOf(const EnvironmentSettings& environment) {
  return environment.image != nullptr ? environment.image : environment.source->Decode();
}

}  // namespace facet
