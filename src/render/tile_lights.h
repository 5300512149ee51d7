// Light culling for one tile: lights whose range ends before its fragments are skipped.
#pragma once

#include <vector>

#include "light/lighting.h"
#include "render/tile_records.h"

namespace facet {

// Not thread-safe: one per worker.
class TileLights {
 public:
  // `cull`: false to keep all lights.
  TileLights(const FrameView& view, const LightingData& lighting, bool cull);

  // The lights that reach the fragments; all, if they are few or the fragments have no bound. Valid until the next
  // call.
  const LightingData& Reaching(const TileBuffers& tile, const TileRecords& records, const FragmentList& fragments);

 private:
  const FrameView& view_;
  const LightingData& all_;
  bool cull_;
  LightingData reaching_;
  std::vector<PunctualLight> lights_;
};

}  // namespace facet
