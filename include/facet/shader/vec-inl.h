// Vec2, Vec3 and Vec4 of any arithmetic type: lanes, float or double. Vec3<T>{} is zero; without braces it is not set.

#if defined(FACET_SHADER_VEC_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FACET_SHADER_VEC_INL_H_
#undef FACET_SHADER_VEC_INL_H_
#else
#define FACET_SHADER_VEC_INL_H_
#endif

#include "facet/shader/lane-inl.h"

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace HWY_NAMESPACE {

template <class T>
struct Vec2 {
  T x, y;
};

template <class T>
struct Vec3 {
  T x, y, z;
};

template <class T>
struct Vec4 {
  T x, y, z, w;
};

template <class T>
FACET_INLINE Vec2<T> operator+(Vec2<T> a, Vec2<T> b) {
  return {a.x + b.x, a.y + b.y};
}
template <class T>
FACET_INLINE Vec2<T> operator-(Vec2<T> a, Vec2<T> b) {
  return {a.x - b.x, a.y - b.y};
}
template <class T>
FACET_INLINE Vec2<T> operator*(Vec2<T> a, T s) {
  return {a.x * s, a.y * s};
}
template <class T>
FACET_INLINE T Dot(Vec2<T> a, Vec2<T> b) {
  return a.x * b.x + a.y * b.y;
}

template <class T>
FACET_INLINE Vec3<T> operator+(Vec3<T> a, Vec3<T> b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class T>
FACET_INLINE Vec3<T> operator-(Vec3<T> a, Vec3<T> b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class T>
FACET_INLINE Vec3<T> operator*(Vec3<T> a, Vec3<T> b) {
  return {a.x * b.x, a.y * b.y, a.z * b.z};
}
template <class T>
FACET_INLINE Vec3<T> operator*(Vec3<T> a, T s) {
  return {a.x * s, a.y * s, a.z * s};
}
template <class T>
FACET_INLINE Vec3<T> operator*(T s, Vec3<T> a) {
  return {a.x * s, a.y * s, a.z * s};
}
template <class T>
FACET_INLINE Vec3<T> operator/(Vec3<T> a, T s) {
  return {a.x / s, a.y / s, a.z / s};
}
template <class T>
FACET_INLINE Vec3<T> operator-(Vec3<T> a) {
  return {-a.x, -a.y, -a.z};
}
template <class T>
FACET_INLINE Vec3<T>& operator+=(Vec3<T>& a, Vec3<T> b) {
  return a = a + b;
}
template <class T>
FACET_INLINE T Dot(Vec3<T> a, Vec3<T> b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class T>
FACET_INLINE Vec3<T> Cross(Vec3<T> a, Vec3<T> b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class T>
FACET_INLINE Vec3<T> Select(MaskOf<T> m, Vec3<T> a, Vec3<T> b) {
  return {Select(m, a.x, b.x), Select(m, a.y, b.y), Select(m, a.z, b.z)};
}
template <class T>
FACET_INLINE Vec3<T> Mix(Vec3<T> a, Vec3<T> b, T t) {
  return a * (T(1.0f) - t) + b * t;
}
template <class T>
FACET_INLINE T Mix(T a, T b, T t) {
  return a * (T(1.0f) - t) + b * t;
}
template <class T>
FACET_INLINE T MaxComponent(Vec3<T> a) {
  return Max(a.x, Max(a.y, a.z));
}

// a / |a|, or `fallback` where a is zero or not finite. Scaled by its largest component first, it can be squared
// however long or short it is; scaled by a power of two before, the reciprocal of that component is finite.
template <class T>
FACET_INLINE Vec3<T> NormalizeOr(Vec3<T> a, Vec3<T> fallback) {
  const T largest = MaxComponent(Vec3<T>{Abs(a.x), Abs(a.y), Abs(a.z)});
  const T up = Select(largest < T(1e-30f), T(0x1p100f), T(1.0f));
  const Vec3<T> b = (a * up) * (T(1.0f) / (largest * up));
  const T length = Sqrt(Dot(b, b));
  const auto good = (length >= T(0.5f)) & IsFinite(length);
  return Select(good, b * (T(1.0f) / length), fallback);
}

template <class T>
FACET_INLINE Vec4<T> operator+(Vec4<T> a, Vec4<T> b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z, a.w + b.w};
}
template <class T>
FACET_INLINE Vec4<T> operator*(Vec4<T> a, T s) {
  return {a.x * s, a.y * s, a.z * s, a.w * s};
}
template <class T>
FACET_INLINE Vec4<T> operator*(Vec4<T> a, Vec4<T> b) {
  return {a.x * b.x, a.y * b.y, a.z * b.z, a.w * b.w};
}
template <class T>
FACET_INLINE Vec3<T> Xyz(Vec4<T> a) {
  return {a.x, a.y, a.z};
}

}  // namespace HWY_NAMESPACE
}  // namespace facet
HWY_AFTER_NAMESPACE();

#endif
