// Elementary functions: Exp2, Log2, Exp, Log, Pow, Cbrt, Sin, Cos, Atan2, Asin, Acos of T = Float (lanes) or float, the
// same bits on every instruction set and for both types; of double through elementary_double.h.
//
// Each is one fixed sequence of IEEE 754 operations: exact splitting of the argument, then a polynomial from
// src/math/fit_polynomials.py. Errors are in ULP (units in the last place of the exact result); tests/math asserts
// them, and its ulp_table measures them over all floats of the domain (Pow and Atan2, of two arguments, are searched).
//
// Special values are those of IEEE 754-2019, clause 9.2, unless a line says otherwise; NaN in gives NaN out.

#if defined(FACET_SHADER_ELEMENTARY_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FACET_SHADER_ELEMENTARY_INL_H_
#undef FACET_SHADER_ELEMENTARY_INL_H_
#else
#define FACET_SHADER_ELEMENTARY_INL_H_
#endif

#include <bit>
#include <cstdint>
#include <limits>

#include "facet/shader/elementary_double.h"
#include "facet/shader/lane-inl.h"
#include "facet/shader/lookup-inl.h"

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace HWY_NAMESPACE {

// --- Bits of float and Float ---------------------------------------------------------------------------------------

FACET_INLINE std::int32_t BitsOf(float a) { return std::bit_cast<std::int32_t>(a); }
FACET_INLINE float FloatFromBits(std::int32_t a) { return std::bit_cast<float>(a); }
FACET_INLINE float ToFloat(std::int32_t a) { return static_cast<float>(a); }
void BitsOf(double) = delete;  // functions built on bits are for float; those of double are separate

// --- Parts ----------------------------------------------------------------------------------------------------------

// c[0] + x (c[1] + x (c[2] + ...)), by Horner's rule.
template <class T, int kCount>
FACET_INLINE T Polynomial(T x, const float (&c)[kCount]) {
  T sum = T(c[kCount - 1]);
  for (int i = kCount - 2; i >= 0; --i) sum = sum * x + T(c[i]);
  return sum;
}

// The first 12 bits of the significand: the product of two such numbers is exact, and so is x - HighHalf(x).
template <class T>
FACET_INLINE T HighHalf(T x) {
  return FloatFromBits(BitsOf(x) & IntOf<T>(~0xFFF));
}

template <class T>
FACET_INLINE T QuietNan() {
  return T(std::numeric_limits<float>::quiet_NaN());
}

// x 2^n with one rounding at most, where |x| is in [0.5, 2] and n in [-252, 254].
template <class T>
FACET_INLINE T ScaleByPowerOfTwo(T x, IntOf<T> n) {
  using I = IntOf<T>;
  const I half = ShiftRightArithmetic<1>(n);  // 2^n itself need not be a float
  return x * FloatFromBits(ShiftLeft<23>(half + I(127))) * FloatFromBits(ShiftLeft<23>(n - half + I(127)));
}

// x = significand 2^exponent with the significand in [sqrt(1/2), sqrt(2)), for finite x > 0.
template <class T>
struct Decomposed {
  T significand, exponent;
};
template <class T>
FACET_INLINE Decomposed<T> Decompose(T x) {
  using I = IntOf<T>;
  constexpr std::int32_t kSqrtHalf = 0x3F3504F3;
  const auto subnormal = x < T(0x1p-126f);
  const I bits = BitsOf(Select(subnormal, x * T(0x1p24f), x)) - I(kSqrtHalf);
  const T exponent = ToFloat(ShiftRightArithmetic<23>(bits));
  return {FloatFromBits((bits & I(0x7FFFFF)) + I(kSqrtHalf)), exponent - Select(subnormal, T(24.0f), T(0.0f))};
}

// 2^(n + f) for whole n in [-200, 200] and |f| <= 0.51.
template <class T>
FACET_INLINE T Exp2OfParts(T n, T f) {
  constexpr float kRest[] = {0x1.62e43p-1f,   0x1.ebfbep-3f,   0x1.c6b06cp-5f, 0x1.3b2a54p-7f,
                             0x1.5da97cp-10f, 0x1.44175ep-13f, 0x1.da62dcp-17f};
  return ScaleByPowerOfTwo(T(1.0f) + f * Polynomial(f, kRest), TruncateToInt(n));
}

// --- Exponentials and logarithms ------------------------------------------------------------------------------------

// 2^x. Below 1.1 ULP, subnormal results included.
template <class T>
FACET_INLINE T Exp2(T x) {
  const T bounded = Clamp(x, T(-151.0f), T(129.0f));  // beyond lie 0 and infinity
  const T n = RoundEven(bounded);
  return Select(x == x, Exp2OfParts(n, bounded - n), x);
}

// e^x. Below 1 ULP, subnormal results included.
template <class T>
FACET_INLINE T Exp(T x) {
  constexpr float kRest[] = {0x1p-1f, 0x1.555556p-3f, 0x1.5555p-5f, 0x1.110fc8p-7f, 0x1.6d308ep-10f, 0x1.a2cb1cp-13f};
  const T bounded = Clamp(x, T(-104.5f), T(89.5f));
  const T n = RoundEven(bounded * T(0x1.715476p+0f));
  // ln 2 in two parts; n times the first, of 15 bits, is exact.
  const T r = (bounded - n * T(0x1.62e4p-1f)) - n * T(0x1.7f7d1cp-20f);
  const T p = T(1.0f) + (r + r * r * Polynomial(r, kRest));
  return Select(x == x, ScaleByPowerOfTwo(p, TruncateToInt(n)), x);
}

// log2 x. Below 1.1 ULP. Log2(+-0) is -infinity, of a negative number NaN.
template <class T>
FACET_INLINE T Log2(T x) {
  constexpr float kRest[] = {-0x1.715476p-1f, 0x1.ec7094p-2f,  -0x1.7154c6p-2f, 0x1.277c44p-2f, -0x1.ec654ap-3f,
                             0x1.a476bep-3f,  -0x1.6fe35ep-3f, 0x1.5e1a2ap-3f,  -0x1.517e4p-3f, 0x1.82fa3ap-4f};
  const auto regular = (x > T(0.0f)) & (x < T(HUGE_VALF));
  const Decomposed<T> d = Decompose(Select(regular, x, T(1.0f)));
  const T f = d.significand - T(1.0f);
  // log2(1 + f) = f / ln 2 + f^2 rest(f). The leading product is exact: 1 / ln 2 and f are split in halves.
  const T f_high = HighHalf(f);
  const T leading = f_high * T(0x1.716p+0f);
  const T trailing = ((f - f_high) * T(0x1.716p+0f) - f * T(0x1.7135a8p-13f)) + f * f * Polynomial(f, kRest);
  // Exact sum of the exponent and the leading product, for |leading| < 1.
  const T sum = d.exponent + leading;
  const T lost = leading - (sum - d.exponent);
  const T special = Select(x == T(0.0f), T(-HUGE_VALF), Select(x > T(0.0f), x, QuietNan<T>()));
  return Select(regular, sum + (lost + trailing), special);
}

// ln x. Below 1 ULP. Log(+-0) is -infinity, of a negative number NaN.
template <class T>
FACET_INLINE T Log(T x) {
  constexpr float kRest[] = {0x1.555554p-2f,  -0x1.fffff2p-3f, 0x1.999d3ep-3f,  -0x1.555ea6p-3f, 0x1.23d80ep-3f,
                             -0x1.fc6382p-4f, 0x1.dd9aaep-4f,  -0x1.d9bfccp-4f, 0x1.24bac2p-4f};
  const auto regular = (x > T(0.0f)) & (x < T(HUGE_VALF));
  const Decomposed<T> d = Decompose(Select(regular, x, T(1.0f)));
  const T f = d.significand - T(1.0f);
  // ln(1 + f) = f - f^2 / 2 + f^3 rest(f); the exponent's ln 2 in two parts, smallest terms first.
  const T square = f * f;
  const T rest = square * f * Polynomial(f, kRest) + d.exponent * T(0x1.7f7d1cp-20f);
  const T result = d.exponent * T(0x1.62e4p-1f) + (f + (rest - T(0.5f) * square));
  const T special = Select(x == T(0.0f), T(-HUGE_VALF), Select(x > T(0.0f), x, QuietNan<T>()));
  return Select(regular, result, special);
}

// A number as an unevaluated sum, |low| <= ulp(high) / 2.
template <class T>
struct TwoFloats {
  T high, low;
};

// log2 x of finite x > 0 to about 2^-29 of its value, as the sum of two floats.
template <class T>
FACET_INLINE TwoFloats<T> ExtendedLog2(T x) {
  constexpr float kRest[] = {0x1.ec709ep-1f, 0x1.2776b4p-1f, 0x1.a5f092p-2f, 0x1.55c93p-2f};
  const Decomposed<T> d = Decompose(x);
  // log2(m) = (2 / ln 2) (s + s^3 / 3 + s^5 / 5 + ...) with s = (m - 1) / (m + 1), s to 36 bits.
  const T numerator = d.significand - T(1.0f);
  const T denominator = d.significand + T(1.0f);
  const T denominator_lost = d.significand - (denominator - T(1.0f));
  const T denominator_high = HighHalf(denominator);
  const T denominator_low = (denominator - denominator_high) + denominator_lost;
  const T s = numerator / denominator;
  const T s_high = HighHalf(s);
  const T s_low = ((numerator - s_high * denominator_high) - s_high * denominator_low) / denominator;
  const T z = s * s;
  const T leading = s_high * T(0x1.716p+1f);
  const T trailing = (s_low * T(0x1.716p+1f) - s * T(0x1.7135a8p-12f)) + s * z * Polynomial(z, kRest);
  const T sum = d.exponent + leading;
  const T rest = (leading - (sum - d.exponent)) + trailing;
  const T high = sum + rest;
  return {high, rest - (high - sum)};
}

// x^y for x >= 0; NaN for x < 0 (-0 counts as 0). Below 6 ULP (docs/determinism.md). Pow(x, 0) = Pow(1, y) = 1, even
// for NaN.
template <class T>
FACET_INLINE T Pow(T x, T y) {
  const T zero = T(0.0f), one = T(1.0f), infinity = T(HUGE_VALF);
  const auto regular = (x > zero) & (x < infinity);
  const TwoFloats<T> log = ExtendedLog2(Select(regular, x, one));
  // Beyond 2^34 every x but 1 has left the range of float; y (log.high + log.low) in two floats.
  const T exponent = Clamp(y, T(-0x1p34f), T(0x1p34f));
  const T exponent_high = HighHalf(exponent), exponent_low = exponent - exponent_high;
  const T log_high = HighHalf(log.high), log_low = log.high - log_high;
  const T product = exponent * log.high;
  const T lost = (((exponent_high * log_high - product) + exponent_high * log_low) + exponent_low * log_high) +
                 exponent_low * log_low;
  const T bounded = Clamp(product, T(-152.0f), T(130.0f));
  const T n = RoundEven(bounded);
  const T f = (bounded - n) + Select(bounded == product, lost + exponent * log.low, zero);
  const T at_zero = Select(y > zero, zero, infinity);
  const T at_infinity = Select(y > zero, infinity, zero);
  const T special = Select(x == zero, at_zero, Select(x == infinity, at_infinity, QuietNan<T>()));
  const T result = Select(y == y, Select(regular, Exp2OfParts(n, f), special), QuietNan<T>());
  return Select((y == zero) | (x == one), one, result);
}

// The cube root, of negative numbers too. Below 1 ULP.
template <class T>
FACET_INLINE T Cbrt(T x) {
  const T magnitude = Abs(x);
  const auto regular = (magnitude > T(0.0f)) & (magnitude < T(HUGE_VALF));
  const T a = Select(regular, magnitude, T(1.0f));
  const T guess = Exp2(Log2(a) * T(1.0f / 3.0f));
  const T root = guess - (guess - a / (guess * guess)) * T(1.0f / 3.0f);  // Newton
  return Select(regular, CopySign(root, x), x);
}

// --- Circular functions ---------------------------------------------------------------------------------------------

// |x| = quadrant pi/2 + high + low, |high| <= pi/4, for |x| <= 2^17.
template <class T>
struct ReducedAngle {
  T high, low;
  IntOf<T> quadrant;
};
template <class T>
FACET_INLINE ReducedAngle<T> ReduceAngle(T magnitude) {
  // pi/2 in parts of 7 bits (Cody and Waite, 1980, Software Manual for the Elementary Functions): n has 17 at most, so
  // each product is exact; so are the first differences, and what the next ones lose is kept.
  const T n = RoundEven(Min(magnitude, T(0x1p30f)) * T(0x1.45f306p-1f));
  T high = ((magnitude - n * T(0x1.94p+0f)) + n * T(0x1.ep-8f)) + n * T(0x1.2cp-18f);
  T low = T(0.0f);
  constexpr float kParts[] = {0x1.1p-26f, 0x1.0cp-34f, -0x1.74p-43f, 0x1.1cp-54f};
  for (float part : kParts) {
    const T step = n * T(part);
    const T next = high - step;
    const T taken = high - next;
    low += (high - (next + taken)) + (taken - step);
    high = next;
  }
  low += n * T(0x1.9d9ccep-62f);
  const T sum = Clamp(high + low, T(-0.8f), T(0.8f));  // only |x| > 2^17 is ever beyond
  return {sum, Clamp(low - (sum - high), T(-0x1p-24f), T(0x1p-24f)), TruncateToInt(n)};
}

// sin of the angle turned by quarter_turns pi/2.
template <class T>
FACET_INLINE T SinOfReduced(const ReducedAngle<T>& a, IntOf<T> quarter_turns) {
  using I = IntOf<T>;
  constexpr float kSin[] = {-0x1.555556p-3f, 0x1.111198p-7f, -0x1.a08312p-13f, 0x1.877534p-19f};
  constexpr float kCos[] = {0x1.555556p-5f, -0x1.6c17d4p-10f, 0x1.a0f596p-16f, -0x1.58df86p-22f};
  const I quadrant = a.quadrant + quarter_turns;
  const T z = a.high * a.high;
  const T sin = a.high + (a.high * z * Polynomial(z, kSin) + a.low);
  const T half_square = T(0.5f) * z;
  const T cos_leading = T(1.0f) - half_square;
  const T cos =
      cos_leading + (((T(1.0f) - cos_leading) - half_square) + (z * z * Polynomial(z, kCos) - a.high * a.low));
  const T result = Select((quadrant & I(1)) == I(1), cos, sin);
  return FloatFromBits(BitsOf(result) ^ ShiftLeft<30>(quadrant & I(2)));
}

// sin x, x in radians. Below 1 ULP for |x| <= 2^17; a number in [-1, 1] without meaning beyond; NaN for infinite x.
template <class T>
FACET_INLINE T Sin(T x) {
  const T magnitude = Abs(x);
  const T result = SinOfReduced(ReduceAngle(magnitude), IntOf<T>(0));
  const T sign_of_x = CopySign(T(1.0f), x);
  return Select(magnitude < T(HUGE_VALF), result * sign_of_x, QuietNan<T>());
}

// cos x, x in radians. Below 1 ULP for |x| <= 2^17; a number in [-1, 1] without meaning beyond; NaN for infinite x.
template <class T>
FACET_INLINE T Cos(T x) {
  const T magnitude = Abs(x);
  return Select(magnitude < T(HUGE_VALF), SinOfReduced(ReduceAngle(magnitude), IntOf<T>(1)), QuietNan<T>());
}

// The angle of the vector (x, y) in [-pi, pi]. Below 2 ULP. Zeros and infinities as in C: Atan2(+-0, -0) = +-pi.
template <class T>
FACET_INLINE T Atan2(T y, T x) {
  constexpr float kRest[] = {-0x1.555556p-2f, 0x1.9999bep-3f,  -0x1.2490b8p-3f, 0x1.c6a61cp-4f,  -0x1.6ff086p-4f,
                             0x1.256f7cp-4f,  -0x1.a1f138p-5f, 0x1.ce2572p-6f,  -0x1.4b1c42p-7f, 0x1.bbab1ep-10f};
  const T a = Abs(x), b = Abs(y);
  const auto steep = b > a;
  const T larger = Select(steep, b, a), smaller = Select(steep, a, b);
  T q = Select(larger == T(0.0f), T(0.0f), smaller / larger);
  q = Select(smaller == T(HUGE_VALF), T(1.0f), q);
  const T z = q * q;
  const T angle = q + q * z * Polynomial(z, kRest);  // in the first octant
  const auto left = CopySign(T(1.0f), x) < T(0.0f);
  // Octants: angle, pi/2 - angle, pi/2 + angle, pi - angle; pi/2 and pi as two floats.
  const auto right = !left, shallow = !steep;
  const auto mirrored = (steep & right) | (shallow & left);
  const T scale = Select(steep, T(1.0f), Select(left, T(2.0f), T(0.0f)));
  const T signed_angle = Select(mirrored, -angle, angle);
  const T result = scale * T(0x1.921fb6p+0f) + (signed_angle - scale * T(0x1.777a5cp-25f));
  return Select((x == x) & (y == y), CopySign(result, y), QuietNan<T>());
}

// asin(s) - s over s for s^2 = z <= 1/4.
template <class T>
FACET_INLINE T AsinRest(T z) {
  constexpr float kRest[] = {0x1.555554p-3f, 0x1.3334c6p-4f, 0x1.6d40ccp-5f,
                             0x1.ff8616p-6f, 0x1.10f0eap-6f, 0x1.19ecf4p-5f};
  return z * Polynomial(z, kRest);
}

// asin x in [-pi/2, pi/2]. Below 1 ULP; NaN for |x| > 1.
template <class T>
FACET_INLINE T Asin(T x) {
  const T magnitude = Abs(x);
  const auto outer = magnitude > T(0.5f);
  const T z = Select(outer, (T(1.0f) - magnitude) * T(0.5f), magnitude * magnitude);
  const T s = Select(outer, Sqrt(Max(z, T(0.0f))), magnitude);
  const T rest = s * AsinRest(z);
  // pi/2 - 2 asin(s) with s = s_high + s_low: the first difference is exact.
  const T s_high = HighHalf(s);
  const T s_low = Select(s > T(0.0f), (z - s_high * s_high) / (s + s_high), T(0.0f));
  const T outer_result = (T(0x1.921fb6p+0f) - T(2.0f) * s_high) - (T(2.0f) * (s_low + rest) + T(0x1.777a5cp-25f));
  const T result = Select(outer, outer_result, s + rest);
  return Select(magnitude <= T(1.0f), CopySign(result, x), QuietNan<T>());
}

// acos x in [0, pi]. Below 1.5 ULP; NaN for |x| > 1.
template <class T>
FACET_INLINE T Acos(T x) {
  const T magnitude = Abs(x);
  const auto outer = magnitude > T(0.5f);
  const T z = Select(outer, (T(1.0f) - magnitude) * T(0.5f), magnitude * magnitude);
  const T s = Select(outer, Sqrt(Max(z, T(0.0f))), x);
  const T rest = s * AsinRest(z);
  const T inner_result = T(0x1.921fb6p+0f) - (s + (rest + T(0x1.777a5cp-25f)));
  const T r = T(2.0f) * (s + rest);
  const T outer_result = Select(x > T(0.0f), r, T(0x1.921fb6p+1f) - (r + T(0x1.777a5cp-24f)));
  return Select(magnitude <= T(1.0f), Select(outer, outer_result, inner_result), QuietNan<T>());
}

// --- The same for double --------------------------------------------------------------------------------------------

FACET_INLINE double Exp2(double x) { return ::facet::Exp2(x); }
FACET_INLINE double Exp(double x) { return ::facet::Exp(x); }
FACET_INLINE double Log2(double x) { return ::facet::Log2(x); }
FACET_INLINE double Log(double x) { return ::facet::Log(x); }
FACET_INLINE double Pow(double x, double y) { return ::facet::Pow(x, y); }
FACET_INLINE double Cbrt(double x) { return ::facet::Cbrt(x); }
FACET_INLINE double Sin(double x) { return ::facet::Sin(x); }
FACET_INLINE double Cos(double x) { return ::facet::Cos(x); }
FACET_INLINE double Atan2(double y, double x) { return ::facet::Atan2(y, x); }
FACET_INLINE double Asin(double x) { return ::facet::Asin(x); }
FACET_INLINE double Acos(double x) { return ::facet::Acos(x); }

}  // namespace HWY_NAMESPACE
}  // namespace facet
HWY_AFTER_NAMESPACE();

#endif
