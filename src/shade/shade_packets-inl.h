// Runs a fragment shader functor over a batch of fragments, one packet of lanes at a time.

#if defined(FACET_SHADE_SHADE_PACKETS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FACET_SHADE_SHADE_PACKETS_INL_H_
#undef FACET_SHADE_SHADE_PACKETS_INL_H_
#else
#define FACET_SHADE_SHADE_PACKETS_INL_H_
#endif

#include <type_traits>

#include "light/lighting-inl.h"
#include "material/models/seen_through-inl.h"
#include "shade/interpolate-inl.h"
#include "shade/material_view-inl.h"

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace HWY_NAMESPACE {

// What a functor returns, as colour and alpha.
template <class T>
FACET_INLINE const Shaded<T>& OwnOf(const Shaded<T>& shaded) {
  return shaded;
}
template <class T>
FACET_INLINE const Shaded<T>& OwnOf(const ShadedThrough<T>& shaded) {
  return shaded.own;
}

// The other results of fragments i and after, if the task wants them. Those that are not finite let nothing pass.
template <class T>
FACET_INLINE void StoreSeenThrough(const ShadeTask&, const Surface<T>&, std::size_t, const Shaded<T>&) {}
template <class T>
FACET_INLINE void StoreSeenThrough(const ShadeTask& task, const Surface<T>& surface, std::size_t i,
                                   const ShadedThrough<T>& shaded) {
  if (task.seen_through == nullptr) return;
  const SeenThroughOutputs& out = *task.seen_through;
  const T zero(0.0f), one(1.0f);
  const auto put = [i](T value, float* to) HWY_ATTR {
    if constexpr (std::is_same_v<T, double>) {
      to[i] = static_cast<float>(value);
    } else {
      Store(value, to + i);
    }
  };
  const auto row = [&](int k, const Vec3<T>& v) HWY_ATTR {
    const float* m = task.screen_from_eye[k];
    return T(m[0]) * v.x + T(m[1]) * v.y + T(m[2]) * v.z;
  };
  const T tint[3] = {shaded.tint.x, shaded.tint.y, shaded.tint.z};
  for (int c = 0; c < 3; ++c) put(Select(IsFinite(tint[c]), Clamp(tint[c], zero, one), zero), out.tint[c]);
  put(shaded.spread * T(task.pixels_per_tangent), out.blur);
  const T distance = task.orthographic ? one : Max(row(2, surface.position), T(1e-30f));
  const T x = row(0, surface.position) / distance, y = row(1, surface.position) / distance;
  const int channels = task.material->Has(kDispersion) ? 3 : 1;
  for (int c = 0; c < channels; ++c) {
    // The exit point's pixel minus the fragment's: (x d + dx) / (d + farther) - x. Exits do not come near the eye.
    const Vec3<T>& path = shaded.path[c];
    const T farther = task.orthographic ? zero : row(2, path);
    const T exit = Max(distance + farther, distance * T(1e-3f));
    const auto bounded = [&](T shift) HWY_ATTR {
      constexpr float kMost = 0x1p20f;  // pixels
      return Select(IsFinite(shift), Clamp(shift, T(-kMost), T(kMost)), zero);
    };
    put(bounded((row(0, path) - x * farther) / exit), out.shift_x[c]);
    put(bounded((row(1, path) - y * farther) / exit), out.shift_y[c]);
  }
}

// Shades by a model that returns ShadedThrough. Surfaces that are seen through cover what their alpha mode says.
template <class Model>
struct ModelSeenThrough {
  const ShadeTask& task;

  template <class T, class Material, class Lighting>
  FACET_INLINE ShadedThrough<T> operator()(const Surface<T>& surface, const Material& material,
                                           const Lighting& lighting) const {
    ShadedThrough<T> shaded = Model::Through(surface, material, lighting);
    if (task.seen_through == nullptr) return shaded;
    T& alpha = shaded.own.alpha;
    if (task.material->alpha_mode == AlphaMode::Opaque) alpha = T(1.0f);
    if (task.material->alpha_mode == AlphaMode::Mask) {
      alpha = Select(alpha >= T(task.material->factors.alpha_cutoff), T(1.0f), T(0.0f));
    }
    return shaded;
  }
};

// Shades all fragments of a task. The texels of the next packet are prefetched before the current one is shaded, which
// hides the latency of memory. Lanes beyond the end of the batch shade the caller's padding; their results are unused.
// `surfaces`: for the current packet and the next one. Texture coordinates that the material does not read keep the
// values that they have there; shading models do not read them.
template <class Shader>
FACET_INLINE void ShadePackets(const ShadeTask& task, const Shader& shader, Surface<Float> (&surfaces)[2]) {
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
    const auto result = shader(surfaces[buffer], material, lighting);
    StoreSeenThrough(task, surfaces[buffer], i, result);
    const Shaded<Float>& shaded = OwnOf(result);
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

// The same for users' shaders: texture coordinates and lengths that the material does not read are zero. Shading models
// do without this clearing, because in batches of few fragments it would take up to 6 % more instructions.
template <class Shader>
FACET_INLINE void ShadePackets(const ShadeTask& task, const Shader& shader) {
  Surface<Float> surfaces[2];
  const int used = task.count > LaneCount() ? 2 : 1;
  for (int buffer = 0; buffer < used; ++buffer) {
    Surface<Float>& s = surfaces[buffer];
    for (int k = task.material->uv_slots; k < kSurfaceUvSlots; ++k) {
      s.uv[k] = s.duv_dx[k] = s.duv_dy[k] = Vec2<Float>{};
    }
    s.metres_per_unit = Float(0.0f);
  }
  ShadePackets(task, shader, surfaces);
}

}  // namespace HWY_NAMESPACE
}  // namespace facet
HWY_AFTER_NAMESPACE();

#endif
