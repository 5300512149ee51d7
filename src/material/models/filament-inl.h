// The model "filament".

#if defined(FACET_MATERIAL_MODELS_FILAMENT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FACET_MATERIAL_MODELS_FILAMENT_INL_H_
#undef FACET_MATERIAL_MODELS_FILAMENT_INL_H_
#else
#define FACET_MATERIAL_MODELS_FILAMENT_INL_H_
#endif

#include "material/models/own_model-inl.h"

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace HWY_NAMESPACE {

template <class T>
struct FilamentScattering {
  Vec3<T> normal{}, view{}, base_color{}, emission{};
  T coverage{}, metallic{}, alpha{}, perceptual_roughness{}, occlusion{};

  HWY_INLINE Vec3<T> Emission() const { return emission; }

  template <class Lighting>
  HWY_INLINE Vec3<T> Direct(const Vec3<T>& direction, const Lighting&) const {
    const T n_dot_l = Clamp(Dot(normal, direction), T(0.0f), T(1.0f));
    return base_color * (n_dot_l * T(kInversePi));
  }

  template <class Lighting>
  HWY_INLINE Vec3<T> Environment(const Lighting& lighting) const {
    return lighting.IrradianceOverPi(normal) * base_color * occlusion;
  }

  template <class Lighting>
  HWY_INLINE Vec3<T> FromEnvironment(const Vec3<T>& direction, const Lighting& lighting) const {
    return Direct(direction, lighting) * occlusion;
  }

  template <class Visit>
  HWY_INLINE void ForEachShape(const Visit& visit) const {
    visit(normal, alpha);
  }
  HWY_INLINE bool TransmitsDiffusely() const { return false; }
};

struct Filament : OwnModel<Filament> {
  using Block = FilamentParameters;

  template <class T, class Source, class Lighting>
  static HWY_INLINE FilamentScattering<T> Make(const Source& from, const Vec4<T>& base, const Vec3<T>& view,
                                          const Lighting&) {
    const Block& p = from.template Parameters<Block>();
    FilamentScattering<T> s;
    s.view = view;
    s.base_color = Xyz(base);
    s.coverage = base.w;
    s.metallic = ReadParameter<T>(from, p.metallic, SlotOf(&Block::metallic));
    s.perceptual_roughness = ReadParameter<T>(from, p.roughness, SlotOf(&Block::roughness));
    s.alpha = s.perceptual_roughness * s.perceptual_roughness;
    s.normal = ReadParameter<T>(from, p.normal, SlotOf(&Block::normal));
    s.occlusion = ReadParameter<T>(from, p.ambient_occlusion, SlotOf(&Block::ambient_occlusion));
    if (from.Has(kEmission)) s.emission = Xyz(ReadParameter<T>(from, p.emissive, SlotOf(&Block::emissive)));
    return s;
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace facet
HWY_AFTER_NAMESPACE();

#endif
