#include "render/tile_lights.h"

#include "light/cull_lights.h"
#include "render/lit_box.h"

namespace facet {

TileLights::TileLights(const FrameView& view, const LightingData& lighting, bool cull)
    : view_(view), all_(lighting), reaching_(lighting) {
  constexpr int kFew = 4;  // lights, which are evaluated in less time than culling takes
  cull_ = cull && lighting.light_count > kFew && view.perspective;
}

const LightingData& TileLights::Reaching(const TileBuffers& tile, const TileRecords& records,
                                         const FragmentList& fragments) {
  if (!cull_ || fragments.Size() == 0) return all_;
  LitBox box(view_, tile);
  std::int32_t last_id = kNoRecord;
  for (const std::int32_t id : fragments.record) {
    if (id == last_id) continue;
    last_id = id;
    if (!box.Add(records.Record(id), records.DrawableOf(id))) return all_;
  }
  glm::dvec3 low, high;
  box.Corners(low, high);
  LightsReaching(all_, low, high, lights_);
  reaching_.lights = lights_.data();
  reaching_.light_count = static_cast<int>(lights_.size());
  return reaching_;
}

}  // namespace facet
