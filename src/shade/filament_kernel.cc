// The kernel of the model "filament".
#include "material/models/models.h"
#include "shade/shade_fragments.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shade/filament_kernel.cc"
#include "hwy/foreach_target.h"
// Must come after foreach_target.h.
#include "facet/shader/dispatch.h"
#include "material/models/filament-inl.h"
#include "shade/shade_packets-inl.h"

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace HWY_NAMESPACE {

void FilamentKernel(const ShadeTask& task) {
  Surface<Float> surfaces[2];
  ShadePackets(task, ModelSeenThrough<Filament>{task}, surfaces);
}

}  // namespace HWY_NAMESPACE
}  // namespace facet
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace facet {

FACET_EXPORT(FilamentKernel);
void ShadeFilament(const ShadeTask& task) { FACET_DISPATCH(FilamentKernel)(task); }

}  // namespace facet
#endif
