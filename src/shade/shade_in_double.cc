// Here time matters less than in the kernels: the compiler chooses what it inlines, and is done in an eighth of the
// time.
#ifndef FACET_MAY_INLINE
#define FACET_MAY_INLINE
#endif

#include "shade/shade_in_double.h"

#include <cmath>
#include <limits>

#include "light/lighting-inl.h"
#include "material/models/all-inl.h"
#include "shade/interpolate-inl.h"
#include "shade/material_view-inl.h"
#include "shade/shade_packets-inl.h"
#include "shade/shade_task.h"

// Compiled for the baseline instruction set, like the functions that it calls: on Arm their target attributes must
// agree.
HWY_BEFORE_NAMESPACE();
namespace facet {
namespace {

namespace lanes = HWY_NAMESPACE;

bool IsFiniteFloat(double x) { return std::fabs(x) <= double{std::numeric_limits<float>::max()}; }

lanes::Shaded<double> ShadeSeenThrough(const ShadeTask& task, const lanes::Surface<double>& surface,
                                       const lanes::MaterialView<double>& material,
                                       const lanes::LightingView<double>& lighting, std::size_t i) {
  const auto shade = [&]<class Model>(Model) {
    const lanes::ShadedThrough<double> shaded = lanes::ModelSeenThrough<Model>{task}(surface, material, lighting);
    lanes::StoreSeenThrough(task, surface, i, shaded);
    return shaded.own;
  };
  switch (material.Model()) {
#define FACET_MODEL_CASE(Name) \
  case ShadingModel::Name: return shade(lanes::Name());
    FACET_MODELS_SEEN_THROUGH(FACET_MODEL_CASE)
#undef FACET_MODEL_CASE
    case ShadingModel::SpecularGlossiness: return shade(lanes::MetallicRoughness());
    default: break;
  }
  return {};
}

class DoubleShader final : public FragmentShader {
 public:
  bool Transmits() const override { return true; }

  void Shade(const ShadeTask& task) const override {
    const lanes::MaterialView<double> material(*task.material);
    const lanes::LightingView<double> lighting(*task.lighting);
    for (std::size_t i = 0; i < task.count; ++i) {
      const lanes::Surface<double> surface = lanes::InterpolateSurface<double>(task, i);
      const lanes::Shaded<double> shaded = task.seen_through != nullptr
                                               ? ShadeSeenThrough(task, surface, material, lighting, i)
                                               : lanes::ModelOfMaterial()(surface, material, lighting);
      const lanes::Vec3<double> c = shaded.color;
      const bool finite = IsFiniteFloat(c.x) && IsFiniteFloat(c.y) && IsFiniteFloat(c.z) && IsFiniteFloat(shaded.alpha);
      task.red[i] = finite ? static_cast<float>(c.x) : 0.0f;
      task.green[i] = finite ? static_cast<float>(c.y) : 0.0f;
      task.blue[i] = finite ? static_cast<float>(c.z) : 0.0f;
      task.alpha[i] = finite ? static_cast<float>(lanes::Clamp(shaded.alpha, 0.0, 1.0)) : 0.0f;
      if (!finite) ++*task.non_finite;
    }
  }
};

}  // namespace

std::unique_ptr<const FragmentShader> MakeDoubleShader() { return std::make_unique<DoubleShader>(); }

}  // namespace facet
HWY_AFTER_NAMESPACE();
