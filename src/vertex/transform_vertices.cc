#include "vertex/transform_vertices.h"

#include <algorithm>
#include <cstring>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "vertex/transform_vertices.cc"
#include "hwy/foreach_target.h"
// Must come after foreach_target.h.
#include "facet/shader/dispatch.h"
#include "facet/shader/lane-inl.h"
#include "frame/constants.h"
#include "math/round_to_float.h"

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace HWY_NAMESPACE {

void TransformVerticesKernel(const FrameView& view, const FrameDrawable& drawable, std::size_t begin, std::size_t end,
                             ScreenVertex* out) {
  const float* positions = &drawable.geometry->positions[0].x;
  const std::size_t lanes = LaneCount();
  const glm::vec4 rx = drawable.screen_from_local[0], ry = drawable.screen_from_local[1],
                  rd = drawable.screen_from_local[2];
  const glm::vec3 c = drawable.centre_mesh;
  const Float width(static_cast<float>(view.width)), height(static_cast<float>(view.height));
  const Float near_distance(RoundToFloat(view.near_distance));
  const Float far_distance(RoundToFloat(view.far_distance));
  const Float guard_left(static_cast<float>(view.width) * 0.5f - static_cast<float>(kGuardBand));
  const Float guard_right(static_cast<float>(view.width) * 0.5f + static_cast<float>(kGuardBand));
  const Float guard_top(static_cast<float>(view.height) * 0.5f - static_cast<float>(kGuardBand));
  const Float guard_bottom(static_cast<float>(view.height) * 0.5f + static_cast<float>(kGuardBand));
  // Vertices that will be clipped have no screen position; clamping keeps their conversion to integers defined.
  const Float limit(static_cast<float>(4 * kGuardBand * kSubpixelScale));

  alignas(64) float tail[3 * kMaxLanes] = {};
  alignas(64) std::int32_t screen[4 * kMaxLanes];
  static_assert(sizeof(ScreenVertex) == 4 * sizeof(std::int32_t));
  for (std::size_t i = begin; i < end; i += lanes) {
    const std::size_t count = std::min(lanes, end - i);
    const float* from = positions + 3 * i;
    if (count < lanes) {
      std::copy_n(from, 3 * count, tail);
      from = tail;
    }
    Float::Raw raw_x, raw_y, raw_z;
    hn::LoadInterleaved3(FloatTag(), from, raw_x, raw_y, raw_z);
    const Float px = Float(raw_x) - Float(c.x), py = Float(raw_y) - Float(c.y), pz = Float(raw_z) - Float(c.z);
    const auto row = [&](const glm::vec4& r) HWY_ATTR {
      return ((Float(r.x) * px + Float(r.y) * py) + Float(r.z) * pz) + Float(r.w);
    };
    const Float x = row(rx), y = row(ry), distance = row(rd);
    const Float w = view.perspective ? distance : Float(1.0f);

    Int code(0);
    const auto flag = [&](Mask inside, OutcodeBit bit) HWY_ATTR { code = code | Select(inside, Int(0), Int(bit)); };
    flag(distance >= near_distance, kOutNear);
    flag(distance <= far_distance, kOutFar);
    flag(x >= guard_left * w, kOutGuardLeft);
    flag(x <= guard_right * w, kOutGuardRight);
    flag(y >= guard_top * w, kOutGuardTop);
    flag(y <= guard_bottom * w, kOutGuardBottom);
    flag(x >= Float(0.0f), kOutLeft);
    flag(x <= width * w, kOutRight);
    flag(y >= Float(0.0f), kOutTop);
    flag(y <= height * w, kOutBottom);
    flag(IsFinite(x) & IsFinite(y) & IsFinite(distance), kOutNotFinite);

    const Float scale(static_cast<float>(kSubpixelScale));
    const Float sx = Clamp(RoundEven(x / w * scale), -limit, limit);
    const Float sy = Clamp(RoundEven(y / w * scale), -limit, limit);
    const Float depth = view.perspective ? Float(1.0f) / distance : -distance;
    hn::StoreInterleaved4(TruncateToInt(Select(sx == sx, sx, Float(0.0f))).raw,
                          TruncateToInt(Select(sy == sy, sy, Float(0.0f))).raw, BitsOf(depth).raw, code.raw, IntTag(),
                          screen);
    std::memcpy(out + i, screen, count * sizeof(ScreenVertex));
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace facet
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace facet {

FACET_EXPORT(TransformVerticesKernel);

void TransformVertices(const FrameView& view, const FrameDrawable& drawable, std::size_t begin, std::size_t end,
                       VertexBuffer& out) {
  if (begin == end) return;
  FACET_DISPATCH(TransformVerticesKernel)(view, drawable, begin, end, out.data() + drawable.vertex_base);
}

}  // namespace facet
#endif
