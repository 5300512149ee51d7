// Tone curves: exposed linear light, Rec. 709, to display-linear [0, 1]. They accept any input: negative values and NaN
// count as 0, and light is clamped to 2^40, where all curves have long reached their limit.

#if defined(FACET_COLOR_TONE_CURVE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FACET_COLOR_TONE_CURVE_INL_H_
#undef FACET_COLOR_TONE_CURVE_INL_H_
#else
#define FACET_COLOR_TONE_CURVE_INL_H_
#endif

#include "facet/shader/elementary-inl.h"
#include "facet/shader/vec-inl.h"

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace HWY_NAMESPACE {

template <class T>
FACET_INLINE Vec3<T> Clamp(Vec3<T> a, T low, T high) {
  return {Clamp(a.x, low, high), Clamp(a.y, low, high), Clamp(a.z, low, high)};
}

// Non-negative and small enough to be squared; Clamp gives its lower bound for NaN.
template <class T>
FACET_INLINE Vec3<T> BoundLight(Vec3<T> light) {
  return Clamp(light, T(0.0f), T(0x1p40f));
}

// A matrix of nine constants, rows first, times a column.
template <class T>
FACET_INLINE Vec3<T> Transform(const float (&m)[9], Vec3<T> a) {
  return {T(m[0]) * a.x + T(m[1]) * a.y + T(m[2]) * a.z, T(m[3]) * a.x + T(m[4]) * a.y + T(m[5]) * a.z,
          T(m[6]) * a.x + T(m[7]) * a.y + T(m[8]) * a.z};
}

// Between the primaries of Recommendations ITU-R BT.709 and BT.2020, of light, to four digits, as AgX' sources have them.
inline constexpr float kRec2020FromRec709[9] = {0.6274f, 0.3293f, 0.0433f, 0.0691f, 0.9195f,
                                                0.0113f, 0.0164f, 0.0880f, 0.8956f};
inline constexpr float kRec709FromRec2020[9] = {1.6605f,  -0.5876f, -0.0728f, -0.1246f, 1.1329f,
                                                -0.0083f, -0.0182f, -0.1006f, 1.1187f};

// No curve: clamps to 1.
template <class T>
FACET_INLINE Vec3<T> ClampCurve(Vec3<T> light) {
  return Clamp(light, T(0.0f), T(1.0f));
}

// c / (1 + c) per channel. E. Reinhard, M. Stark, P. Shirley, J. Ferwerda, 2002, "Photographic Tone Reproduction for
// Digital Images", equation 3; there on luminance, here on each channel, as lectures teach it.
template <class T>
FACET_INLINE Vec3<T> ReinhardCurve(Vec3<T> light) {
  const Vec3<T> c = BoundLight(light);
  const T one = T(1.0f);
  return {c.x / (one + c.x), c.y / (one + c.y), c.z / (one + c.z)};
}

// Stephen Hill's fit of the ACES reference rendering transform and sRGB output transform (S. Hill, 2016, in
// "BakingLab" by M. Pettineo and D. Neubelt), with the light divided by 0.6 first, as glTF engines use it to bring
// middle grey to its place.
template <class T>
FACET_INLINE Vec3<T> AcesCurve(Vec3<T> light) {
  // Rec. 709 to AP1 with the saturation of the rendering transform, and back with that of the output transform.
  constexpr float kInput[9] = {0.59719f, 0.35458f, 0.04823f, 0.07600f, 0.90834f,
                               0.01566f, 0.02840f, 0.13383f, 0.83777f};
  constexpr float kOutput[9] = {1.60475f,  -0.53108f, -0.07367f, -0.10208f, 1.10813f,
                                -0.00605f, -0.00327f, -0.07276f, 1.07602f};
  const Vec3<T> v = Transform(kInput, BoundLight(light) * T(1.0f / 0.6f));
  const auto fit = [](T x) HWY_ATTR {
    const T numerator = x * (x + T(0.0245786f)) - T(0.000090537f);
    const T denominator = x * (T(0.983729f) * x + T(0.4329510f)) + T(0.238081f);
    return numerator / denominator;
  };
  return Clamp(Transform(kOutput, Vec3<T>{fit(v.x), fit(v.y), fit(v.z)}), T(0.0f), T(1.0f));
}

// K. Narkowicz's fit of the ACES curve, per channel (2016, "ACES Filmic Tone Mapping Curve"). Filament's "filmic".
template <class T>
FACET_INLINE Vec3<T> FilmicCurve(Vec3<T> light) {
  const Vec3<T> c = BoundLight(light);
  const auto fit = [](T x) HWY_ATTR {
    return (x * (T(2.51f) * x + T(0.03f))) / (x * (T(2.43f) * x + T(0.59f)) + T(0.14f));
  };
  return Clamp(Vec3<T>{fit(c.x), fit(c.y), fit(c.z)}, T(0.0f), T(1.0f));
}

// Filament's "generic" curve with its defaults: s x^c / (x^c + r), with the contrast c = 1.55, and s and r such that
// light of 0.18 becomes 0.215, and light of 10 white.
template <class T>
FACET_INLINE Vec3<T> GenericCurve(Vec3<T> light) {
  constexpr float kContrast = 1.55f, kMiddle = 0.215f;
  constexpr double kIn = 0.0700926343770688, kWhite = 35.48133892335755;  // 0.18^1.55 and 10^1.55
  constexpr double kBelow = kIn - double{kMiddle} * kWhite;
  constexpr auto kInput = static_cast<float>(kIn * kWhite * (double{kMiddle} - 1.0) / kBelow);
  constexpr auto kOutput = static_cast<float>(double{kMiddle} * (kIn - kWhite) / kBelow);
  const Vec3<T> c = BoundLight(light);
  const auto fit = [](T x) HWY_ATTR {
    const T power = Pow(Min(x, T(10.0f)), T(kContrast));
    return T(kOutput) * power / (power + T(kInput));
  };
  return Clamp(Vec3<T>{fit(c.x), fit(c.y), fit(c.z)}, T(0.0f), T(1.0f));
}

// AgX's looks change the curve's result before it is made linear: a slope, a power and a saturation.
struct AgXLook {
  float slope[3] = {1, 1, 1};
  float power = 1.0f, saturation = 1.0f;
};
inline constexpr AgXLook kAgXBase{}, kAgXGolden{{1.0f, 0.9f, 0.5f}, 0.8f, 1.3f}, kAgXPunchy{{1, 1, 1}, 1.35f, 1.4f};

// AgX. T. Sobotka, 2022, "AgX"; the sixth-degree fit of its contrast curve is B. Wrensch's, 2023, "Minimal
// AgX Implementation"; working space and matrices as in Filament and three.js: Rec. 2020, inset, log2 of [-12.47393,
// 4.026069] stops, curve, outset, and 2.2 to the linear light that sRGB encodes afterwards.
template <class T>
FACET_INLINE Vec3<T> AgXCurve(Vec3<T> light, const AgXLook& look) {
  constexpr float kInset[9] = {0.856627153315983f, 0.0951212405381588f, 0.0482516061458583f,
                               0.137318972929847f, 0.761241990602591f,  0.101439036467562f,
                               0.11189821299995f,  0.0767994186031903f, 0.811302368396859f};
  constexpr float kOutset[9] = {1.1271005818144368f,   -0.11060664309660323f, -0.016493938717834573f,
                                -0.1413297634984383f,  1.157823702216272f,    -0.016493938717834257f,
                                -0.14132976349843826f, -0.11060664309660294f, 1.2519364065950405f};
  const Vec3<T> v = Transform(kInset, Transform(kRec2020FromRec709, BoundLight(light)));
  const auto curve = [](T x) HWY_ATTR {
    constexpr float kLow = -12.47393f, kHigh = 4.026069f;
    const T stops = (Log2(Max(x, T(1e-10f))) - T(kLow)) / T(kHigh - kLow);
    const T t = Clamp(stops, T(0.0f), T(1.0f));
    constexpr float kContrast[] = {-0.00232f, 0.1191f, 0.4298f, -6.868f, 31.96f, -40.14f, 15.5f};
    T sum = T(kContrast[6]);
    for (int i = 5; i >= 0; --i) sum = sum * t + T(kContrast[i]);
    return sum;
  };
  Vec3<T> curved{curve(v.x), curve(v.y), curve(v.z)};
  if (look.power != 1.0f || look.saturation != 1.0f) {
    const auto graded = [&](T x, float slope) HWY_ATTR { return Pow(Max(x * T(slope), T(0.0f)), T(look.power)); };
    curved = {graded(curved.x, look.slope[0]), graded(curved.y, look.slope[1]), graded(curved.z, look.slope[2])};
    const T luminance = T(0.2126f) * curved.x + T(0.7152f) * curved.y + T(0.0722f) * curved.z;
    const Vec3<T> grey{luminance, luminance, luminance};
    curved = grey + (curved - grey) * T(look.saturation);
  }
  const Vec3<T> seen = Transform(kOutset, curved);
  const auto linear = [](T x) HWY_ATTR { return Pow(Max(x, T(0.0f)), T(2.2f)); };
  const Vec3<T> rec2020{linear(seen.x), linear(seen.y), linear(seen.z)};
  return Clamp(Transform(kRec709FromRec2020, rec2020), T(0.0f), T(1.0f));
}

template <class T>
FACET_INLINE Vec3<T> AgXCurve(Vec3<T> light) {
  return AgXCurve(light, kAgXBase);
}

// Khronos PBR Neutral. Khronos Group (E. Chalmers), 2024, "Khronos PBR Neutral Tone Mapper" specification: base colours
// below 0.8 come out as they are, the rest is compressed and loses saturation.
template <class T>
FACET_INLINE Vec3<T> NeutralCurve(Vec3<T> light) {
  const T start_compression = T(0.8f - 0.04f), one = T(1.0f);
  const T desaturation = T(0.15f);
  Vec3<T> c = BoundLight(light);
  const T least = Min(c.x, Min(c.y, c.z));
  const T offset = Select(least < T(0.08f), least - T(6.25f) * least * least, T(0.04f));
  c = {c.x - offset, c.y - offset, c.z - offset};
  const T peak = MaxComponent(c);
  const auto bright = peak >= start_compression;
  if (!Any(bright)) return Clamp(c, T(0.0f), one);
  const T d = one - start_compression;
  const T new_peak = one - d * d / (peak + d - start_compression);
  const T safe_peak = Select(bright, peak, one);
  const Vec3<T> scaled = c * (new_peak / safe_peak);
  const T white = one - one / (desaturation * (peak - new_peak) + one);
  const Vec3<T> compressed = Mix(scaled, Vec3<T>{new_peak, new_peak, new_peak}, white);
  // Rounding may exceed the ends of the range.
  return Clamp(Select(bright, compressed, c), T(0.0f), one);
}

}  // namespace HWY_NAMESPACE
}  // namespace facet
HWY_AFTER_NAMESPACE();

#endif
