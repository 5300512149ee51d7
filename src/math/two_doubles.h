// Numbers as unevaluated sums of two doubles, with about 106 bits. Without fused multiply-add: the splitting is that of
// T. J. Dekker, 1971, "A floating-point technique for extending the available precision"; operands stay below 2^990.
#pragma once

namespace facet {

struct TwoDoubles {
  double high = 0.0;
  double low = 0.0;  // |low| <= ulp(high) / 2
};

// a + b exactly, for |a| >= |b| or a == 0.
inline TwoDoubles SumOfOrdered(double a, double b) {
  const double sum = a + b;
  return {sum, b - (sum - a)};
}

// a + b exactly (D. E. Knuth, The Art of Computer Programming 2, section 4.2.2).
inline TwoDoubles SumOf(double a, double b) {
  const double sum = a + b;
  const double b_taken = sum - a;
  return {sum, (a - (sum - b_taken)) + (b - b_taken)};
}

// a b exactly, but for underflow.
inline TwoDoubles ProductOf(double a, double b) {
  constexpr double kSplitter = 0x1p27 + 1.0;
  const double a_scaled = a * kSplitter, b_scaled = b * kSplitter;
  const double a_high = a_scaled - (a_scaled - a), b_high = b_scaled - (b_scaled - b);
  const double a_low = a - a_high, b_low = b - b_high;
  const double product = a * b;
  return {product, (((a_high * b_high - product) + a_high * b_low) + a_low * b_high) + a_low * b_low};
}

inline TwoDoubles operator+(TwoDoubles a, TwoDoubles b) {
  const TwoDoubles sum = SumOf(a.high, b.high);
  return SumOfOrdered(sum.high, sum.low + (a.low + b.low));
}

inline TwoDoubles operator*(TwoDoubles a, TwoDoubles b) {
  const TwoDoubles product = ProductOf(a.high, b.high);
  return SumOfOrdered(product.high, product.low + (a.high * b.low + a.low * b.high));
}

// a / b to about 100 bits, for finite normal b.
inline TwoDoubles operator/(TwoDoubles a, TwoDoubles b) {
  const double quotient = a.high / b.high;
  const TwoDoubles product = ProductOf(quotient, b.high);
  const double rest = ((a.high - product.high) - product.low) + (a.low - quotient * b.low);
  return SumOfOrdered(quotient, rest / b.high);
}

}  // namespace facet
