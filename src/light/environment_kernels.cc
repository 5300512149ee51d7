#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "light/environment_kernels.cc"
#include "hwy/foreach_target.h"

#include "light/environment_kernels.h"
#include "facet/shader/dispatch.h"
#include "light/environment-inl.h"

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace HWY_NAMESPACE {

// Coordinates in [0, 1]^2 of the texels first, first + 1 ... of a row; beyond its end those of the last.
FACET_INLINE Vec2<Float> NodesOfRow(std::int32_t first, std::int32_t row, std::int32_t size) {
  const Float scale = Float(1.0f / static_cast<float>(size));  // exact: a power of two
  return {Min(ToFloat(LaneIndex() + Int(first)) * scale, Float(1.0f)), Float(static_cast<float>(row)) * scale};
}

// Reads a square of the chain: texels in the middle of cells, a border of one around them.
FACET_INLINE Vec3<Float> SampleCells(const float* texels, std::int32_t size, std::int32_t origin, Vec2<Float> uv) {
  // Columns and rows are counted from the border, so that nothing is negative.
  const Float scale = Float(static_cast<float>(size));
  const std::int32_t row = (size + 2) * 4;
  return SampleTexels<Float>(texels, Clamp(uv.x * scale, Float(0.0f), scale) + Float(0.5f),
                             Clamp(uv.y * scale, Float(0.0f), scale) + Float(0.5f), scale, Int(row),
                             Int(origin - row - 4));
}

// The lanes that are texels of the row; `size` is its last.
FACET_INLINE void StoreTexels(Vec3<Float> color, Float fourth, std::int32_t first, std::int32_t size, float* row) {
  float r[kMaxLanes], g[kMaxLanes], b[kMaxLanes], a[kMaxLanes];
  Store(color.x, r);
  Store(color.y, g);
  Store(color.z, b);
  Store(fourth, a);
  float* out = row + 4 * first;
  for (std::size_t lane = 0; lane < LaneCount() && first + static_cast<std::int32_t>(lane) <= size; ++lane) {
    out[4 * lane] = r[lane];
    out[4 * lane + 1] = g[lane];
    out[4 * lane + 2] = b[lane];
    out[4 * lane + 3] = a[lane];
  }
}

void FillOctahedronRow(const OctahedronRowTask& task) {
  const float cell = 1.0f / static_cast<float>(task.size);
  for (std::int32_t first = 0; first <= task.size; first += static_cast<std::int32_t>(LaneCount())) {
    const Vec2<Float> uv = NodesOfRow(first, task.row, task.size);
    Vec3<Float> sum{};
    for (int s = 0; s < 4; ++s) {
      const Vec2<Float> offset = {Float(s & 1 ? 0.25f * cell : -0.25f * cell), Float(s & 2 ? 0.25f * cell : -0.25f * cell)};
      sum +=
          SampleEquirectangular(task.image, task.image_width, task.image_height, DirectionFromOctahedron(uv + offset));
    }
    // An area dx dz of the octahedron's square subtends dx dz / |p|^3, p the point on the octahedron.
    const Float x = Abs(uv.x * Float(2.0f) - Float(1.0f));
    const Float z = Abs(uv.y * Float(2.0f) - Float(1.0f));
    const Float y = Float(1.0f) - x - z;
    const Mask below = y < Float(0.0f);
    const Float px = Select(below, Float(1.0f) - z, x);
    const Float pz = Select(below, Float(1.0f) - x, z);
    const Float length2 = px * px + y * y + pz * pz;
    const Float solid_angle = Float(4.0f * cell * cell) / (length2 * Sqrt(length2));
    StoreTexels(sum * Float(0.25f), solid_angle, first, task.size, task.out);
  }
}

void FilterLobeRow(const LobeRowTask& task) {
  for (std::int32_t first = 0; first <= task.size; first += static_cast<std::int32_t>(LaneCount())) {
    const Vec3<Float> n = DirectionFromOctahedron(NodesOfRow(first, task.row, task.size));
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
          SampleCells(task.texels, sample.size, sample.origin, OctahedronFromDirection(direction));
      sum += radiance * Float(sample.weight);
    }
    StoreTexels(sum, Float(0.0f), first, task.size, task.out);
  }
}

// What light from a direction weighs in each mean of a ConvolveRowTask.
FACET_INLINE void LobeWeights(const ConvolveRowTask& task, Float n_dot_l, Float (&weight)[kConvolvedLobes + 1]) {
  static_assert(kConvolvedLobes == 4);
  const Float cosine = Max(n_dot_l, Float(0.0f));
  const Float n_dot_h2 = Float(0.5f) + Float(0.5f) * cosine;  // the half-angle formula; view = normal
  Float t[kConvolvedLobes];
  for (int k = 0; k < kConvolvedLobes; ++k) {
    t[k] = n_dot_h2 * Float(task.alpha[k] * task.alpha[k] - 1.0f) + Float(1.0f);
  }
  // cosine / t^2 of each, by one division: 1 / t[0] = t[1] t[2] t[3] / (t[0] t[1] t[2] t[3]).
  const Float t01 = t[0] * t[1], t23 = t[2] * t[3];
  const Float inverse = Float(1.0f) / (t01 * t23);
  const Float inverse01 = inverse * t23, inverse23 = inverse * t01;
  const Float inverse_t[kConvolvedLobes] = {inverse01 * t[1], inverse01 * t[0], inverse23 * t[3], inverse23 * t[2]};
  for (int k = 0; k < kConvolvedLobes; ++k) weight[k] = cosine * inverse_t[k] * inverse_t[k];
  weight[kConvolvedLobes] = cosine;
}

void ConvolveRow(const ConvolveRowTask& task) {
  for (std::int32_t first = 0; first <= task.size; first += static_cast<std::int32_t>(LaneCount())) {
    const Vec3<Float> n = DirectionFromOctahedron(NodesOfRow(first, task.row, task.size));
    const auto cosine_to = [&](float x, float y, float z) HWY_ATTR {
      return n.x * Float(x) + n.y * Float(y) + n.z * Float(z);
    };
    Vec3<Float> sum[kConvolvedLobes + 1] = {};
    Float norm[kConvolvedLobes + 1] = {};
    Float weight[kConvolvedLobes + 1];
    for (std::int32_t i = 0; i < task.source_count; ++i) {
      const SourceTexel& source = task.source[i];
      const Float center = cosine_to(source.center_x, source.center_y, source.center_z);
      const Float light = cosine_to(source.x, source.y, source.z);
      if (!Any(Max(center, light) > Float(0.0f))) continue;
      LobeWeights(task, center, weight);
      for (int k = 0; k <= kConvolvedLobes; ++k) norm[k] += weight[k] * Float(source.solid_angle);
      LobeWeights(task, light, weight);
      const Vec3<Float> power = {Float(source.r), Float(source.g), Float(source.b)};
      for (int k = 0; k <= kConvolvedLobes; ++k) sum[k] += power * weight[k];
    }
    for (int k = 0; k <= kConvolvedLobes; ++k) {
      StoreTexels(sum[k] / norm[k], Float(0.0f), first, task.size, task.out[k]);
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
