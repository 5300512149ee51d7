// A thin film on a surface (KHR_materials_iridescence): interference between reflections at its two sides colours F0.
// Belcour and Barla, 2017, A Practical Extension to Microfacet Theory for the Modeling of Varying Iridescence, with the
// spectral integrals as Gaussians in the Fourier domain, as in the extension's text. The film is evaluated for the
// angle of the view, for all light, and the result becomes the F0 of a Schlick Fresnel that has the same value at that
// angle.

#if defined(FACET_MATERIAL_LOBES_IRIDESCENCE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FACET_MATERIAL_LOBES_IRIDESCENCE_INL_H_
#undef FACET_MATERIAL_LOBES_IRIDESCENCE_INL_H_
#else
#define FACET_MATERIAL_LOBES_IRIDESCENCE_INL_H_
#endif

#include "facet/shader/elementary-inl.h"
#include "material/lobes/specular-inl.h"

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace HWY_NAMESPACE {

template <class T>
struct FilmInputs {
  T factor{};        // [0, 1]
  T ior{};           // 1 or more
  T thickness_nm{};  // 0 or more
};

template <class T>
struct ThinFilm {
  FACET_INLINE ThinFilm(const FilmInputs<T>& in, T n_dot_v)
      : weight_(Clamp(in.factor, T(0.0f), T(1.0f))), cosine_(n_dot_v) {
    // A film of thickness 0 is none, and becomes one continuously (the extension's text).
    const T fade = Clamp(in.thickness_nm * T(1.0f / 0.03f), T(0.0f), T(1.0f));
    // Less 1, which keeps the digits of indices close to 1.
    const T excess = (Max(in.ior, T(1.0f)) - T(1.0f)) * (fade * fade * (T(3.0f) - T(2.0f) * fade));
    ior_ = T(1.0f) + excess;
    // The squared cosine within the film, 1 - (1 - cosine^2) / ior^2, where that does not cancel.
    const T inverse = T(1.0f) / ior_, refracted = cosine_ * inverse;
    const T inside2 = excess * inverse * (T(1.0f) + inverse) + refracted * refracted;
    inside_ = Sqrt(inside2);
    // Beyond a millimetre nothing interferes; the bound keeps the phase finite.
    path_nm_ = Min(T(2.0f) * ior_ * Min(in.thickness_nm, T(1e6f)) * inside_, T(1e6f));
    const T root = excess / (ior_ + T(1.0f));
    first_ = FresnelSchlick(root * root, cosine_);
  }

  // The reflectance at normal incidence that stands for the film over `base`.
  FACET_INLINE Vec3<T> F0Over(const Vec3<T>& base) const {
    const Vec3<T> film = Reflectance(base);
    return {Fold(base.x, film.x), Fold(base.y, film.y), Fold(base.z, film.z)};
  }

 private:
  // The F0 with which Schlick's Fresnel gives this reflectance at the angle of the view. Near grazing angles Schlick's
  // term is close to 1 whatever F0 is, so that F0 would be a quotient of two rounding errors: within half a degree of
  // them the film fades out.
  FACET_INLINE T Fold(T base, T reflectance) const {
    constexpr float kLeastRest = 0.05f;
    const T rest = Max(T(1.0f) - SchlickWeight(cosine_), T(kLeastRest));
    return Clamp(base + weight_ * (reflectance - FresnelSchlick(base, cosine_)) / rest, T(0.0f), T(1.0f));
  }

  // At the angle of the view, as a colour in [0, 1].
  FACET_INLINE Vec3<T> Reflectance(const Vec3<T>& base) const {
    const T through = (T(1.0f) - first_) * (T(1.0f) - first_);
    const auto second = [&](T f0) HWY_ATTR {
      const T n = IndexOf(f0) / ior_;
      const T root = (n - T(1.0f)) / (n + T(1.0f));
      return FresnelSchlick(root * root, inside_);
    };
    const Vec3<T> r2{second(base.x), second(base.y), second(base.z)};
    // A wave that is reflected at a denser medium is turned by pi: those of odd order change sign where the base is
    // denser than the film.
    const auto sign = [&](T f0) HWY_ATTR { return Select(IndexOf(f0) < ior_, T(1.0f), T(-1.0f)); };
    const Vec3<T> signs{sign(base.x), sign(base.y), sign(base.z)};
    const Vec3<T> one{T(1.0f), T(1.0f), T(1.0f)};
    const Vec3<T> r123 = {Bounded(r2.x * first_), Bounded(r2.y * first_), Bounded(r2.z * first_)};
    const Vec3<T> root = {Sqrt(r123.x), Sqrt(r123.y), Sqrt(r123.z)};
    const Vec3<T> rs = {through * r2.x / (T(1.0f) - r123.x), through * r2.y / (T(1.0f) - r123.y),
                        through * r2.z / (T(1.0f) - r123.z)};
    Vec3<T> sum = one * first_ + rs;  // the constant term
    Vec3<T> power = rs - one * (T(1.0f) - first_);
    for (int m = 1; m <= 2; ++m) {
      power = power * root;
      const Vec3<T> seen = Sensitivity(path_nm_ * T(static_cast<float>(m))) * T(2.0f);
      sum += m == 1 ? power * signs * seen : power * seen;
    }
    return {Max(sum.x, T(0.0f)), Max(sum.y, T(0.0f)), Max(sum.z, T(0.0f))};
  }

  static FACET_INLINE T Bounded(T r) { return Clamp(r, T(1e-5f), T(0.9999f)); }
  // Of the medium whose reflectance in air this is.
  static FACET_INLINE T IndexOf(T f0) {
    const T root = Sqrt(Clamp(f0, T(0.0f), T(0.9999f)));
    return (T(1.0f) + root) / (T(1.0f) - root);
  }

  // How strongly the eye sees the interference of waves with this difference of paths, as linear Rec. 709: Gaussians
  // fitted to the CIE 1931 responses in the Fourier domain (Belcour and Barla, 2017, supplemental material), divided by
  // the integral of the response to green.
  static FACET_INLINE Vec3<T> Sensitivity(T path_nm) {
    const T phase = path_nm * T(2.0f * kPi * 1e-9f);
    const T phase2 = phase * phase;
    const auto gaussian = [&](double height, float place, double variance) HWY_ATTR {
      const auto scale = static_cast<float>(height * Sqrt(2.0 * 3.14159265358979324 * variance) / 1.0685e-7);
      return T(scale) * Cos(phase * T(place)) * Exp(-(phase2 * T(static_cast<float>(variance))));
    };
    const T x = gaussian(5.4856e-13, 1.6810e+06f, 4.3278e+09) + gaussian(9.7470e-14, 2.2399e+06f, 4.5282e+09);
    const T y = gaussian(4.4201e-13, 1.7953e+06f, 9.3046e+09);
    const T z = gaussian(5.2481e-13, 2.2084e+06f, 6.6121e+09);
    return {x * T(3.2404542f) - y * T(1.5371385f) - z * T(0.4985314f),
            y * T(1.8760108f) - x * T(0.9692660f) + z * T(0.0415560f),
            x * T(0.0556434f) - y * T(0.2040259f) + z * T(1.0572252f)};
  }

  T weight_{}, cosine_{}, ior_{}, inside_{}, path_nm_{}, first_{};
};

}  // namespace HWY_NAMESPACE
}  // namespace facet
HWY_AFTER_NAMESPACE();

#endif
