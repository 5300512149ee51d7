// Elementary functions of double: one fixed sequence of IEEE 754 operations (+ - * / sqrt, rounding, bits), the same
// result on every processor, compiler and C library. For numbers that are computed once (matrices, angles, exposure,
// animation) and for shaders that are instantiated with double; lanes have elementary-inl.h.
//
// Errors are below 1.2 ULP, searched in comparison with a 64-bit significand (tests/math).
// NaN in gives NaN out; everything else is defined as IEEE 754-2019, clause 9.2, defines it.
#pragma once

namespace facet {

double Exp2(double x);
double Exp(double x);
double Log2(double x);  // log of 0 is -infinity, of a negative number NaN
double Log(double x);
double Pow(double x, double y);  // a negative x needs an integral y, else NaN; Pow(x, 0) = Pow(1, y) = 1
double Cbrt(double x);

// Radians; exactly reduced, whatever the size of x. An infinite x gives NaN.
double Sin(double x);
double Cos(double x);
double Tan(double x);

double Asin(double x);             // [-1, 1] to [-pi/2, pi/2]
double Acos(double x);             // [-1, 1] to [0, pi]
double Atan2(double y, double x);  // the angle of (x, y) in [-pi, pi]; Atan2(+-0, -0) = +-pi

}  // namespace facet
