// The model "filament": Filament's shading models lit, cloth, subsurface, specularGlossiness and unlit
// (docs/models/filament.md).

#if defined(FACET_MATERIAL_MODELS_FILAMENT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FACET_MATERIAL_MODELS_FILAMENT_INL_H_
#undef FACET_MATERIAL_MODELS_FILAMENT_INL_H_
#else
#define FACET_MATERIAL_MODELS_FILAMENT_INL_H_
#endif

#include "material/models/filament/blending-inl.h"
#include "material/models/filament/environment-inl.h"
#include "material/models/filament/refraction-inl.h"
#include "material/models/seen_through-inl.h"

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace HWY_NAMESPACE {

template <class T>
struct FilamentScattering : filament::FilamentSurface<T> {
  using Shading = filament::Shading;
  Vec3<T> normal{}, view{};
  filament::PostLighting<T> after;

  FACET_INLINE explicit FilamentScattering(const filament::FilamentSurface<T>& surface)
      : filament::FilamentSurface<T>(surface), normal(surface.at.normal), view(surface.at.view) {}

  FACET_INLINE Vec3<T> Emission() const {
    return this->shading == Shading::Unlit ? this->base_color + this->emission : this->emission;
  }

  template <class Lighting>
  FACET_INLINE Vec3<T> Direct(const Vec3<T>& direction, const Lighting&) const {
    switch (this->shading) {
      case Shading::Unlit: return {};
      case Shading::Cloth: return filament::DirectCloth(*this, direction);
      case Shading::Subsurface: return filament::DirectSubsurface(*this, direction);
      case Shading::Lit:
      case Shading::SpecularGlossiness: break;
    }
    return filament::DirectLit(*this, direction);
  }

  template <class Lighting>
  FACET_INLINE Vec3<T> Environment(const Lighting& lighting) const {
    return this->shading == Shading::Unlit ? Vec3<T>{} : filament::FromPrefiltered(*this, lighting);
  }

  template <class Lighting>
  FACET_INLINE Vec3<T> FromEnvironment(const Vec3<T>& direction, const Lighting&) const {
    return this->shading == Shading::Unlit ? Vec3<T>{} : filament::FromOneDirection(*this, direction);
  }

  // The surface with all its light: blended with the colour that comes after lighting, and in straight alpha.
  FACET_INLINE Shaded<T> Finish(const Vec3<T>& radiance) const { return filament::Finish<T>(*this, after, radiance); }

  template <class Visit>
  FACET_INLINE void ForEachShape(const Visit& visit) const {
    if (this->shading == Shading::Unlit || this->shading == Shading::Cloth) return;
    visit(normal, this->alpha);
    if (this->has_coat) visit(this->coat_at.normal, this->coat_alpha);
  }
  FACET_INLINE bool TransmitsDiffusely() const { return this->has_subsurface; }
};

struct Filament : OwnModel<Filament> {
  using Block = FilamentParameters;

  template <class T, class Source, class Lighting>
  static FACET_INLINE FilamentScattering<T> Make(const Source& from, const Vec4<T>& base, const Vec3<T>& view,
                                                 const Lighting& lighting) {
    const Block& p = from.template Parameters<Block>();
    FilamentScattering<T> s(filament::SurfaceReader<T, Source>(from, p).Read(base, view, lighting));
    s.after = filament::ReadPostLighting<T>(from, p);
    return s;
  }

  template <class T, class Material, class Lighting>
  static FACET_INLINE ShadedThrough<T> Through(const Surface<T>& surface, const Material& material,
                                               const Lighting& lighting) {
    return material.Read(surface, [&](const auto& from, const Vec4<T>& base) HWY_ATTR {
      const FilamentScattering<T> s = Make<T>(from, base, surface.view, lighting);
      ShadedThrough<T> out{};
      out.own = s.Finish(AllLight(s, surface.position, lighting));
      if (s.refracts) {
        const filament::Refraction<T> r = filament::RefractionAt(s, from, surface.metres_per_unit);
        out.tint = r.tint;
        for (int c = 0; c < 3; ++c) out.path[c] = r.path[c];
        out.spread = r.spread;
      } else if (IsSeenThrough(*s.block)) {
        filament::BlendWithBehind(s, out.own, out.tint);
      }
      return out;
    });
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace facet
HWY_AFTER_NAMESPACE();

#endif
