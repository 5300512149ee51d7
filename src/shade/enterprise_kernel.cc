// The kernel of the model "enterprise".
#include "material/models/models.h"
#include "shade/shade_fragments.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shade/enterprise_kernel.cc"
#include "hwy/foreach_target.h"
// Must come after foreach_target.h.
#include "facet/shader/dispatch.h"
#include "material/models/enterprise-inl.h"
#include "shade/shade_packets-inl.h"

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace HWY_NAMESPACE {

void EnterpriseKernel(const ShadeTask& task) {
  Surface<Float> surfaces[2];
  ShadePackets(task, ModelSeenThrough<Enterprise>{task}, surfaces);
}

}  // namespace HWY_NAMESPACE
}  // namespace facet
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace facet {

FACET_EXPORT(EnterpriseKernel);
void ShadeEnterprise(const ShadeTask& task) { FACET_DISPATCH(EnterpriseKernel)(task); }

}  // namespace facet
#endif
