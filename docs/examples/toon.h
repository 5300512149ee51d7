// Three bands of light from one lamp behind the viewer's shoulder, and a dark outline where the surface turns away.
#include "facet/shader/shader-inl.h"
#include "toon_parameters.h"

FACET_SHADER_BEGIN
struct Toon {
  ToonParameters parameters;
  static constexpr LightUse kLight = LightUse::None;  // of the scene: it brings its own lamp
  template <class T>
  FACET_INLINE Shaded<T> operator()(const Surface<T>& surface, const MaterialView<T>& material,
                                    const LightingView<T>&) const {
    const Vec4<T> paint = material.BaseColor(surface);
    const Vec3<T> to_lamp{T(0.48f), T(0.64f), T(0.6f)};  // unit, world axes
    const T lit = Max(Dot(material.Normal(surface), to_lamp), T(0.0f));
    const T band = Select(lit > T(parameters.shine_above), T(1.0f),
                          Select(lit > T(parameters.shade_below), T(0.5f), T(0.2f)));
    const auto outline = Dot(surface.normal, surface.view) < T(0.25f);
    return {Xyz(paint) * Select(outline, T(0.0f), band), paint.w};
  }
};
FACET_SHADER_END
