#include "shade/shade_fragments.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shade/shade_fragments.cc"
#include "hwy/foreach_target.h"
// Must come after foreach_target.h.
#include "facet/shader/dispatch.h"
#include "shade/metallic_roughness-inl.h"
#include "shade/shade_packets-inl.h"

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace HWY_NAMESPACE {

void MetallicRoughnessKernel(const ShadeTask& task) { ShadePackets(task, MetallicRoughness()); }

void AlphaKernel(const ShadeTask& task) {
  const MaterialView<Float> material(*task.material);
  for (std::size_t i = 0; i < task.count; i += LaneCount()) {
    Store(material.Alpha(InterpolateSurface<Float>(task, i)), task.alpha + i);
  }
}

void BackgroundKernel(const BackgroundTask& task) {
  const LightingView<Float> lighting(*task.lighting);
  constexpr int kPixels = 16;  // at a time, whatever the lanes
  alignas(64) float direction[3][kPixels] = {}, color[3][kPixels];
  for (int x = 0; x < task.width; x += kPixels) {
    const int count = task.width - x < kPixels ? task.width - x : kPixels;
    bool any = false;
    for (int i = 0; i < count; ++i) any |= task.pixels[4 * (x + i) + 3] < 1.0f;
    if (!any) continue;
    for (int c = 0; c < 3; ++c) {
      for (int i = 0; i < count; ++i) {
        direction[c][i] = static_cast<float>((task.column[c][x + i] + task.row[c]) + task.whole[c]);
      }
    }
    for (int i = 0; i < count; i += static_cast<int>(LaneCount())) {
      const Vec3<Float> to_pixel{LoadFloat(direction[0] + i), LoadFloat(direction[1] + i), LoadFloat(direction[2] + i)};
      const Vec3<Float> seen =
          lighting.Background(NormalizeOr(to_pixel, Vec3<Float>{Float(0.0f), Float(0.0f), Float(-1.0f)}));
      Store(seen.x, color[0] + i);
      Store(seen.y, color[1] + i);
      Store(seen.z, color[2] + i);
    }
    for (int i = 0; i < count; ++i) {
      float* pixel = task.pixels + 4 * (x + i);
      const float share = 1.0f - pixel[3];
      if (!(share > 0.0f)) continue;
      for (int c = 0; c < 3; ++c) pixel[c] += color[c][i] * share;
      pixel[3] += share;
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace facet
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace facet {

FACET_EXPORT(MetallicRoughnessKernel);
FACET_EXPORT(AlphaKernel);
FACET_EXPORT(BackgroundKernel);

void ShadeMetallicRoughnessFragments(const ShadeTask& task) { FACET_DISPATCH(MetallicRoughnessKernel)(task); }
void ShadeAlpha(const ShadeTask& task) { FACET_DISPATCH(AlphaKernel)(task); }
void ShadeBackground(const BackgroundTask& task) { FACET_DISPATCH(BackgroundKernel)(task); }

}  // namespace facet
#endif
