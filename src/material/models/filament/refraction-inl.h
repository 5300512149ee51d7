// What is seen through Filament's refractive surfaces. (The shaders of Filament; Guy and Agopian, Filament Materials
// Guide, "refractionType".) A solid refracts as a sphere that touches the surface there, whose diameter is the
// thickness; a thin wall does not refract, but light bounces between its two sides.

#if defined(FACET_MATERIAL_MODELS_FILAMENT_REFRACTION_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FACET_MATERIAL_MODELS_FILAMENT_REFRACTION_INL_H_
#undef FACET_MATERIAL_MODELS_FILAMENT_REFRACTION_INL_H_
#else
#define FACET_MATERIAL_MODELS_FILAMENT_REFRACTION_INL_H_
#endif

#include "material/lobes/transmission-inl.h"
#include "material/lobes/volume-inl.h"
#include "material/models/filament/surface-inl.h"

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace HWY_NAMESPACE {
namespace filament {

template <class T>
struct Refraction {
  Vec3<T> tint;     // of what is seen through the surface
  Vec3<T> path[3];  // through the medium, for red, green and blue: metres; zero for thin walls
  T alpha{};        // GGX's width of the light that passes: narrower where the indices differ less
  T spread{};       // TransmissionLobe::Spread()
};

// Of the medium, for red, green and blue: the stated index, or that of F0.
template <class T>
FACET_INLINE Vec3<T> IndicesOf(const FilamentSurface<T>& s) {
  const FilamentParameters& p = *s.block;
  const T one(1.0f), middle = p.ior != 0.0f ? T(p.ior) : IndexOfF0(s.f0.y);
  const T half_spread = (middle - one) * T(0.025f * p.dispersion);
  return {Max(middle - half_spread, one), middle, middle + half_spread};
}

// From where the view enters a sphere of diameter `thickness` to where it leaves it.
template <class T>
FACET_INLINE Vec3<T> PathThroughSphere(const SurfaceView<T>& at, T ior, T thickness) {
  const Vec3<T> inside = RefractedPath(at, ior, T(1.0f));
  return inside * (thickness * Max(-Dot(at.normal, inside), T(0.0f)));
}

// `metres_per_unit`: 0 where no medium begins at this side of the surface.
template <class T, class Source>
FACET_INLINE Refraction<T> RefractionAt(const FilamentSurface<T>& s, const Source& from, T metres_per_unit) {
  using Block = FilamentParameters;
  const Block& p = *s.block;
  const T one(1.0f);
  const bool solid = p.refraction_type == Block::RefractionType::Solid;
  const Vec3<T> indices = IndicesOf(s);
  const T ior = indices.y;
  const Vec3<T> absorption = ReadParameter<T>(from, p.absorption, SlotOf(&Block::absorption));
  Refraction<T> r{};
  Vec3<T> reflected = s.reflected;
  T distance(0.0f);
  if (!solid) {
    reflected = reflected * (one + s.transmission * (one - reflected.y) / (one + reflected.y));
    const Vec3<T> inside = RefractedPath(s.at, ior, one);
    distance = ReadParameter<T>(from, p.micro_thickness, SlotOf(&Block::micro_thickness)) /
               Max(-Dot(s.at.normal, inside), T(0.001f));
  } else {
    const T stated = ReadParameter<T>(from, p.thickness, SlotOf(&Block::thickness));
    const T thickness = Select(metres_per_unit > T(0.0f), Min(stated, T(1e30f)), T(0.0f));
    const bool disperses = from.Has(kDispersion);
    const Vec3<T> middle = PathThroughSphere(s.at, ior, thickness);
    r.path[0] = disperses ? PathThroughSphere(s.at, indices.x, thickness) : middle;
    if (disperses) r.path[1] = middle, r.path[2] = PathThroughSphere(s.at, indices.z, thickness);
    distance = Sqrt(Dot(middle, middle));
  }
  r.tint = Bounded(Grey(one) - reflected) * s.diffuse_color * s.transmission *
           VolumeInputs<T>{distance, absorption}.Passing();
  TransmissionLobe<T> lobe;
  const T remapped = s.unclamped_roughness * (one - Bounded(T(3.0f) / ior - T(2.0f)));
  lobe.unclamped_alpha = r.alpha = AlphaFromPerceptualRoughness(remapped);
  r.spread = lobe.Spread(distance * T(solid ? 1.0f : 0.0f), ior);
  return r;
}

}  // namespace filament
}  // namespace HWY_NAMESPACE
}  // namespace facet
HWY_AFTER_NAMESPACE();

#endif
