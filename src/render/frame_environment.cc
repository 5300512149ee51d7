#include "render/frame_environment.h"

#include <string>
#include <utility>
#include <vector>

#include "light/environment_source.h"
#include "light/studio.h"

namespace facet {
namespace {

// Charges the environment's image, its copies in linear light, and its prefiltered maps.
void Charge(const Image& image, const EnvironmentOptions& options, MemoryBudget& budget) {
  const auto size = std::size_t(SharpestLevelSize(image.width, options.max_size));
  const std::size_t floats = image.PixelCount() * (options.keep_image ? 2 : 1) + 3 * size * size;
  budget.Charge(image.bytes.size() + floats * 4 * sizeof(float), 1,
                "an environment of " + std::to_string(image.width) + " x " + std::to_string(image.height) + " pixels",
                {}, "scale it down");
}

std::size_t BytesOf(const EnvironmentMap& map) { return (map.texels.size() + map.image.size()) * sizeof(float); }

constexpr const char* kPrepared = "a prepared environment";

void ChargePrepared(std::uint64_t bytes, MemoryBudget& budget) {
  budget.Charge(bytes, 1, kPrepared, {}, "scale its picture down");
}

std::shared_ptr<const EnvironmentMap> FromSource(const EnvironmentSource& source, const EnvironmentOptions& options,
                                                 MemoryBudget& budget, std::vector<std::string>& warnings) {
  std::uint64_t admitted = 0;
  if (auto kept = source.Find(options, [&](std::uint64_t bytes) { ChargePrepared(admitted = bytes, budget); }))
    return kept;
  budget.Release(admitted, kPrepared);  // a cached map that was read but is not usable has been freed
  const auto image = source.Decode();
  Charge(*image, options, budget);
  auto map = PrefilterEnvironment(*image, options);
  const std::string warning = source.Keep(options, *map);
  if (!warning.empty()) warnings.push_back(warning);
  return map;
}

}  // namespace

const EnvironmentMap* FrameEnvironment::Prepare(const FramePlan& plan, const RenderSettings& settings,
                                                MemoryBudget& budget, RenderStats& stats) {
  if (!plan.environment_light && !plan.environment_background) return nullptr;
  const EnvironmentOptions options{plan.environment_background, settings.environment_size, settings.environment_samples,
                                   settings.irradiance};
  const bool is_image = settings.environment.kind == EnvironmentSettings::Kind::Image;  // otherwise the studio
  const auto image = is_image ? settings.environment.image : nullptr;
  const auto source = is_image && image == nullptr ? settings.environment.source : nullptr;
  const bool known = map_ != nullptr && options == options_ && image == image_ && source == source_;
  if (image != nullptr) Charge(*image, options, budget);
  if (known && source != nullptr) ChargePrepared(BytesOf(*map_), budget);
  if (!known) {
    map_ = image != nullptr    ? PrefilterEnvironment(*image, options)
           : source != nullptr ? FromSource(*source, options, budget, stats.warnings)
                               : StudioEnvironment(options);
    options_ = options;
    image_ = image;
    source_ = source;
  }
  stats.environment_bytes = BytesOf(*map_);
  stats.environment_size = map_->levels[0].size;
  if (image != nullptr && !image->damage.empty()) stats.warnings.push_back("environment: " + image->damage);
  if (map_->repaired_values > 0) {
    stats.warnings.push_back("environment: " + std::to_string(map_->repaired_values) +
                             " values were not finite, negative or too large, and were replaced");
  }
  return map_.get();
}

}  // namespace facet
