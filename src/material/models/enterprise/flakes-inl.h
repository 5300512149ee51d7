// The flakes of DSPBR: small mirrors that lie in a coat, tilted at random, each opaque or absent (DSPBR 2025x, section
// "Flakes"). Flakes are the cells of a Voronoi diagram in texture space, one in each square of a grid, so they stay
// where they are when camera or object move. A flake reflects light evenly within a narrow cone.
//
// In three points the specification leaves the choice to a renderer, or is not what its own pictures show:
// - The grid lies in texture space (TEXCOORD_0, whose scale is measured on the mesh), not in object space by triplanar
//   mapping: its squares need no position in the object's axes, and follow the object where it is deformed.
// - The cone is the BSDF times the cosine, 1 / (solid angle): a flake reflects all that its colour says, and flakes
//   that are not tilted are as bright at the rim of a sphere as in its middle, as in the specification's chart.
// - The hash is that of C. Wellons (2018, "Prospecting for Hash Functions", lowbias32, public domain).
//
// Where a cell is smaller than a pixel, the pixel shows the mean of many flakes. It is known in closed form. Tilts have
// the density D(h) (h.n) of GGX, so the mean is D(h) (h.n) / (4 v.h), with the width that has the square of both tilt
// and cone, and the share of light that it reflects upwards, rather than into the surface, is that of a cap of a sphere
// (MeanAlbedo()).

#if defined(FACET_MATERIAL_MODELS_ENTERPRISE_FLAKES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FACET_MATERIAL_MODELS_ENTERPRISE_FLAKES_INL_H_
#undef FACET_MATERIAL_MODELS_ENTERPRISE_FLAKES_INL_H_
#else
#define FACET_MATERIAL_MODELS_ENTERPRISE_FLAKES_INL_H_
#endif

#include "facet/shader/elementary-inl.h"
#include "facet/shader/lookup-inl.h"
#include "material/read-inl.h"

HWY_BEFORE_NAMESPACE();
namespace facet {
namespace HWY_NAMESPACE {

template <class T>
struct FlakeInputs {
  UvFootprint<T> at;  // TEXCOORD_0
  T metres_per_uv{};  // 0: the surface has no texture coordinates
  T coverage{};       // [0, 1]
  T size_mm{};        // 0: too small to be seen
  T roughness{};      // [0, 1]
  T flip_flop{};      // [0, 1]
  Vec3<T> color, flip_flop_color;
  Vec3<T> tangent, bitangent;  // unit, perpendicular to the shading normal and to one another
};

// --- Random numbers of a cell ----------------------------------------------------------------------------------------

FACET_INLINE std::int32_t WrappingMultiply(std::int32_t a, std::uint32_t b) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(a) * b);
}
FACET_INLINE Int WrappingMultiply(Int a, std::uint32_t b) { return a * Int(static_cast<std::int32_t>(b)); }

template <class I>
FACET_INLINE I HashBits(I x) {
  x = x ^ ShiftRightLogical<16>(x);
  x = WrappingMultiply(x, 0x7feb352du);
  x = x ^ ShiftRightLogical<15>(x);
  x = WrappingMultiply(x, 0x846ca68bu);
  return x ^ ShiftRightLogical<16>(x);
}

// In [0, 1), with 24 bits.
template <class T>
FACET_INLINE T UnitOfBits(IntOf<T> bits) {
  return FromInt<T>(ShiftRightLogical<8>(bits)) * T(0x1p-24f);
}

// --- A flake ---------------------------------------------------------------------------------------------------------

template <class T>
struct FlakeCell {
  T opacity_threshold{};  // [0, 1): the flake is there if this is less than the coverage
  T tilt{}, turn{};       // [0, 1): random numbers of its normal
};

// The cell at a place, in units of the grid. Only the nine squares around are searched: a nearer point beyond them is
// rare, and missed in the same way at every visit.
template <class T>
FACET_INLINE FlakeCell<T> FlakeAt(const Vec2<T>& place) {
  const T most(1e9f);
  const T fx = Floor(Clamp(place.x, -most, most)), fy = Floor(Clamp(place.y, -most, most));
  const T x = Clamp(place.x - fx, T(0.0f), T(1.0f)), y = Clamp(place.y - fy, T(0.0f), T(1.0f));
  const IntOf<T> column = TruncateToInt(fx), row = TruncateToInt(fy);
  T nearest(1e30f);
  IntOf<T> chosen(0);
  for (int dy = -1; dy <= 1; ++dy) {
    const IntOf<T> of_row = HashBits(row + IntOf<T>(dy));
    for (int dx = -1; dx <= 1; ++dx) {
      const IntOf<T> bits = HashBits((column + IntOf<T>(dx)) ^ of_row);
      const T px = FromInt<T>(bits & IntOf<T>(0xffff)) * T(0x1p-16f) + T(static_cast<float>(dx)) - x;
      const T py = FromInt<T>(ShiftRightLogical<16>(bits)) * T(0x1p-16f) + T(static_cast<float>(dy)) - y;
      const T distance2 = px * px + py * py;
      const auto is_nearer = distance2 < nearest;
      nearest = Select(is_nearer, distance2, nearest);
      chosen = Select(is_nearer, bits, chosen);
    }
  }
  const IntOf<T> first = HashBits(chosen ^ IntOf<T>(0x2545f491)), second = HashBits(first ^ IntOf<T>(0x1b873593));
  return {UnitOfBits<T>(first), UnitOfBits<T>(second), UnitOfBits<T>(HashBits(second ^ IntOf<T>(0x68e31da4)))};
}

// The widths of a flake: how much it is tilted, and how much it blurs.
template <class T>
struct FlakeWidths {
  T whole{};             // GGX's width of both
  T tilt{};              // GGX's width of the normals
  T cone{};              // tangent of half the angle of the cone that a flake reflects into
  T one_minus_cosine{};  // of that angle

  FACET_INLINE FlakeWidths() {}

  FACET_INLINE explicit FlakeWidths(T roughness) {
    // The least width: a highlight of 0.2 degrees, as for other surfaces. The cone's angle is at most 7 degrees.
    constexpr float kLeast = 0.002f, kLargestCone2 = 0.00374082f;
    whole = Clamp(roughness, T(kLeast), T(1.0f));
    const T square = whole * whole, cone2 = Min(square * T(0.5f), T(kLargestCone2));
    tilt = Sqrt(square - cone2);
    cone = Sqrt(cone2);
    one_minus_cosine = T(2.0f) * cone2 / (T(1.0f) + cone2);
  }
};

template <class T>
struct FlakeLayer {
  FlakeWidths<T> widths;
  Vec3<T> color, flip_flop_color;
  T flip_flop{};
  T coverage{};
  T is_flake{};          // 1 where a flake lies at the point, else 0
  T filtered{};          // 0: single flakes are seen, 1: their mean
  Vec3<T> flake_normal;  // of the cell at the point, unit

  FACET_INLINE FlakeLayer() {}  // for a layer that a material does not have

  FACET_INLINE FlakeLayer(const FlakeInputs<T>& in, const SurfaceView<T>& at) : widths(in.roughness) {
    const T zero(0.0f), one(1.0f);
    color = in.color;
    flip_flop_color = in.flip_flop_color;
    flip_flop = Clamp(in.flip_flop, zero, one);
    coverage = Clamp(in.coverage, zero, one);
    // The edge of a square, in metres: its area is that of a regular hexagon of the flake's diameter.
    const T edge = in.size_mm * T(1e-3f * 0.5f * 1.6118548977f);
    const T squares = Min(in.metres_per_uv / Max(edge, T(1e-12f)), T(1e12f));
    const Vec2<T> place{in.at.uv.x * squares, in.at.uv.y * squares};
    const T longest2 = Max(Dot(in.at.dx, in.at.dx), Dot(in.at.dy, in.at.dy));
    const T squares_per_pixel = Sqrt(longest2) * squares;
    const T t = Clamp(squares_per_pixel * T(2.0f) - one, zero, one);  // from half a cell a pixel to one
    const auto is_seen = (in.size_mm > zero) & (in.metres_per_uv > zero);
    filtered = Select(is_seen, t * t * (T(3.0f) - T(2.0f) * t), one);

    const FlakeCell<T> cell = FlakeAt(place);
    is_flake = Select(cell.opacity_threshold < coverage, one, zero);
    // A sample of D(h) (h.n).
    const T a2 = widths.tilt * widths.tilt, denominator = one - (one - a2) * cell.tilt;
    const T cosine = Sqrt((one - cell.tilt) / denominator), sine = Sqrt(a2 * cell.tilt / denominator);
    const T turn = cell.turn * T(2.0f * kPi);
    flake_normal = at.normal * cosine + (in.tangent * Cos(turn) + in.bitangent * Sin(turn)) * sine;
  }

  // The share of the surface that is seen as flakes, which hide what is below.
  FACET_INLINE T Share() const { return Mix(is_flake, coverage, filtered); }

  // The BSDF times the cosine.
  FACET_INLINE Vec3<T> Direct(const SurfaceView<T>& at, const Vec3<T>& light) const {
    const Incidence<T> from = IncidenceFrom(at, light);
    const T value = Mix(is_flake * OfFlake(at, light), coverage * OfMany(at, from), filtered);
    return Select<T>(Dot(at.normal, light) > T(0.0f), Color(from.v_dot_h) * value, Vec3<T>{});
  }

  template <class Lighting>
  FACET_INLINE Vec3<T> Environment(const SurfaceView<T>& at, const Lighting& lighting) const {
    Vec3<T> radiance{};
    const T one(1.0f), seen = is_flake * (one - filtered), mean = coverage * filtered;
    if (Any(seen > T(0.0f))) {
      const T facing = Dot(at.view, flake_normal);
      const Vec3<T> mirrored = flake_normal * (T(2.0f) * facing) - at.view;
      // Of the cone, the share above the surface.
      const T above = Clamp(T(0.5f) + Dot(at.normal, mirrored) * T(0.25f) / widths.cone, T(0.0f), one);
      const T share = Select(facing > T(0.0f), above * seen, T(0.0f));
      radiance += lighting.Prefiltered(mirrored, Sqrt(widths.cone)) * Color(facing) * share;
    }
    if (Any(mean > T(0.0f))) {
      const Vec3<T> mirrored = at.normal * (T(2.0f) * at.n_dot_v) - at.view;
      const Vec3<T> direction = Mix(mirrored, at.normal, ToNormal(widths.whole));
      radiance +=
          lighting.Prefiltered(direction, Sqrt(widths.whole)) * Color(at.n_dot_v) * (MeanAlbedo(at.n_dot_v) * mean);
    }
    return radiance;
  }

  // The share of light that the mean of many white flakes reflects upwards.
  FACET_INLINE T MeanAlbedo(T n_dot_v) const {
    const T a2 = widths.whole * widths.whole, one(1.0f), sum = one + a2, c2 = n_dot_v * n_dot_v;
    const T tangent2 = Max(one - c2, T(0.0f)) / c2;
    return T(0.5f) + T(0.5f) * (one - a2) / Sqrt(sum * sum + T(4.0f) * a2 * tangent2);
  }

 private:
  // `cosine`: of the view with the facet that reflects.
  FACET_INLINE Vec3<T> Color(T cosine) const {
    const T x = Clamp(cosine, T(1e-6f), T(1.0f));
    const T power = Exp2(Max(Log2(x) / Max(flip_flop * flip_flop, T(1e-4f)), T(-120.0f)));
    return Mix(color, flip_flop_color, Select(flip_flop > T(0.0f), power, T(0.0f)));
  }

  // One flake: even within its cone. The edge is a ramp over a tenth of the solid angle.
  FACET_INLINE T OfFlake(const SurfaceView<T>& at, const Vec3<T>& light) const {
    const T facing = Dot(at.view, flake_normal);
    const Vec3<T> off = light - (flake_normal * (T(2.0f) * facing) - at.view);
    const T outward = Dot(off, off) * T(0.5f) / widths.one_minus_cosine;  // 1 at the edge
    const T inside = Clamp((T(1.05f) - outward) * T(10.0f), T(0.0f), T(1.0f));
    return Select(facing > T(0.0f), inside * T(0.5f * kInversePi) / widths.one_minus_cosine, T(0.0f));
  }

  // The mean of many.
  FACET_INLINE T OfMany(const SurfaceView<T>& at, const Incidence<T>& from) const {
    const T n_dot_h = Max(Dot(at.normal, from.half), T(0.0f));
    return DistributionGgx(at.normal, from.half, widths.whole) * n_dot_h * T(0.25f) / Max(from.v_dot_h, T(kMinNDotV));
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace facet
HWY_AFTER_NAMESPACE();

#endif
