#include "clip/small_triangles.h"

#include <algorithm>
#include <cstring>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "clip/small_triangles.cc"
#include "hwy/foreach_target.h"
// Must come after foreach_target.h.
#include "facet/shader/dispatch.h"
#include "facet/shader/lane-inl.h"
#include "frame/constants.h"

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace HWY_NAMESPACE {

static_assert(kMaxLanes <= kTriangleGroup);

// One corner of each triangle of a group.
struct CornerLanes {
  Int x, y, outcode;
  Float depth;
};

// Copied side by side and read as lanes: gathering number by number takes several times as long.
HWY_INLINE CornerLanes LoadCorners(const ScreenVertex* vertices, Int index) {
  alignas(64) std::int32_t place[kMaxLanes], numbers[4 * kMaxLanes];
  Store(index, place);
  for (std::size_t k = 0; k < LaneCount(); ++k) std::memcpy(numbers + 4 * k, vertices + place[k], sizeof(ScreenVertex));
  Int::Raw x, y, depth, outcode;
  hn::LoadInterleaved4(IntTag(), numbers, x, y, depth, outcode);
  return {x, y, outcode, FloatFromBits(depth)};
}

HWY_INLINE CornerLanes Select(Mask m, const CornerLanes& a, const CornerLanes& b) {
  return {Select(m, a.x, b.x), Select(m, a.y, b.y), a.outcode, Select(m, a.depth, b.depth)};
}

// Whether [low, high] holds at least one position of the grid pixel * 256 + [first, last].
HWY_INLINE Mask SpansSample(Int low, Int high, int first, int last) {
  const Int first_pixel = ShiftRightArithmetic<kSubpixelBits>(low + Int(kSubpixelScale - 1 - last));
  const Int last_pixel = ShiftRightArithmetic<kSubpixelBits>(high - Int(first));
  return !(first_pixel > last_pixel);
}

// Rates of depth over the screen, in double, from corners relative to the first. The same sequence as the one for
// single triangles (assemble.cc).
HWY_INLINE void DepthPlanes(const std::int32_t* x1, const std::int32_t* y1, const std::int32_t* x2,
                            const std::int32_t* y2, const std::int32_t* area, const float (*depth)[kMaxLanes],
                            double* depth_dx, double* depth_dy) {
  using D = hn::ScalableTag<double>;
  const D d;
  const auto real = [&](const std::int32_t* p) HWY_ATTR {
    return hn::PromoteTo(d, hn::LoadU(hn::Rebind<std::int32_t, D>(), p));
  };
  const auto depths = [&](const float* p) HWY_ATTR {
    return hn::PromoteTo(d, hn::LoadU(hn::Rebind<float, D>(), p));
  };
  for (std::size_t k = 0; k < LaneCount(); k += hn::Lanes(d)) {
    const auto scale = hn::Div(hn::Set(d, double{kSubpixelScale}), real(area + k));
    const auto z0 = depths(depth[0] + k);
    const auto z1 = hn::Sub(depths(depth[1] + k), z0), z2 = hn::Sub(depths(depth[2] + k), z0);
    hn::StoreU(hn::Mul(hn::Sub(hn::Mul(z1, real(y2 + k)), hn::Mul(z2, real(y1 + k))), scale), d, depth_dx + k);
    hn::StoreU(hn::Mul(hn::Sub(hn::Mul(z2, real(x1 + k)), hn::Mul(z1, real(x2 + k))), scale), d, depth_dy + k);
  }
}

SmallTriangles SetUpSmallTrianglesKernel(const TriangleRun& run, std::vector<TriangleRecord>& records) {
  const std::uint32_t lanes = static_cast<std::uint32_t>(LaneCount());
  const bool mirrored = run.drawable->mirrored, double_sided = run.drawable->double_sided;
  SmallTriangles result;
  alignas(64) std::int32_t tail[3 * kMaxLanes] = {};
  alignas(64) std::int32_t x[3][kMaxLanes], y[3][kMaxLanes], x1[kMaxLanes], y1[kMaxLanes], x2[kMaxLanes],
      y2[kMaxLanes], areas[kMaxLanes];
  alignas(64) float depth[3][kMaxLanes], nearest[kMaxLanes], farthest[kMaxLanes];
  alignas(64) double depth_dx[kMaxLanes], depth_dy[kMaxLanes];
  for (std::uint32_t i = 0; i < run.count; i += lanes) {
    const std::uint32_t n = std::min(lanes, run.count - i);
    const auto* from = reinterpret_cast<const std::int32_t*>(run.corners + std::size_t{i} * 3);
    if (n < lanes) {
      std::copy_n(from, 3 * n, tail);
      from = tail;
    }
    Int::Raw index_a, index_b, index_c;
    hn::LoadInterleaved3(IntTag(), from, index_a, index_b, index_c);
    const CornerLanes a = LoadCorners(run.vertices, index_a), second = LoadCorners(run.vertices, index_b),
                      third = LoadCorners(run.vertices, index_c);

    const Int all = a.outcode & second.outcode & third.outcode, any = a.outcode | second.outcode | third.outcode;
    const Mask present = LaneIndex() < Int(static_cast<std::int32_t>(n));
    const Mask in_view = present & (((all & Int(kOutReject)) | (any & Int(kOutNotFinite))) == Int(0));
    const Int low_x = Min(Min(a.x, second.x), third.x), high_x = Max(Max(a.x, second.x), third.x);
    const Int low_y = Min(Min(a.y, second.y), third.y), high_y = Max(Max(a.y, second.y), third.y);
    const Int most(kSmallTriangle_fx8 + 1);
    const Mask small = ((any & Int(kOutClip)) == Int(0)) & (high_x - low_x < most) & (high_y - low_y < most);
    if (Any(in_view & (!small))) break;

    const Int area = (second.x - a.x) * (third.y - a.y) - (third.x - a.x) * (second.y - a.y);
    // glTF's front faces run counter-clockwise; with y down that is a negative area.
    const Mask turned = area < Int(0), back = mirrored ? turned : area > Int(0);
    Mask seen = in_view & (!(area == Int(0))) & SpansSample(low_x, high_x, run.reach.low_x, run.reach.high_x) &
                SpansSample(low_y, high_y, run.reach.low_y, run.reach.high_y);
    if (!double_sided) seen = seen & (!back);
    std::uint32_t seen_bits = BitsOf(seen);
    const auto in_view_count = static_cast<std::uint32_t>(__builtin_popcount(BitsOf(in_view)));
    const auto seen_count = static_cast<std::uint32_t>(__builtin_popcount(seen_bits));
    result.taken += n;
    result.rejected += n - in_view_count;
    result.culled += in_view_count - seen_count;
    if (seen_bits == 0) continue;

    const CornerLanes b = Select(turned, third, second), c = Select(turned, second, third);
    const CornerLanes* corner[3] = {&a, &b, &c};
    for (int k = 0; k < 3; ++k) {
      Store(corner[k]->x, x[k]);
      Store(corner[k]->y, y[k]);
      Store(corner[k]->depth, depth[k]);
    }
    Store(b.x - a.x, x1);
    Store(b.y - a.y, y1);
    Store(c.x - a.x, x2);
    Store(c.y - a.y, y2);
    Store(Select(turned, Int(0) - area, area), areas);
    const Float low = Select(b.depth < a.depth, b.depth, a.depth), high = Select(a.depth < b.depth, b.depth, a.depth);
    Store(Select(c.depth < low, c.depth, low), farthest);
    Store(Select(high < c.depth, c.depth, high), nearest);
    DepthPlanes(x1, y1, x2, y2, areas, depth, depth_dx, depth_dy);
    const std::uint32_t back_bits = BitsOf(back);
    for (; seen_bits != 0; seen_bits &= seen_bits - 1) {
      const int k = __builtin_ctz(seen_bits);
      TriangleRecord& r = records.emplace_back();
      for (int v = 0; v < 3; ++v) r.x_fx8[v] = x[v][k], r.y_fx8[v] = y[v][k];
      r.depth_0 = double{depth[0][k]};
      r.depth_dx = depth_dx[k];
      r.depth_dy = depth_dy[k];
      r.depth_min = farthest[k];
      r.depth_max = nearest[k];
      r.drawable = run.drawable_index;
      r.primitive = run.first_primitive + i + static_cast<std::uint32_t>(k);
      r.kind = RecordKind::Triangle;
      r.back_facing = (back_bits >> k & 1) != 0;
    }
  }
  return result;
}

}  // namespace HWY_NAMESPACE
}  // namespace facet
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace facet {

FACET_EXPORT(SetUpSmallTrianglesKernel);

SmallTriangles SetUpSmallTriangles(const TriangleRun& run, std::vector<TriangleRecord>& records) {
  return FACET_DISPATCH(SetUpSmallTrianglesKernel)(run, records);
}

SampleReach ReachOf(int samples) {
  const SamplePosition* pattern = SamplePattern(samples);
  SampleReach reach{kSampleGrid, 0, kSampleGrid, 0};
  for (int s = 0; s < samples; ++s) {
    reach.low_x = std::min<int>(reach.low_x, pattern[s].x), reach.high_x = std::max<int>(reach.high_x, pattern[s].x);
    reach.low_y = std::min<int>(reach.low_y, pattern[s].y), reach.high_y = std::max<int>(reach.high_y, pattern[s].y);
  }
  constexpr int kUnit = kSubpixelScale / kSampleGrid;
  return {reach.low_x * kUnit, reach.high_x * kUnit, reach.low_y * kUnit, reach.high_y * kUnit};
}

}  // namespace facet
#endif
