// The prefiltered studio. For the default settings it is read from a table that the build makes
// (write_studio_table.cc), because prefiltering takes longer than everything else that a small image needs.
#include <algorithm>
#include <bit>
#include <map>
#include <mutex>
#include <utility>

#include "base/check.h"
#include "light/studio.h"
#include "light/studio_table.h"

namespace facet {
namespace {

std::shared_ptr<const EnvironmentMap> FromTable() {
  auto map = std::make_shared<EnvironmentMap>();
  LayOutLevels(kStudioMaxSize, *map);
  FACET_CHECK_OP(map->texels.size(), ==, 4 * kStudioTableSize);
  for (std::size_t i = 0; i < map->texels.size(); ++i) {
    if (i % 4 < 3) map->texels[i] = std::bit_cast<float>(kStudioTable[i / 4]);
  }
  return map;
}

}  // namespace

std::shared_ptr<const EnvironmentMap> StudioEnvironment(EnvironmentOptions options) {
  options.max_size = std::min(options.max_size, kStudioMaxSize);
  static std::mutex mutex;
  static std::map<EnvironmentOptions, std::shared_ptr<const EnvironmentMap>> prepared;
  {
    const std::lock_guard<std::mutex> lock(mutex);
    if (const auto known = prepared.find(options); known != prepared.end()) return known->second;
  }
  // Prefiltered outside of the lock, which must not be held while this thread takes part in other parallel tasks. If
  // two threads do it at once, the second result is discarded.
  auto map =
      options == kStudioOptions ? FromTable() : PrefilterEnvironment(StudioImage(kStudioWidth, kStudioHeight), options);
  const std::lock_guard<std::mutex> lock(mutex);
  return prepared.try_emplace(options, std::move(map)).first->second;
}

}  // namespace facet
