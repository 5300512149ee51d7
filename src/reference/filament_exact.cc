#include "reference/filament_exact.h"

#include <algorithm>

#include "light/lighting-inl.h"
#include "material/models/filament-inl.h"
#include "reference/exact_source-inl.h"
#include "reference/lighting_exact-inl.h"

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace {

using Surface = lanes::filament::FilamentSurface<double>;

Surface SurfaceAt(const ExactSource& source, const glm::dvec4& base, const SurfacePoint& point,
                  const AlbedoSurface& albedos) {
  const auto& parameters = source.Parameters<FilamentParameters>();
  const lanes::filament::SurfaceReader<double, ExactSource> reader(source, parameters);
  return reader.Read(ToLanes(base), ToLanes(point.view), ExactLighting(albedos));
}

ExactInterface InterfaceOf(const Surface& s, const SurfacePoint& point) {
  const glm::dvec3 ior = FromLanes(lanes::filament::IndicesOf(s));
  return {point.view, FromLanes(s.at.normal), point.flat_normal, s.unclamped_roughness * s.unclamped_roughness, ior};
}

}  // namespace

ExactInterface FilamentExitAt(const ExactMaterial& material, const SurfacePoint& point) {
  return InterfaceOf(SurfaceAt({material, point}, material.BaseColor(point), point, AlbedoSurface::Shared()), point);
}

ExactEntry FilamentEntryAt(const ExactMaterial& material, const glm::dvec4& base, const SurfacePoint& point,
                           const ExactLight& light) {
  const ExactSource source{material, point};
  const Surface s = SurfaceAt(source, base, point, light.albedos);
  ExactEntry entry;
  entry.at = InterfaceOf(s, point);
  if (!s.refracts) return entry;
  // Of the surface alone: where there is no medium, nothing is absorbed but by thin walls.
  const auto refraction = lanes::filament::RefractionAt<double>(s, source, 0.0);
  entry.tint = FromLanes(refraction.tint);
  entry.thin_wall_alpha = refraction.alpha;
  if (source.Has(kVolume)) {
    const auto& absorption = s.block->absorption;
    entry.absorption =
        FromLanes(lanes::ReadParameter<double>(source, absorption, SlotOf(&FilamentParameters::absorption)));
    entry.thickness = lanes::ReadParameter<double>(source, s.block->thickness, SlotOf(&FilamentParameters::thickness));
  }
  return entry;
}

void BlendFilament(const ExactMaterial& material, glm::dvec3& own, ExactEntry& entry) {
  const FilamentParameters& p = material.Frame().Parameters<FilamentParameters>();
  if (!IsSeenThrough(p)) return;
  Surface s;
  s.blending = p.blending;
  lanes::Shaded<double> shaded{ToLanes(own), 1.0};
  lanes::Vec3<double> tint{};
  lanes::filament::BlendWithBehind(s, shaded, tint);
  own = FromLanes(shaded.color);
  entry.tint = FromLanes(tint);
}

}  // namespace facet
HWY_AFTER_NAMESPACE();
