// The ABC distribution's norm. Loew, Kronander, Ynnerman and Unger, 2012, BRDF Models for Accurate and Efficient
// Rendering of Glossy Surfaces, have A / (1 + B (1 - n.h))^C with A free; Akenine-Moeller et al., 2018, Real-Time
// Rendering, section 9.8.1, have it as proportional to 1 / (1 + alpha1 (1 - n.h))^alpha2. Here A is what makes it a
// distribution of normals: the integral of D(h) n.h over the hemisphere is 1. With u = 1 - n.h,
//   1 / A = 2 pi I,   I = integral over [0, 1] of (1 - u) (1 + alpha1 u)^-alpha2 du.
// With S = 1 + alpha1, L = ln S, z = (1 - alpha2) L and phi(z) = (e^z - 1) / z, which is smooth at 0,
//   I = L / alpha1^2 (S phi(z) - phi(z + L)).
// The difference of the two loses as many digits as alpha1 is small, so that alpha1 counts as 1e-6 at least. There D
// differs from the constant 1 / pi by no more than alpha2 times that.
#pragma once

#include <algorithm>
#include <cmath>

#include "math/elementary.h"

namespace facet {

constexpr float BoundedAlpha1(float alpha1) { return std::max(alpha1, 1e-6f); }

// (e^z - 1) / z.
inline double MeanExponential(double z) {
  if (std::fabs(z) > 0.5) return (Exp(z) - 1.0) / z;
  double sum = 1.0;
  for (int k = 16; k >= 2; --k) sum = 1.0 + sum * z / k;
  return sum;
}

// I above: D at the normal is 1 / (2 pi I). `alpha1`: bounded.
inline double AbcIntegral(double alpha1, double alpha2) {
  const double b = alpha1, s = 1.0 + b, l = Log(s), z = (1.0 - alpha2) * l;
  return l / (b * b) * (s * MeanExponential(z) - MeanExponential(z + l));
}

}  // namespace facet
