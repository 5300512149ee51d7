// The input and the result of a fragment shader. T is Float (lanes), float or double.

#if defined(FACET_SHADER_SURFACE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FACET_SHADER_SURFACE_INL_H_
#undef FACET_SHADER_SURFACE_INL_H_
#else
#define FACET_SHADER_SURFACE_INL_H_
#endif

#include "facet/shader/vec-inl.h"

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace HWY_NAMESPACE {

inline constexpr int kSurfaceUvSlots = 32;  // more than any material has textures

// The surface at one fragment. World axes.
template <class T>
struct Surface {
  Vec3<T> position;  // metres, relative to the eye
  Vec3<T> view;      // unit, towards the eye
  Vec3<T> normal;    // unit, interpolated, on the viewer's side
  // Interpolated but not normalised, as MikkTSpace demands for normal mapping; tangent.w is the handedness. The
  // tangent is zero unless the material has a texture in tangent space that could be decoded, or is anisotropic.
  Vec3<T> interpolated_normal;
  Vec4<T> tangent;
  // By how much the square of GGX's alpha grows where the pixel's reflections are filtered, because the normal turns
  // within the pixel; 0 where it does not, or where specular antialiasing is off.
  T footprint_alpha2{};
  Vec4<T> color;     // vertex colour, linear; 1 where there is none
  // Metres per unit of the mesh, in which thickness is stated, where a volume begins behind the surface; 0 behind its
  // back faces, which begin none. Zero too if the material has no volume.
  T metres_per_unit;
  // Texture coordinates of each UV set that the material reads, and their derivatives over one pixel to the right and
  // down. The other sets are zero.
  Vec2<T> uv[kSurfaceUvSlots], duv_dx[kSurfaceUvSlots], duv_dy[kSurfaceUvSlots];
};

template <class T>
struct Shaded {
  Vec3<T> color;  // linear radiance towards the eye, not multiplied by alpha
  T alpha;        // coverage
};

}  // namespace HWY_NAMESPACE
}  // namespace facet
HWY_AFTER_NAMESPACE();

#endif
