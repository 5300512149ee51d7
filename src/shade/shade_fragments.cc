#include "shade/shade_fragments.h"

#include <algorithm>
#include <iterator>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shade/shade_fragments.cc"
#include "hwy/foreach_target.h"
// Must come after foreach_target.h.
#include "facet/shader/dispatch.h"
#include "material/models/all-inl.h"
#include "shade/shade_packets-inl.h"

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace HWY_NAMESPACE {

// Materials without layers have a kernel of their own, which has neither the branches nor the registers of the others.
// With layers, specular-glossiness materials share metallic-roughness' kernels: only what they read differs.
#define FACET_MODEL_KERNEL(Name)                                  \
  void Name##Kernel(const ShadeTask& task) {                      \
    Surface<Float> surfaces[2];                                   \
    ShadePackets(task, ModelWith<Name, Name::kCore>(), surfaces); \
  }
FACET_GLTF_MODELS(FACET_MODEL_KERNEL)
#undef FACET_MODEL_KERNEL

void LayeredKernel(const ShadeTask& task) {
  Surface<Float> surfaces[2];
  ShadePackets(task, ModelSeenThrough<MetallicRoughness>{task}, surfaces);
}

void AlphaKernel(const ShadeTask& task) {
  const MaterialView<Float> material(*task.material);
  for (std::size_t i = 0; i < task.count; i += LaneCount()) {
    Surface<Float> surface;
    InterpolateSurface(task, i, surface);
    Store(material.Alpha(surface), task.alpha + i);
  }
}

void BackgroundKernel(const BackgroundTask& task) {
  const LightingView<Float> lighting(*task.lighting);
  const Float one(1.0f), zero(0.0f);
  const hn::ScalableTag<double> doubles;
  const hn::Rebind<float, decltype(doubles)> floats;
  const std::size_t width = std::size_t(task.width), lanes = LaneCount();
  for (std::size_t x = 0; x < width; x += lanes) {
    const std::size_t count = std::min(lanes, width - x);
    float whole[4 * kMaxLanes];
    float* pixels = task.pixels + 4 * x;
    if (count < lanes) {
      std::fill(std::begin(whole), std::end(whole), 1.0f);
      std::copy_n(pixels, 4 * count, whole);
      pixels = whole;
    }
    Float r, g, b, a;
    hn::LoadInterleaved4(FloatTag(), pixels, r.raw, g.raw, b.raw, a.raw);
    const Float share = one - a;
    const Mask behind = share > zero;
    if (!Any(behind)) continue;
    alignas(64) float direction[3][kMaxLanes];
    for (int c = 0; c < 3; ++c) {
      const auto row = hn::Set(doubles, task.row[c]), all = hn::Set(doubles, task.whole[c]);
      for (std::size_t i = 0; i < lanes; i += hn::Lanes(doubles)) {
        const auto through = hn::Add(hn::Add(hn::LoadU(doubles, task.column[c] + x + i), row), all);
        hn::StoreU(hn::DemoteTo(floats, through), floats, direction[c] + i);
      }
    }
    const Vec3<Float> to_pixel{LoadFloat(direction[0]), LoadFloat(direction[1]), LoadFloat(direction[2])};
    const Vec3<Float> seen = lighting.Background(to_pixel);
    const auto under = [&](Float light, Float back) HWY_ATTR { return Select(behind, light + back * share, light); };
    hn::StoreInterleaved4(under(r, seen.x).raw, under(g, seen.y).raw, under(b, seen.z).raw, under(a, one).raw,
                          FloatTag(), pixels);
    if (count < lanes) std::copy_n(whole, 4 * count, task.pixels + 4 * x);
  }
}

void EnvironmentAtKernel(const EnvironmentTask& task) {
  const LightingView<Float> lighting(*task.lighting);
  for (std::size_t i = 0; i < task.count; i += LaneCount()) {
    const Float x = LoadFloat(task.x + i), y = LoadFloat(task.y + i), roughness = LoadFloat(task.roughness + i);
    const auto component = [&](int c) HWY_ATTR {
      return Float(task.column[c]) * x + Float(task.row[c]) * y + Float(task.whole[c]);
    };
    const Vec3<Float> direction{component(0), component(1), component(2)};
    const Mask smooth = roughness <= Float(0.0f);
    Vec3<Float> seen = All(smooth) ? lighting.Background(direction) : lighting.Prefiltered(direction, roughness);
    if (Any(smooth) && !All(smooth)) seen = Select<Float>(smooth, lighting.Background(direction), seen);
    Store(seen.x, task.red + i), Store(seen.y, task.green + i), Store(seen.z, task.blue + i);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace facet
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace facet {

#define FACET_MODEL_EXPORT(Name) FACET_EXPORT(Name##Kernel);
FACET_GLTF_MODELS(FACET_MODEL_EXPORT)
#undef FACET_MODEL_EXPORT
FACET_EXPORT(LayeredKernel);
FACET_EXPORT(AlphaKernel);
FACET_EXPORT(EnvironmentAtKernel);
FACET_EXPORT(BackgroundKernel);

namespace {

// Whether the material needs the kernel with layers. Models that are not glTF's choose by themselves.
bool IsLayered(const FrameMaterial& material) { return material.Has(kLayerFeatures) && material.parameters == nullptr; }

}  // namespace

void ShadeFragments(const ShadeTask& task) {
  if (IsLayered(*task.material)) return FACET_DISPATCH(LayeredKernel)(task);
  switch (task.material->model) {
#define FACET_MODEL_CASE(Name) \
  case ShadingModel::Name: return FACET_DISPATCH(Name##Kernel)(task);
    FACET_GLTF_MODELS(FACET_MODEL_CASE)
#undef FACET_MODEL_CASE
#define FACET_MODEL_CASE(Name) \
  case ShadingModel::Name: return Shade##Name(task);
    FACET_OWN_MODELS(FACET_MODEL_CASE)
#undef FACET_MODEL_CASE
  }
}
void ShadeAlpha(const ShadeTask& task) { FACET_DISPATCH(AlphaKernel)(task); }
void LookUpEnvironment(const EnvironmentTask& task) { FACET_DISPATCH(EnvironmentAtKernel)(task); }
void ShadeBackground(const BackgroundTask& task) { FACET_DISPATCH(BackgroundKernel)(task); }

}  // namespace facet
#endif
