// Colour grading: changes to exposed linear light, Rec. 709, before the tone curve. In this order: white balance,
// contrast, saturation, curves (as in Filament's colour grading; Guy and Agopian, Filament, "Color grading").

#if defined(FACET_COLOR_GRADING_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FACET_COLOR_GRADING_INL_H_
#undef FACET_COLOR_GRADING_INL_H_
#else
#define FACET_COLOR_GRADING_INL_H_
#endif

#include "color/grading.h"
#include "color/tone_curve-inl.h"

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace HWY_NAMESPACE {

// Light of any sign comes out as light of 0 or more.
template <class T>
FACET_INLINE Vec3<T> Grade(const GradingFactors& grading, Vec3<T> light) {
  const T zero(0.0f);
  Vec3<T> c = BoundLight(light);
  if (grading.balances_white) c = BoundLight(Transform(grading.white_balance, c));
  if (grading.contrast != 1.0f) {
    // A power around middle grey, which is a line in stops.
    constexpr float kMiddleGrey = 0.18f;
    const auto steeper = [&](T x)
                             HWY_ATTR { return T(kMiddleGrey) * Pow(x * T(1.0f / kMiddleGrey), T(grading.contrast)); };
    c = BoundLight(Vec3<T>{steeper(c.x), steeper(c.y), steeper(c.z)});
  }
  if (grading.saturation != 1.0f) {
    const T luminance = T(0.2126f) * c.x + T(0.7152f) * c.y + T(0.0722f) * c.z, share(grading.saturation);
    const auto saturated = [&](T x) HWY_ATTR { return Max(luminance + (x - luminance) * share, zero); };
    c = {saturated(c.x), saturated(c.y), saturated(c.z)};
  }
  if (grading.has_curves) {
    // Below the middle a power with the middle fixed, above it a line through the middle.
    const auto curved = [&](int channel, T x) HWY_ATTR {
      const T middle(grading.middle[channel]);
      const T dark = middle * Pow(x / middle, T(grading.gamma[channel]));
      return Select(x <= middle, dark, middle + (x - middle) * T(grading.scale[channel]));
    };
    c = BoundLight(Vec3<T>{curved(0, c.x), curved(1, c.y), curved(2, c.z)});
  }
  return c;
}

}  // namespace HWY_NAMESPACE
}  // namespace facet
HWY_AFTER_NAMESPACE();

#endif
