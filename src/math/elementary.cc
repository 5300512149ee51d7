#include "math/elementary.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

#include "math/two_doubles.h"

// Coefficients: src/math/fit_polynomials.py.

namespace facet {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

template <std::size_t kCount>
double Polynomial(double x, const std::array<double, kCount>& c) {
  double sum = c[kCount - 1];
  for (std::size_t i = kCount - 1; i-- > 0;) sum = sum * x + c[i];
  return sum;
}

// 2^(n + f) for a whole n within int and |f| <= 0.51.
double Exp2OfParts(double n, double f) {
  constexpr std::array kRest = {
      0x1.62e42fefa39efp-1,  0x1.ebfbdff82c58fp-3,  0x1.c6b08d704a236p-5,  0x1.3b2ab6fba4d46p-7,  0x1.5d87fe7848d21p-10,
      0x1.430912f8c2fe2p-13, 0x1.ffcbfeda9fdb2p-17, 0x1.62c020e4f86ddp-20, 0x1.b51ce0d97ee97p-24, 0x1.e4d407e19bab6p-28,
      0x1.01c6103ee6b0bp-31, 0x1.bdeac2a791191p-36, -0x1.f6c62b8028616p-36};
  return std::ldexp(1.0 + f * Polynomial(f, kRest), static_cast<int>(n));
}

// log2 x to about 2^-68 of its value, for finite x > 0.
TwoDoubles ExtendedLog2(double x) {
  constexpr std::array kRest = {0x1.a61762a7aded9p-2, 0x1.484b13d7c0437p-2, 0x1.0c9a849912967p-2,
                                0x1.c68f56d7ff0f0p-3, 0x1.89f390e7c4487p-3, 0x1.5ba2c55e9cd59p-3,
                                0x1.35e8186187216p-3, 0x1.2de19fee3d464p-3, 0x1.c5dcf90241c02p-5};
  constexpr TwoDoubles kFirst{0x1.71547652b82fep+1, 0x1.777d0ffda0d24p-55};   // 2 / ln 2
  constexpr TwoDoubles kSecond{0x1.ec709dc3a03fdp-1, 0x1.d27f05548af0cp-55};  // 2 / (3 ln 2)
  constexpr TwoDoubles kThird{0x1.2776c50ef9bfep-1, 0x1.e4b29ccc535d4p-55};   // 2 / (5 ln 2)
  int exponent = 0;
  double m = std::frexp(x, &exponent);
  if (m < 0x1.6a09e667f3bcdp-1) {  // sqrt(1/2)
    m *= 2.0;
    --exponent;
  }
  // log2 m = 2 / ln 2 (s + s^3 / 3 + s^5 / 5 + ...), s = (m - 1) / (m + 1).
  const TwoDoubles s = TwoDoubles{m - 1.0, 0.0} / SumOf(m, 1.0);
  const TwoDoubles z = s * s;
  const TwoDoubles series = kFirst + z * (kSecond + z * (kThird + TwoDoubles{z.high * Polynomial(z.high, kRest), 0.0}));
  return TwoDoubles{static_cast<double>(exponent), 0.0} + s * series;
}

// |x| = quadrant pi/2 + angle, |angle| <= pi/4, for finite x.
struct ReducedAngle {
  TwoDoubles angle;
  unsigned quadrant = 0;
};

// M. Payne and R. Hanek, 1983, "Radian reduction for trigonometric functions": of 2/pi only those bits are multiplied
// that change the result modulo 4, here 192 of them.
ReducedAngle ReduceAngle(double magnitude) {
  if (magnitude <= 0x1.921fb54442d18p-1) return {{magnitude, 0.0}, 0};
  // 2/pi, the binary digits after the point.
  constexpr std::array<std::uint32_t, 40> kTwoOverPi = {
      0xa2f9836e, 0x4e441529, 0xfc2757d1, 0xf534ddc0, 0xdb629599, 0x3c439041, 0xfe5163ab, 0xdebbc561,
      0xb7246e3a, 0x424dd2e0, 0x06492eea, 0x09d1921c, 0xfe1deb1c, 0xb129a73e, 0xe88235f5, 0x2ebb4484,
      0xe99c7026, 0xb45f7e41, 0x3991d639, 0x835339f4, 0x9c845f8b, 0xbdf9283b, 0x1ff897ff, 0xde05980f,
      0xef2f118b, 0x5a0a6d1f, 0x6d367ecf, 0x27cb09b7, 0x4f463f66, 0x9e5fea2d, 0x7527bac7, 0xebe5f17b,
      0x3d0739f7, 0x8a5292ea, 0x6bfb5fb1, 0x1f8d5d08, 0x56033046, 0xfc7b6bab, 0xf0cfbc20, 0x9af4361d};
  const auto word_at = [&](int index) -> std::uint64_t {
    return index < 0 ? 0 : kTwoOverPi[static_cast<std::size_t>(index)];
  };
  // magnitude = significand 2^exponent, both whole.
  const std::uint64_t bits = std::bit_cast<std::uint64_t>(magnitude);
  const int exponent = static_cast<int>(bits >> 52) - 1075;
  const std::uint64_t significand = (bits & ((std::uint64_t{1} << 52) - 1)) | (std::uint64_t{1} << 52);
  // The digit at `first`, times the significand and 2^exponent, has the weight of the significand's last bit times 2.
  const int first = exponent - 2;
  constexpr int kWords = 6;
  std::array<std::uint64_t, kWords> window{};  // little-endian
  for (int i = 0; i < kWords; ++i) {
    const int position = first + 32 * i;
    const int index = position >= 0 ? position / 32 : -((31 - position) / 32);
    const int shift = position - 32 * index;
    const std::uint64_t pair = word_at(index) << 32 | word_at(index + 1);
    window[static_cast<std::size_t>(kWords - 1 - i)] = (pair >> (32 - shift)) & 0xFFFFFFFFu;
  }
  // significand x window modulo 2^192, in units of 2^-190.
  std::array<std::uint64_t, kWords> product{};
  const std::array<std::uint64_t, 2> factor = {significand & 0xFFFFFFFFu, significand >> 32};
  for (std::size_t j = 0; j < factor.size(); ++j) {
    std::uint64_t carry = 0;
    for (std::size_t i = 0; i + j < kWords; ++i) {
      const std::uint64_t sum = product[i + j] + window[i] * factor[j] + carry;  // below 2^64
      product[i + j] = sum & 0xFFFFFFFFu;
      carry = sum >> 32;
    }
  }
  unsigned quadrant = static_cast<unsigned>(product[kWords - 1] >> 30);
  product[kWords - 1] &= 0x3FFFFFFFu;
  const bool round_up = product[kWords - 1] >= 0x20000000u;
  if (round_up) {  // 1 - fraction
    quadrant = (quadrant + 1) & 3u;
    std::uint64_t borrow_complement = 1;
    for (std::uint64_t& word : product) {
      const std::uint64_t sum = (~word & 0xFFFFFFFFu) + borrow_complement;
      word = sum & 0xFFFFFFFFu;
      borrow_complement = sum >> 32;
    }
    product[kWords - 1] &= 0x3FFFFFFFu;
  }
  TwoDoubles fraction;
  for (int i = 0; i < kWords; ++i) {  // smallest first
    const double term = std::ldexp(static_cast<double>(product[static_cast<std::size_t>(i)]), 32 * i - 190);
    const TwoDoubles sum = SumOf(term, fraction.high);
    fraction = SumOfOrdered(sum.high, sum.low + fraction.low);
  }
  TwoDoubles angle = fraction * TwoDoubles{0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54};
  if (round_up) angle = {-angle.high, -angle.low};
  return {angle, quadrant};
}

TwoDoubles SinOf(TwoDoubles a) {
  constexpr std::array kRest = {-0x1.5555555555555p-3, 0x1.1111111110c7ap-7,   -0x1.a01a019e9eabap-13,
                                0x1.71de37ae51ef8p-19, -0x1.ae601d48b6234p-26, 0x1.5e10311908f4fp-33};
  const double z = a.high * a.high;
  return SumOfOrdered(a.high, a.high * z * Polynomial(z, kRest) + a.low * (1.0 - 0.5 * z));
}

TwoDoubles CosOf(TwoDoubles a) {
  constexpr std::array kRest = {0x1.5555555555555p-5,   -0x1.6c16c16c168c8p-10, 0x1.a01a019f3790bp-16,
                                -0x1.27e4fa01e1d62p-22, 0x1.1eeb56a7fb651p-29,  -0x1.90729ceec5ef3p-37};
  const double z = a.high * a.high;
  const double half_square = 0.5 * z;
  const double leading = 1.0 - half_square;
  return SumOfOrdered(leading, ((1.0 - leading) - half_square) + (z * z * Polynomial(z, kRest) - a.high * a.low));
}

TwoDoubles SinOfReduced(const ReducedAngle& reduced, unsigned quarter_turns) {
  const unsigned quadrant = reduced.quadrant + quarter_turns;
  const TwoDoubles value = (quadrant & 1u) != 0 ? CosOf(reduced.angle) : SinOf(reduced.angle);
  return (quadrant & 2u) != 0 ? TwoDoubles{-value.high, -value.low} : value;
}

// asin(s) / s - 1 for s^2 = z <= 1/4.
double AsinRest(double z) {
  constexpr std::array kRest = {0x1.5555555555555p-3,  0x1.33333333334b5p-4, 0x1.6db6db6d96bd7p-5, 0x1.f1c71c859e992p-6,
                                0x1.6e8b9f75d5a0fp-6,  0x1.1c4f24bd9c0e8p-6, 0x1.c98bcadf0f791p-7, 0x1.7b36e2092e84fp-7,
                                0x1.39c3a37b9c9d8p-7,  0x1.394383574da19p-7, 0x1.2029949025efcp-9, 0x1.6012a23088bcap-6,
                                -0x1.65a8fca71e97dp-6, 0x1.fe5fabc17c7afp-6};
  return z * Polynomial(z, kRest);
}

// sqrt(z) with what its rounding loses, for normal z.
TwoDoubles ExtendedSqrt(double z) {
  const double root = std::sqrt(z);
  if (root == 0.0) return {};
  const TwoDoubles square = ProductOf(root, root);
  return {root, ((z - square.high) - square.low) / (2.0 * root)};
}

constexpr TwoDoubles kHalfPi{0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54};
constexpr TwoDoubles kPi{0x1.921fb54442d18p+1, 0x1.1a62633145c07p-53};

}  // namespace

double Exp2(double x) {
  if (std::isnan(x)) return x;
  if (x >= 1024.0) return kInfinity;
  if (x <= -1076.0) return 0.0;
  const double n = std::nearbyint(x);
  return Exp2OfParts(n, x - n);
}

double Exp(double x) {
  constexpr std::array kRest = {0x1.p-1,
                                0x1.5555555555555p-3,
                                0x1.5555555555556p-5,
                                0x1.111111111137ep-7,
                                0x1.6c16c16c15fefp-10,
                                0x1.a01a019ea908ap-13,
                                0x1.a01a01a82049dp-16,
                                0x1.71de40556235ep-19,
                                0x1.27e4d7fddc246p-22,
                                0x1.ae4d966858ba3p-26,
                                0x1.1f7919372ca92p-29,
                                0x1.81830637ac7f9p-33};
  if (std::isnan(x)) return x;
  if (x > 710.0) return kInfinity;
  if (x < -746.0) return 0.0;
  const double n = std::nearbyint(x * 0x1.71547652b82fep+0);
  // ln 2 in two parts; n times the first, of 40 bits, is exact.
  const double r = (x - n * 0x1.62e42fefa4p-1) + n * 0x1.8432a1b0e2634p-43;
  return std::ldexp(1.0 + (r + r * r * Polynomial(r, kRest)), static_cast<int>(n));
}

double Log2(double x) {
  if (x == 0.0) return -kInfinity;
  if (x < 0.0) return kNan;
  if (!(x < kInfinity)) return x;
  return ExtendedLog2(x).high;
}

double Log(double x) {
  constexpr TwoDoubles kLn2{0x1.62e42fefa39efp-1, 0x1.abc9e3b39803fp-56};
  if (x == 0.0) return -kInfinity;
  if (x < 0.0) return kNan;
  if (!(x < kInfinity)) return x;
  return (ExtendedLog2(x) * kLn2).high;
}

double Pow(double x, double y) {
  if (y == 0.0 || x == 1.0) return 1.0;
  if (std::isnan(x) || std::isnan(y)) return kNan;
  const double magnitude = std::fabs(x);
  const bool y_is_odd = std::fabs(y) < 0x1p53 && std::floor(y) == y && std::floor(0.5 * y) != 0.5 * y;
  const bool negative = std::signbit(x) && y_is_odd;
  double result = 0.0;
  if (magnitude == 0.0 || std::isinf(magnitude)) {
    result = (magnitude == 0.0) == (y > 0.0) ? 0.0 : kInfinity;
  } else {
    if (x < 0.0 && std::floor(y) != y) return kNan;
    // Beyond 2^70 every magnitude but 1 has left the range of double.
    const double exponent = y > 0x1p70 ? 0x1p70 : y < -0x1p70 ? -0x1p70 : y;
    const TwoDoubles product = ExtendedLog2(magnitude) * TwoDoubles{exponent, 0.0};
    if (product.high >= 1025.0) {
      result = kInfinity;
    } else if (product.high > -1077.0) {
      const double n = std::nearbyint(product.high);
      result = Exp2OfParts(n, (product.high - n) + product.low);
    }
  }
  return negative ? -result : result;
}

double Cbrt(double x) {
  const double magnitude = std::fabs(x);
  if (magnitude == 0.0 || !(magnitude < kInfinity)) return x;
  const double guess = Exp2(Log2(magnitude) / 3.0);
  const double root = guess - (guess - magnitude / (guess * guess)) / 3.0;  // Newton
  return std::copysign(root, x);
}

double Sin(double x) {
  if (!std::isfinite(x)) return kNan;
  const double result = SinOfReduced(ReduceAngle(std::fabs(x)), 0).high;
  return std::signbit(x) ? -result : result;
}

double Cos(double x) {
  if (!std::isfinite(x)) return kNan;
  return SinOfReduced(ReduceAngle(std::fabs(x)), 1).high;
}

double Tan(double x) {
  if (!std::isfinite(x)) return kNan;
  const ReducedAngle reduced = ReduceAngle(std::fabs(x));
  const double result = (SinOfReduced(reduced, 0) / SinOfReduced(reduced, 1)).high;
  return std::signbit(x) ? -result : result;
}

double Asin(double x) {
  const double magnitude = std::fabs(x);
  if (!(magnitude <= 1.0)) return kNan;
  if (magnitude <= 0.5) return x + x * AsinRest(x * x);
  const double z = (1.0 - magnitude) * 0.5;
  const TwoDoubles s = ExtendedSqrt(z);
  const double result = kHalfPi.high - (2.0 * s.high + (2.0 * (s.high * AsinRest(z) + s.low) - kHalfPi.low));
  return std::copysign(result, x);
}

double Acos(double x) {
  const double magnitude = std::fabs(x);
  if (!(magnitude <= 1.0)) return kNan;
  if (magnitude <= 0.5) return kHalfPi.high - (x + (x * AsinRest(x * x) - kHalfPi.low));
  const double z = (1.0 - magnitude) * 0.5;
  const TwoDoubles s = ExtendedSqrt(z);
  const double rest = s.high * AsinRest(z) + s.low;
  if (x > 0.0) return 2.0 * (s.high + rest);
  return kPi.high - (2.0 * s.high + (2.0 * rest - kPi.low));
}

double Atan2(double y, double x) {
  constexpr std::array kRest = {
      -0x1.5555555555555p-2, 0x1.9999999999804p-3,  -0x1.24924924806bfp-3, 0x1.c71c71bb6acedp-4,  -0x1.745d152024eecp-4,
      0x1.3b1372afc8bf4p-4,  -0x1.110c66b3ed77ep-4, 0x1.e1697a18aa9ecp-5,  -0x1.ab02f46db8b24p-5, 0x1.6d4aacdfa69e3p-5,
      -0x1.0233ba5442478p-5, 0x1.56fc84860e8cap-7,  0x1.3f3ea9d35960ap-8};
  constexpr TwoDoubles kQuarterPi{0x1.921fb54442d18p-1, 0x1.1a62633145c07p-55};
  if (std::isnan(x) || std::isnan(y)) return kNan;
  double larger = std::fabs(x), smaller = std::fabs(y);
  const bool steep = smaller > larger;
  if (steep) std::swap(smaller, larger);
  const bool left = std::signbit(x);
  // The angle in the first octant.
  TwoDoubles angle;
  if (larger == 0.0 || (std::isinf(larger) && !std::isinf(smaller))) {
    angle = {0.0, 0.0};
  } else if (std::isinf(smaller)) {
    angle = kQuarterPi;
  } else if (smaller / larger < 0x1p-60) {
    angle = {smaller / larger, 0.0};
  } else {
    int exponent = 0;
    larger = std::frexp(larger, &exponent);
    smaller = std::ldexp(smaller, -exponent);
    // atan q = pi/4 + atan((q - 1) / (q + 1))
    const bool upper = smaller > 0x1.a827999fcef34p-2 * larger;  // tan(pi/8)
    const TwoDoubles t =
        upper ? SumOf(smaller, -larger) / SumOf(smaller, larger) : TwoDoubles{smaller, 0.0} / TwoDoubles{larger, 0.0};
    const double z = t.high * t.high;
    angle = SumOfOrdered(t.high, t.high * z * Polynomial(z, kRest) + t.low * (1.0 - z));
    if (upper) angle = kQuarterPi + angle;
  }
  if (steep != left) angle = {-angle.high, -angle.low};
  if (steep) angle = kHalfPi + angle;
  if (left && !steep) angle = kPi + angle;
  return std::copysign(angle.high, y);
}

}  // namespace facet
