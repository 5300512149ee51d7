// The tone curve of Gran Turismo 7 (H. Uchimura and K. Suzuki, 2025, "Driving Toward Reality: Physically Based Tone
// Mapping and Perceptual Fidelity in Gran Turismo 7", SIGGRAPH course on physically based shading), for a display of
// standard range. A curve with toe, straight part and shoulder is applied to each channel in Rec. 2020; the result is
// mixed with one whose hue is that of the light itself, in the space ICtCp (Recommendation ITU-R BT.2100).
//
// The light's unit, 1, is 100 cd/m2 there, and the display's white 250 cd/m2.

#if defined(FACET_COLOR_GT7_CURVE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FACET_COLOR_GT7_CURVE_INL_H_
#undef FACET_COLOR_GT7_CURVE_INL_H_
#else
#define FACET_COLOR_GT7_CURVE_INL_H_
#endif

#include "color/tone_curve-inl.h"

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace HWY_NAMESPACE {

// The perceptual quantizer of SMPTE ST 2084: light in units of 100 cd/m2 to [0, 1], and back.
template <class T>
FACET_INLINE T PqFromLight(T light) {
  const T y = Pow(Max(light, T(0.0f)) * T(0.01f), T(0.1593017578125f));
  return Pow((T(0.8359375f) + T(18.8515625f) * y) / (T(1.0f) + T(18.6875f) * y), T(78.84375f));
}
template <class T>
FACET_INLINE T LightFromPq(T code) {
  const T n = Pow(Clamp(code, T(0.0f), T(1.0f)), T(1.0f / 78.84375f));
  const T y = Max(n - T(0.8359375f), T(0.0f)) / (T(18.8515625f) - T(18.6875f) * n);
  return Pow(y, T(1.0f / 0.1593017578125f)) * T(100.0f);
}

// Intensity, tritan and protan of Rec. 2020 light, and back.
template <class T>
FACET_INLINE Vec3<T> IctcpFromRec2020(Vec3<T> light) {
  constexpr float kCones[9] = {1688.0f / 4096, 2146.0f / 4096, 262.0f / 4096, 683.0f / 4096, 2951.0f / 4096,
                               462.0f / 4096,  99.0f / 4096,   309.0f / 4096, 3688.0f / 4096};
  constexpr float kOpponent[9] = {
      0.5f,          0.5f, 0.0f, 6610.0f / 4096, -13613.0f / 4096, 7003.0f / 4096, 17933.0f / 4096, -17390.0f / 4096,
      -543.0f / 4096};
  const Vec3<T> c = Transform(kCones, light);
  return Transform(kOpponent, Vec3<T>{PqFromLight(c.x), PqFromLight(c.y), PqFromLight(c.z)});
}
template <class T>
FACET_INLINE Vec3<T> Rec2020FromIctcp(Vec3<T> color) {
  constexpr float kCodes[9] = {1.0f, 0.00860904f, 0.11103f, 1.0f, -0.00860904f, -0.11103f, 1.0f, 0.560031f, -0.320627f};
  constexpr float kLight[9] = {3.43661f,   -2.50645f,   0.06984f,    -0.79133f, 1.9836f,
                               -0.192271f, -0.0259499f, -0.0989137f, 1.12486f};
  const Vec3<T> c = Transform(kCodes, color);
  return Transform(kLight, Vec3<T>{LightFromPq(c.x), LightFromPq(c.y), LightFromPq(c.z)});
}

template <class T>
FACET_INLINE T Smoothstep(T low, T high, T x) {
  const T t = Clamp((x - low) / (high - low), T(0.0f), T(1.0f));
  return t * t * (T(3.0f) - T(2.0f) * t);
}

template <class T>
FACET_INLINE Vec3<T> Gt7Curve(Vec3<T> light) {
  // The curve: a toe up to `kMiddle`, a straight part up to `kStraight` of the peak, an exponential shoulder.
  constexpr float kPeak = 2.5f, kAlpha = 0.25f, kMiddle = 0.538f, kStraight = 0.444f, kToe = 1.28f;
  constexpr float kSlope = (kStraight - 1.0f) / (kAlpha - 1.0f);
  const auto curve = [](T x) HWY_ATTR {
    const T straight = Smoothstep(T(0.0f), T(kMiddle), x);
    const T toe = T(kMiddle) * Pow(Max(x, T(0.0f)) * T(1.0f / kMiddle), T(kToe));
    const T exponent = (T(kStraight * kPeak) - x) * T(1.0f / (kSlope * kPeak));
    const T shoulder = T(kPeak * kStraight + kPeak * kSlope) - T(kPeak * kSlope) * Exp(Min(exponent, T(0.0f)));
    const T below = toe * (T(1.0f) - straight) + x * straight;
    return Select(x < T(kStraight * kPeak), below, shoulder);
  };
  constexpr float kBlend = 0.6f, kFadeStart = 0.98f, kFadeEnd = 1.16f;
  // Beyond what the quantizer holds, nothing changes any more.
  const Vec3<T> rec2020 = Transform(kRec2020FromRec709, Clamp(light, T(0.0f), T(100.0f)));
  const Vec3<T> by_channel{curve(rec2020.x), curve(rec2020.y), curve(rec2020.z)};
  const Vec3<T> before = IctcpFromRec2020(rec2020), after = IctcpFromRec2020(by_channel);
  const T peak = PqFromLight(T(kPeak));
  const T chroma = T(1.0f) - Smoothstep(T(kFadeStart), T(kFadeEnd), before.x / peak);
  const Vec3<T> of_hue = Rec2020FromIctcp(Vec3<T>{after.x, before.y * chroma, before.z * chroma});
  const Vec3<T> mixed = by_channel * T(1.0f - kBlend) + of_hue * T(kBlend);
  const Vec3<T> shown = Clamp(mixed, T(0.0f), T(kPeak)) * T(1.0f / kPeak);
  return Clamp(Transform(kRec709FromRec2020, shown), T(0.0f), T(1.0f));
}

}  // namespace HWY_NAMESPACE
}  // namespace facet
HWY_AFTER_NAMESPACE();

#endif
