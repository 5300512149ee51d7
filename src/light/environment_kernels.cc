#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "light/environment_kernels.cc"
#include "hwy/foreach_target.h"

#include "light/environment_kernels.h"
#include "facet/shader/dispatch.h"
#include "light/environment-inl.h"

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace HWY_NAMESPACE {

// Texels first .. first + lanes of a row. The squares' sizes are multiples of the lane count.
HWY_INLINE void StoreTexels(Vec3<Float> color, Float fourth, float* out) {
  float r[kMaxLanes], g[kMaxLanes], b[kMaxLanes], a[kMaxLanes];
  Store(color.x, r);
  Store(color.y, g);
  Store(color.z, b);
  Store(fourth, a);
  for (std::size_t lane = 0; lane < LaneCount(); ++lane) {
    out[4 * lane] = r[lane];
    out[4 * lane + 1] = g[lane];
    out[4 * lane + 2] = b[lane];
    out[4 * lane + 3] = a[lane];
  }
}

void FillOctahedronRow(const OctahedronRowTask& task) {
  const float size = static_cast<float>(task.size);
  const Float scale = Float(1.0f / size);  // exact: a power of two
  for (std::int32_t first = 0; first < task.size; first += static_cast<std::int32_t>(LaneCount())) {
    const Float column = ToFloat(LaneIndex() + Int(first));
    Vec3<Float> sum{};
    for (int s = 0; s < 4; ++s) {
      const Vec2<Float> uv = {(column + Float(s & 1 ? 0.75f : 0.25f)) * scale,
                              (Float(static_cast<float>(task.row)) + Float(s & 2 ? 0.75f : 0.25f)) * scale};
      sum += SampleEquirectangular(task.picture, task.picture_width, task.picture_height, DirectionFromOctahedron(uv));
    }
    // A texel of area dx dz of the octahedron's square subtends dx dz / |p|^3, p the point on the octahedron.
    const Float x = Abs((column + Float(0.5f)) * scale * Float(2.0f) - Float(1.0f));
    const Float z = Abs((Float(static_cast<float>(task.row)) + Float(0.5f)) * scale * Float(2.0f) - Float(1.0f));
    const Float y = Float(1.0f) - x - z;
    const Mask below = y < Float(0.0f);
    const Float px = Select(below, Float(1.0f) - z, x);
    const Float pz = Select(below, Float(1.0f) - x, z);
    const Float length2 = px * px + y * y + pz * pz;
    const Float solid_angle = Float(4.0f) * scale * scale / (length2 * Sqrt(length2));
    StoreTexels(sum * Float(0.25f), solid_angle, task.out + 4 * first);
  }
}

void FilterLobeRow(const LobeRowTask& task) {
  const Float scale = Float(1.0f / static_cast<float>(task.size));
  for (std::int32_t first = 0; first < task.size; first += static_cast<std::int32_t>(LaneCount())) {
    const Vec2<Float> uv = {(ToFloat(LaneIndex() + Int(first)) + Float(0.5f)) * scale,
                            (Float(static_cast<float>(task.row)) + Float(0.5f)) * scale};
    const Vec3<Float> n = DirectionFromOctahedron(uv);
    // Duff et al., 2017, Building an Orthonormal Basis, Revisited.
    const Float sign = CopySign(Float(1.0f), n.z);
    const Float a = Float(-1.0f) / (sign + n.z);
    const Float b = n.x * n.y * a;
    const Vec3<Float> tangent = {Float(1.0f) + sign * n.x * n.x * a, sign * b, -sign * n.x};
    const Vec3<Float> bitangent = {b, sign + n.y * n.y * a, -n.y};
    Vec3<Float> sum{};
    for (std::int32_t i = 0; i < task.sample_count; ++i) {
      const LobeSample& sample = task.samples[i];
      const Vec3<Float> direction = tangent * Float(sample.x) + bitangent * Float(sample.y) + n * Float(sample.z);
      const Vec3<Float> radiance =
          SampleOctahedron<Float>(task.texels, Float(static_cast<float>(sample.size)), Int(sample.size + 2),
                                  Int(sample.origin), OctahedronFromDirection(direction));
      sum += radiance * Float(sample.weight);
    }
    StoreTexels(sum, Float(0.0f), task.out + 4 * first);
  }
}

void ConvolveRow(const ConvolveRowTask& task) {
  const Float scale = Float(1.0f / static_cast<float>(task.size));
  for (std::int32_t first = 0; first < task.size; first += static_cast<std::int32_t>(LaneCount())) {
    const Vec2<Float> uv = {(ToFloat(LaneIndex() + Int(first)) + Float(0.5f)) * scale,
                            (Float(static_cast<float>(task.row)) + Float(0.5f)) * scale};
    const Vec3<Float> n = DirectionFromOctahedron(uv);
    Vec3<Float> sum[kMaxConvolutions] = {};
    Float norm[kMaxConvolutions] = {};
    for (std::int32_t i = 0; i < task.source_count; ++i) {
      const SourceTexel& source = task.source[i];
      const Float n_dot_l = n.x * Float(source.x) + n.y * Float(source.y) + n.z * Float(source.z);
      const Mask lit = n_dot_l > Float(0.0f);
      if (!Any(lit)) continue;
      const Float cosine = Select(lit, n_dot_l, Float(0.0f));
      const Float n_dot_h2 = Float(0.5f) + Float(0.5f) * cosine;  // the half-angle formula; view = normal
      for (std::int32_t k = 0; k < task.count; ++k) {
        const float a2 = task.alpha[k] * task.alpha[k];
        const Float t = n_dot_h2 * Float(a2 - 1.0f) + Float(1.0f);
        const Float weight = task.alpha[k] > 0.0f ? cosine / (t * t) : cosine;
        norm[k] += weight * Float(source.solid_angle);
        sum[k] += Vec3<Float>{Float(source.r), Float(source.g), Float(source.b)} * weight;
      }
    }
    for (std::int32_t k = 0; k < task.count; ++k) {
      StoreTexels(sum[k] / norm[k], Float(0.0f), task.out[k] + 4 * first);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace facet
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace facet {

FACET_EXPORT(FillOctahedronRow);
FACET_EXPORT(FilterLobeRow);
FACET_EXPORT(ConvolveRow);

void FillOctahedronRow(const OctahedronRowTask& task) { FACET_DISPATCH(FillOctahedronRow)(task); }
void FilterLobeRow(const LobeRowTask& task) { FACET_DISPATCH(FilterLobeRow)(task); }
void ConvolveRow(const ConvolveRowTask& task) { FACET_DISPATCH(ConvolveRow)(task); }

}  // namespace facet
#endif
