// The lights of a tile: of those that end at a range, the ones that reach its fragments.
#pragma once

#include <vector>

#include "light/lighting.h"
#include "render/tile_records.h"

namespace facet {

// Not thread-safe: one per worker.
class TileLights {
 public:
  // `cull`: false where all lights are wanted in any case.
  TileLights(const FrameView& view, const LightingData& lighting, bool cull);

  // All lights where there are few, or nothing to bound the fragments with. Valid until the next call.
  const LightingData& Reaching(const TileBuffers& tile, const TileRecords& records, const FragmentList& fragments);

 private:
  const FrameView& view_;
  const LightingData& all_;
  bool cull_;
  LightingData reaching_;
  std::vector<PunctualLight> lights_;
};

}  // namespace facet
