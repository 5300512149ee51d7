// Shows the first texture coordinates of a surface, and in blue the sum of all its other coordinates and derivatives.
#include "facet/shader/shader-inl.h"

FACET_SHADER_BEGIN
struct ShowTextureCoordinates {
  static constexpr LightUse kLight = LightUse::None;
  template <class T>
  FACET_INLINE Shaded<T> operator()(const Surface<T>& surface, const MaterialView<T>&, const LightingView<T>&) const {
    T others(0.0f);
    const auto add = [&others](const Vec2<T>& v) HWY_ATTR { others = others + (Abs(v.x) + Abs(v.y)); };
    for (int i = 0; i < kSurfaceUvSlots; ++i) {
      if (i > 0) add(surface.uv[i]);
      add(surface.duv_dx[i]);
      add(surface.duv_dy[i]);
    }
    return {{surface.uv[0].x, surface.uv[0].y, others}, T(1.0f)};
  }
};
FACET_SHADER_END
