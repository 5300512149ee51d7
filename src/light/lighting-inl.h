// The light of a frame as material closures use it. T is Float (lanes), float or double.

#if defined(FACET_LIGHT_LIGHTING_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FACET_LIGHT_LIGHTING_INL_H_
#undef FACET_LIGHT_LIGHTING_INL_H_
#else
#define FACET_LIGHT_LIGHTING_INL_H_
#endif

#include "light/environment-inl.h"
#include "light/lighting.h"
#include "material/lobes/microfacets-inl.h"

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace HWY_NAMESPACE {

// KHR_lights_punctual at `position`, relative to the eye, world axes.
template <class T>
FACET_INLINE LightSample<T> SamplePunctual(const PunctualLight& light, Vec3<T> position) {
  const Vec3<T> intensity = {T(light.intensity[0]), T(light.intensity[1]), T(light.intensity[2])};
  const Vec3<T> shines = {T(light.direction[0]), T(light.direction[1]), T(light.direction[2])};
  if (light.type == LightType::Directional) return {-shines, intensity};
  const Vec3<T> to_light = Vec3<T>{T(light.position_eye[0]), T(light.position_eye[1]), T(light.position_eye[2])} -
                           position;
  // Distances below a millimetre count as a millimetre, so that the illuminance stays finite.
  const T length2 = Dot(to_light, to_light);
  const T distance2 = Max(length2, T(1e-6f));
  // The direction is still normalised there, down to 1e-18 m, where the square underflows. At the light's own position
  // there is no direction.
  const Vec3<T> direction = to_light * (T(1.0f) / Sqrt(Max(length2, T(1e-36f))));
  const T relative2 = distance2 * T(light.inverse_range2);
  const T window = Clamp(T(1.0f) - relative2 * relative2, T(0.0f), T(1.0f));
  T attenuation = window / distance2;
  if (light.type == LightType::Spot) {
    const T cosine = -Dot(shines, direction);
    const T angular = Clamp(cosine * T(light.spot_scale) + T(light.spot_offset), T(0.0f), T(1.0f));
    attenuation *= angular * angular;
  }
  return {direction, intensity * attenuation};
}

// The rows of a DfgTable to interpolate between.
template <class T>
FACET_INLINE TablePosition<T> DfgRow(T perceptual_roughness) {
  const float last = static_cast<float>(DfgTable::kRows - 1);
  const T root = Sqrt(Max(perceptual_roughness, T(0.0f)));
  return PositionInTable((root - T(DfgTable::kFirstRow)) * T(last / (1.0f - DfgTable::kFirstRow)), last);
}

template <class T>
FACET_INLINE SpecularAlbedo<T> LookupDfg(const DfgTable& table, T n_dot_v, T perceptual_roughness) {
  const float last = static_cast<float>(DfgTable::kColumns - 1);
  const TablePosition<T> row = DfgRow(perceptual_roughness);
  const TablePosition<T> column = PositionInTable(Sqrt(Sqrt(Max(n_dot_v, T(0.0f)))) * T(last), last);
  const IntOf<T> index = (row.index * IntOf<T>(DfgTable::kColumns) + column.index) * IntOf<T>(2);
  // A and B of this column and the next, in this row and the next.
  const Vec4<T> p = FetchVec4<T>(table.albedo, index), q = FetchVec4<T>(table.albedo + 2 * DfgTable::kColumns, index);
  return {Mix(Mix(p.x, p.z, column.fraction), Mix(q.x, q.z, column.fraction), row.fraction),
          Mix(Mix(p.y, p.w, column.fraction), Mix(q.y, q.w, column.fraction), row.fraction)};
}

template <class T>
FACET_INLINE SpecularAlbedo<T> LookupDfgAverage(const DfgTable& table, T perceptual_roughness) {
  const TablePosition<T> row = DfgRow(perceptual_roughness);
  const Vec4<T> p = FetchVec4<T>(table.average, row.index * IntOf<T>(2));  // A and B of this row and the next
  return {Mix(p.x, p.z, row.fraction), Mix(p.y, p.w, row.fraction)};
}

// The row of an AnisotropicDfgTable, and the layer within it.
template <class T>
FACET_INLINE TablePosition<T> AnisotropicDfgRow(T perceptual_roughness) {
  using Table = AnisotropicDfgTable;
  const T root = Sqrt(Max(perceptual_roughness, T(0.0f)));
  return PositionInTable((root - T(Table::kFirstRow)) * T((Table::kRows - 1) / (1.0f - Table::kFirstRow)),
                         static_cast<float>(Table::kRows - 1));
}
template <class T>
FACET_INLINE TablePosition<T> AnisotropicDfgLayer(T strength) {
  const float last = static_cast<float>(AnisotropicDfgTable::kLayers - 1);
  return PositionInTable(strength * T(last), last);
}

// `t_dot_v`: the cosine with the tangent, of either sign.
template <class T>
HWY_NOINLINE SpecularAlbedo<T> LookupAnisotropicDfg(const AnisotropicDfgTable& table, T n_dot_v, T t_dot_v,
                                                    T perceptual_roughness, T strength) {
  using Table = AnisotropicDfgTable;
  const auto position = [](T share, int count) HWY_ATTR {
    return PositionInTable(share * T(static_cast<float>(count - 1)), static_cast<float>(count - 1));
  };
  const TablePosition<T> row = AnisotropicDfgRow(perceptual_roughness), layer = AnisotropicDfgLayer(strength);
  const T n = Clamp(n_dot_v, T(0.0f), T(1.0f)), u = Sqrt(Sqrt(n));
  const T y = Sqrt(Sqrt(Sqrt(n * n + t_dot_v * t_dot_v)));
  // Seen from the front, a surface looks the same from all azimuths.
  const TablePosition<T> turn = position((y - u) / Max(T(1.0f) - u, T(1e-6f)), Table::kTurns);
  const TablePosition<T> column = position(u, Table::kColumns);
  const IntOf<T> sample = (row.index * IntOf<T>(Table::kLayers) + layer.index) * IntOf<T>(Table::kTurns) + turn.index;
  const IntOf<T> index = (sample * IntOf<T>(Table::kColumns) + column.index) * IntOf<T>(2);
  // Over columns and turns. Offsets are in samples of A and B.
  const auto of_layer = [&](int offset) HWY_ATTR -> SpecularAlbedo<T> {
    const float* first = table.albedo + 2 * offset;
    const Vec4<T> p = FetchVec4<T>(first, index), q = FetchVec4<T>(first + 2 * Table::kColumns, index);
    return {Mix(Mix(p.x, p.z, column.fraction), Mix(q.x, q.z, column.fraction), turn.fraction),
            Mix(Mix(p.y, p.w, column.fraction), Mix(q.y, q.w, column.fraction), turn.fraction)};
  };
  const auto of_row = [&](int offset) HWY_ATTR -> SpecularAlbedo<T> {
    const SpecularAlbedo<T> p = of_layer(offset), q = of_layer(offset + Table::kTurns * Table::kColumns);
    return {Mix(p.a, q.a, layer.fraction), Mix(p.b, q.b, layer.fraction)};
  };
  const SpecularAlbedo<T> p = of_row(0), q = of_row(Table::kLayers * Table::kTurns * Table::kColumns);
  return {Mix(p.a, q.a, row.fraction), Mix(p.b, q.b, row.fraction)};
}

template <class T>
FACET_INLINE SpecularAlbedo<T> LookupAnisotropicDfgAverage(const AnisotropicDfgTable& table, T perceptual_roughness,
                                                           T strength) {
  const TablePosition<T> row = AnisotropicDfgRow(perceptual_roughness), layer = AnisotropicDfgLayer(strength);
  const IntOf<T> index = (row.index * IntOf<T>(AnisotropicDfgTable::kLayers) + layer.index) * IntOf<T>(2);
  // A and B of this layer and the next, in this row and the next.
  const Vec4<T> p = FetchVec4<T>(table.average, index);
  const Vec4<T> q = FetchVec4<T>(table.average + 2 * AnisotropicDfgTable::kLayers, index);
  return {Mix(Mix(p.x, p.z, layer.fraction), Mix(q.x, q.z, layer.fraction), row.fraction),
          Mix(Mix(p.y, p.w, layer.fraction), Mix(q.y, q.w, layer.fraction), row.fraction)};
}

// E of sheen, which may exceed 1.
template <class T>
FACET_INLINE T LookupSheen(const SheenTable& table, T n_dot_v, T perceptual_roughness) {
  const auto position = [](T x, float first, int count) HWY_ATTR {
    const float last = static_cast<float>(count - 1);
    return PositionInTable((Sqrt(Sqrt(Max(x, T(0.0f)))) - T(first)) * T(last / (1.0f - first)), last);
  };
  const TablePosition<T> column = position(n_dot_v, SheenTable::kFirstColumn, SheenTable::kColumns);
  const TablePosition<T> row = position(perceptual_roughness, SheenTable::kFirstRow, SheenTable::kRows);
  const IntOf<T> index = (row.index * IntOf<T>(SheenTable::kColumns) + column.index) * IntOf<T>(2);
  const Vec4<T> e = FetchVec4<T>(table.albedo, index);  // of this column in both rows, then of the next
  return Mix(Mix(e.x, e.z, column.fraction), Mix(e.y, e.w, column.fraction), row.fraction);
}

// Implements the Lighting that material/closure-inl.h expects. Directions are in world axes.
template <class T>
class LightingView {
 public:
  FACET_INLINE explicit LightingView(const LightingData& data) : data_(&data) {}

  FACET_INLINE int LightCount() const { return data_->light_count; }
  FACET_INLINE LightSample<T> Sample(int light, Vec3<T> position) const {
    return SamplePunctual(data_->lights[light], position);
  }
  FACET_INLINE bool HasEnvironment() const { return data_->environment != nullptr; }
  FACET_INLINE Vec3<T> IrradianceOverPi(Vec3<T> normal) const {
    return HWY_NAMESPACE::IrradianceOverPi(*data_->environment, ToEnvironment(normal)) *
           T(data_->environment_intensity);
  }
  // Irradiance on a surface facing `normal`.
  FACET_INLINE Vec3<T> Irradiance(Vec3<T> normal) const { return IrradianceOverPi(normal) * T(kPi); }
  FACET_INLINE Vec3<T> Prefiltered(Vec3<T> direction, T perceptual_roughness) const {
    return PrefilteredRadiance(*data_->environment, ToEnvironment(direction), perceptual_roughness) *
           T(data_->environment_intensity);
  }
  // The same of a lobe whose square of alpha is greater by `footprint_alpha2`. Between levels the mixture is wider than
  // the lobe to begin with, often by more than the footprint.
  FACET_INLINE Vec3<T> Prefiltered(Vec3<T> direction, T perceptual_roughness, T footprint_alpha2) const {
    const MaskOf<T> wider = IsWidened(perceptual_roughness, footprint_alpha2);
    T roughness = perceptual_roughness;
    if (Any(wider)) {
      const T needed = RoughnessOfMixture(WidenedRoughness(perceptual_roughness, footprint_alpha2));
      roughness = Select(wider, Max(perceptual_roughness, needed), perceptual_roughness);
    }
    return Prefiltered(direction, roughness);
  }
  // The environment as a background: from its image if that was kept (keep_image), else from its sharpest map.
  FACET_INLINE Vec3<T> Background(Vec3<T> direction) const {
    return SharpRadiance(*data_->environment, ToEnvironment(direction)) * T(data_->environment_intensity);
  }
  FACET_INLINE SpecularAlbedo<T> Dfg(T n_dot_v, T perceptual_roughness) const {
    return LookupDfg(*data_->dfg, n_dot_v, perceptual_roughness);
  }
  // The same where masking and shadowing are Schlick's, for `alpha` as the model "lecture" has it.
  FACET_INLINE SpecularAlbedo<T> SchlickDfg(LectureAlpha alpha, T n_dot_v, T perceptual_roughness) const {
    return LookupDfg(*data_->schlick_dfg[static_cast<std::size_t>(alpha)], n_dot_v, perceptual_roughness);
  }
  FACET_INLINE SpecularAlbedo<T> DfgAverage(T perceptual_roughness) const {
    return LookupDfgAverage(*data_->dfg, perceptual_roughness);
  }
  // Only where a material is anisotropic.
  FACET_INLINE SpecularAlbedo<T> AnisotropicDfg(T n_dot_v, T t_dot_v, T perceptual_roughness, T strength) const {
    return LookupAnisotropicDfg(*data_->anisotropic_dfg, n_dot_v, t_dot_v, perceptual_roughness, strength);
  }
  FACET_INLINE SpecularAlbedo<T> AnisotropicDfgAverage(T perceptual_roughness, T strength) const {
    return LookupAnisotropicDfgAverage(*data_->anisotropic_dfg, perceptual_roughness, strength);
  }
  // Of the sheen lobe with colour 1; may exceed 1. Only where a material has sheen.
  FACET_INLINE T SheenAlbedo(T n_dot_v, T perceptual_roughness) const {
    return LookupSheen(*data_->sheen, n_dot_v, perceptual_roughness);
  }
  // The same of Filament's fibres.
  FACET_INLINE T ClothAlbedo(T n_dot_v, T perceptual_roughness) const {
    return LookupSheen(*data_->cloth, n_dot_v, perceptual_roughness);
  }

 private:
  FACET_INLINE Vec3<T> ToEnvironment(Vec3<T> d) const {
    const float* m = data_->environment_from_world;
    return {T(m[0]) * d.x + T(m[1]) * d.y + T(m[2]) * d.z, T(m[3]) * d.x + T(m[4]) * d.y + T(m[5]) * d.z,
            T(m[6]) * d.x + T(m[7]) * d.y + T(m[8]) * d.z};
  }

  const LightingData* data_;
};

}  // namespace HWY_NAMESPACE
}  // namespace facet
HWY_AFTER_NAMESPACE();

#endif
