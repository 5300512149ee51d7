// Runs a fragment shader functor over a batch of fragments, one packet of lanes at a time.

#if defined(FACET_SHADE_SHADE_PACKETS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FACET_SHADE_SHADE_PACKETS_INL_H_
#undef FACET_SHADE_SHADE_PACKETS_INL_H_
#else
#define FACET_SHADE_SHADE_PACKETS_INL_H_
#endif

#include "light/lighting-inl.h"
#include "shade/interpolate-inl.h"
#include "shade/material_view-inl.h"

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace HWY_NAMESPACE {

// Shades all fragments of a task. The texels of the next packet are prefetched before the current one is shaded, which
// hides the latency of memory. Lanes beyond the end of the batch shade the caller's padding; their results are unused.
// `surfaces`: for the current packet and the next one. Texture coordinates that the material does not read keep the
// values that they have there; shading models do not read them.
template <class Shader>
HWY_INLINE void ShadePackets(const ShadeTask& task, const Shader& shader, Surface<Float> (&surfaces)[2]) {
  const LightingView<Float> lighting(*task.lighting);
  const std::size_t lanes = LaneCount();
  TextureReader<Float> readers[2] = {TextureReader<Float>(surfaces[0]), TextureReader<Float>(surfaces[1])};
  const auto prepare = [&](std::size_t first, int buffer) HWY_ATTR {
    InterpolateSurface(task, first, surfaces[buffer]);
    readers[buffer].ReadAhead(*task.material);
  };
  if (task.count > 0) prepare(0, 0);
  int buffer = 0;
  for (std::size_t i = 0; i < task.count; i += lanes, buffer = 1 - buffer) {
    if (i + lanes < task.count) prepare(i + lanes, 1 - buffer);
    const MaterialView<Float> material(*task.material, &readers[buffer]);
    const Shaded<Float> shaded = shader(surfaces[buffer], material, lighting);
    const Vec3<Float> c = shaded.color;
    const Mask finite = IsFinite(c.x) & IsFinite(c.y) & IsFinite(c.z) & IsFinite(shaded.alpha);
    const Float zero(0.0f);
    Store(Select(finite, c.x, zero), task.red + i);
    Store(Select(finite, c.y, zero), task.green + i);
    Store(Select(finite, c.z, zero), task.blue + i);
    Store(Select(finite, Clamp(shaded.alpha, zero, Float(1.0f)), zero), task.alpha + i);
    if (!All(finite)) {
      std::uint32_t bad = ~BitsOf(finite);
      const std::size_t left = task.count - i < lanes ? task.count - i : lanes;
      bad &= (1u << left) - 1u;
      *task.non_finite += static_cast<std::uint64_t>(__builtin_popcount(bad));
    }
  }
}

// The same for users' shaders: texture coordinates that the material does not read are zero. Shading models do without
// this clearing, because in batches of few fragments it would take up to 6 % more instructions.
template <class Shader>
HWY_INLINE void ShadePackets(const ShadeTask& task, const Shader& shader) {
  Surface<Float> surfaces[2];
  const int used = task.count > LaneCount() ? 2 : 1;
  for (int buffer = 0; buffer < used; ++buffer) {
    Surface<Float>& s = surfaces[buffer];
    for (int k = task.material->uv_slots; k < kSurfaceUvSlots; ++k) {
      s.uv[k] = s.duv_dx[k] = s.duv_dy[k] = Vec2<Float>{};
    }
  }
  ShadePackets(task, shader, surfaces);
}

}  // namespace HWY_NAMESPACE
}  // namespace facet
HWY_AFTER_NAMESPACE();

#endif
