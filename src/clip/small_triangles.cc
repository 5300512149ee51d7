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
#include "frame/edge_function-inl.h"

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace HWY_NAMESPACE {

static_assert(kMaxLanes <= kTriangleGroup);

// One vertex of each triangle of a group.
struct CornerLanes {
  Int x, y, outcode;
  Float depth;
};

// Copies whole vertices to adjacent memory and transposes them, because gathers of single components take several times
// as long.
FACET_INLINE CornerLanes LoadCorners(const ScreenVertex* vertices, Int index) {
  alignas(64) std::int32_t place[kMaxLanes], numbers[4 * kMaxLanes];
  Store(index, place);
  for (std::size_t k = 0; k < LaneCount(); ++k) std::memcpy(numbers + 4 * k, vertices + place[k], sizeof(ScreenVertex));
  Int::Raw x, y, depth, outcode;
  hn::LoadInterleaved4(IntTag(), numbers, x, y, depth, outcode);
  return {x, y, outcode, FloatFromBits(depth)};
}

FACET_INLINE CornerLanes Select(Mask m, const CornerLanes& a, const CornerLanes& b) {
  return {Select(m, a.x, b.x), Select(m, a.y, b.y), a.outcode, Select(m, a.depth, b.depth)};
}

// The samples of the CoverageSquare from (first_x, first_y) on that triangles cover, by the rasterizer's edge functions
// and fill rule, as bits of ScreenTriangle::covered. Corners are clockwise and less than 4 pixels apart, so that every
// term is below 2^22. (Lanes with other triangles overflow, and their results are not used.)
FACET_INLINE Int CoveredSamples(const Int (&x_fx8)[3], const Int (&y_fx8)[3], Int first_x, Int first_y, int samples) {
  const Int x0 = ShiftLeft<kSubpixelBits>(first_x), y0 = ShiftLeft<kSubpixelBits>(first_y);
  EdgeFunction<Int> edge[3];  // from the square's corner
  Int right[3], down[3];
  for (int i = 0; i < 3; ++i) {
    const int j = i == 2 ? 0 : i + 1;
    edge[i] = MakeEdgeFunction(x_fx8[i] - x0, y_fx8[i] - y0, x_fx8[j] - x0, y_fx8[j] - y0);
    right[i] = ShiftLeft<kSubpixelBits>(edge[i].a), down[i] = ShiftLeft<kSubpixelBits>(edge[i].b);
  }
  const CoverageSquare square = CoverageSquareOf(samples);
  Int covered(0);
  const SamplePosition* pattern = SamplePattern(samples);
  for (int s = 0; s < samples; ++s) {
    constexpr int kUnit = kSubpixelScale / kSampleGrid;
    Int row[3];
    for (int i = 0; i < 3; ++i) {
      row[i] = edge[i].c + edge[i].a * Int(pattern[s].x * kUnit) + edge[i].b * Int(pattern[s].y * kUnit);
    }
    for (int y = 0; y < square.side; ++y) {
      Int e[3] = {row[0], row[1], row[2]};
      for (int x = 0; x < square.side; ++x) {
        const std::uint32_t bit = 1u << (((y << square.stride_bits) + x) * samples + s);
        covered = covered | Select(IsCovered(e[0], e[1], e[2]), Int(static_cast<std::int32_t>(bit)), Int(0));
        for (int i = 0; i < 3; ++i) e[i] = e[i] + right[i];
      }
      for (int i = 0; i < 3; ++i) row[i] = row[i] + down[i];
    }
  }
  return covered;
}

struct BoxLanes {
  Int low_x, high_x, low_y, high_y;
  FACET_INLINE BoxLanes(const Int (&x)[3], const Int (&y)[3])
      : low_x(Min(Min(x[0], x[1]), x[2])),
        high_x(Max(Max(x[0], x[1]), x[2])),
        low_y(Min(Min(y[0], y[1]), y[2])),
        high_y(Max(Max(y[0], y[1]), y[2])) {}
};

// The SampleCoverage of the lanes in `asked`; none for the others.
struct CoverageLanes {
  Mask some;
  Int covered;
};

FACET_INLINE CoverageLanes FindCoverage(const Int (&x_fx8)[3], const Int (&y_fx8)[3], const BoxLanes& box, int samples,
                                        Mask asked) {
  const auto first = [](Int low, int high) HWY_ATTR {  // FirstPixel()
    return ShiftRightArithmetic<kSubpixelBits>(low + Int(kSubpixelScale - 1 - high));
  };
  const auto last = [](Int high, int low) HWY_ATTR { return ShiftRightArithmetic<kSubpixelBits>(high - Int(low)); };
  const SampleReach reach = ReachOf(samples);
  const Int first_x = first(box.low_x, reach.high_x), last_x = last(box.high_x, reach.low_x);
  const Int first_y = first(box.low_y, reach.high_y), last_y = last(box.high_y, reach.low_y);
  const Mask some = asked & !((first_x > last_x) | (first_y > last_y));
  const Int side(CoverageSquareOf(samples).side);
  const Mask few = some & (last_x - first_x < side) & (last_y - first_y < side);
  if (!Any(few)) return {some, Int(0)};
  const Int covered = Select(few, CoveredSamples(x_fx8, y_fx8, first_x, first_y, samples), Int(0));
  return {some & !(few & (covered == Int(0))), covered};
}

// Depth gradients over the screen, in double, from corners relative to the first. The operations are the same, in the
// same order, as those for single triangles (assemble.cc).
FACET_INLINE void DepthPlanes(const std::int32_t* x1, const std::int32_t* y1, const std::int32_t* x2,
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

SmallTriangles SetUpSmallTrianglesKernel(const TriangleRun& run, std::vector<ScreenTriangle>& records) {
  const std::uint32_t lanes = static_cast<std::uint32_t>(LaneCount());
  const bool mirrored = run.drawable->mirrored, double_sided = run.drawable->double_sided;
  SmallTriangles result;
  alignas(64) std::int32_t tail[3 * kMaxLanes] = {};
  alignas(64) std::int32_t x[3][kMaxLanes], y[3][kMaxLanes], x1[kMaxLanes], y1[kMaxLanes], x2[kMaxLanes], y2[kMaxLanes],
      areas[kMaxLanes], covered[kMaxLanes];
  alignas(64) float depth[3][kMaxLanes], max_depth[kMaxLanes], min_depth[kMaxLanes];
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
    const BoxLanes box({a.x, second.x, third.x}, {a.y, second.y, third.y});
    const Int most(kSmallTriangle_fx8 + 1);
    const Mask small =
        ((any & Int(kOutClip)) == Int(0)) & (box.high_x - box.low_x < most) & (box.high_y - box.low_y < most);
    if (Any(in_view & (!small))) break;

    const Int area = (second.x - a.x) * (third.y - a.y) - (third.x - a.x) * (second.y - a.y);
    // glTF's front faces run counter-clockwise; with y down that is a negative area.
    const Mask turned = area < Int(0), back = mirrored ? turned : area > Int(0);
    const CornerLanes b = Select(turned, third, second), c = Select(turned, second, third);
    Mask seen = in_view & (!(area == Int(0)));
    if (!double_sided) seen = seen & (!back);
    const CoverageLanes coverage = FindCoverage({a.x, b.x, c.x}, {a.y, b.y, c.y}, box, run.samples, seen);
    seen = coverage.some;
    std::uint32_t seen_bits = BitsOf(seen);
    const auto in_view_count = static_cast<std::uint32_t>(__builtin_popcount(BitsOf(in_view)));
    const auto seen_count = static_cast<std::uint32_t>(__builtin_popcount(seen_bits));
    result.taken += n;
    result.rejected += n - in_view_count;
    result.culled += in_view_count - seen_count;
    if (seen_bits == 0) continue;

    const CornerLanes* corner[3] = {&a, &b, &c};
    for (int k = 0; k < 3; ++k) {
      Store(corner[k]->x, x[k]);
      Store(corner[k]->y, y[k]);
      Store(corner[k]->depth, depth[k]);
    }
    Store(coverage.covered, covered);
    Store(b.x - a.x, x1);
    Store(b.y - a.y, y1);
    Store(c.x - a.x, x2);
    Store(c.y - a.y, y2);
    Store(Select(turned, Int(0) - area, area), areas);
    const Float low = Select(b.depth < a.depth, b.depth, a.depth), high = Select(a.depth < b.depth, b.depth, a.depth);
    Store(Select(c.depth < low, c.depth, low), min_depth);
    Store(Select(high < c.depth, c.depth, high), max_depth);
    DepthPlanes(x1, y1, x2, y2, areas, depth, depth_dx, depth_dy);
    const std::uint32_t back_bits = BitsOf(back);
    for (; seen_bits != 0; seen_bits &= seen_bits - 1) {
      const int k = __builtin_ctz(seen_bits);
      ScreenTriangle& r = records.emplace_back();
      for (int v = 0; v < 3; ++v) r.x_fx8[v] = x[v][k], r.y_fx8[v] = y[v][k];
      r.depth_0 = double{depth[0][k]};
      r.depth_dx = depth_dx[k];
      r.depth_dy = depth_dy[k];
      r.depth_min = min_depth[k];
      r.depth_max = max_depth[k];
      r.drawable = run.drawable_index;
      r.primitive = run.first_primitive + i + static_cast<std::uint32_t>(k);
      r.kind = ScreenTriangleKind::Triangle;
      r.back_facing = (back_bits >> k & 1) != 0;
      r.covered = static_cast<std::uint32_t>(covered[k]);
    }
  }
  return result;
}

SampleCoverage CoverageKernel(const std::int32_t (&x_fx8)[3], const std::int32_t (&y_fx8)[3], int samples) {
  const Int x[3] = {Int(x_fx8[0]), Int(x_fx8[1]), Int(x_fx8[2])}, y[3] = {Int(y_fx8[0]), Int(y_fx8[1]), Int(y_fx8[2])};
  const CoverageLanes lanes = FindCoverage(x, y, BoxLanes(x, y), samples, Mask(true));
  alignas(64) std::int32_t covered[kMaxLanes];
  Store(lanes.covered, covered);
  return {Any(lanes.some), static_cast<std::uint32_t>(covered[0])};
}

}  // namespace HWY_NAMESPACE
}  // namespace facet
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace facet {

FACET_EXPORT(SetUpSmallTrianglesKernel);
FACET_EXPORT(CoverageKernel);

SmallTriangles SetUpSmallTriangles(const TriangleRun& run, std::vector<ScreenTriangle>& records) {
  return FACET_DISPATCH(SetUpSmallTrianglesKernel)(run, records);
}

SampleCoverage CoverageOf(const std::int32_t (&x_fx8)[3], const std::int32_t (&y_fx8)[3], int samples) {
  return FACET_DISPATCH(CoverageKernel)(x_fx8, y_fx8, samples);
}

}  // namespace facet
#endif
