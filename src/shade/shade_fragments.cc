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
  for (std::size_t i = 0; i < task.count; i += LaneCount()) {
    const Vec3<Float> to_pixel{LoadFloat(task.x + i), LoadFloat(task.y + i), LoadFloat(task.z + i)};
    const Vec3<Float> c =
        lighting.Background(NormalizeOr(to_pixel, Vec3<Float>{Float(0.0f), Float(0.0f), Float(-1.0f)}));
    Store(c.x, task.red + i);
    Store(c.y, task.green + i);
    Store(c.z, task.blue + i);
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
