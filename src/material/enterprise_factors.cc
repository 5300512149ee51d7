#include "material/enterprise_factors.h"

#include <algorithm>
#include <cmath>

#include "math/elementary.h"
#include "math/round_to_float.h"

namespace facet {
namespace {

double Square(double x) { return x * x; }

// Extinction per metre; bounded, because a medium of attenuation distance 0 is opaque.
double Extinction(double color, double distance) {
  constexpr double kDarkest = 1e-30, kMost = 1e30;
  if (distance == 0.0) return kMost;
  return std::min(-Log(std::clamp(color, kDarkest, 1.0)) / distance, kMost);
}

}  // namespace

double SingleScatteringAlbedo(double multiple) {
  const double m = std::clamp(multiple, 0.0, 1.0);
  const double root = std::sqrt(9.59217 + 41.6808 * m + 17.7126 * m * m);
  return std::clamp(1.0 - Square(4.09712 + 4.20863 * m - root), 0.0, 1.0);
}

void SetEnterpriseFactors(const EnterpriseParameters& p, MaterialFactors& factors) {
  const double index = double(p.ior);
  factors.dielectric_f0 = RoundToFiniteFloat(Square((index - 1.0) / (index + 1.0)));
  // A thin wall does not refract, and spreads light as widely as it reflects it: that is what an index of 1.5 does
  // (material/lobes/transmission-inl.h).
  if (p.thin_walled) {
    std::fill_n(factors.ior, 3, 1.5f);
    return;
  }
  constexpr double kNanometres[3] = {656.27, 587.56, 486.13};
  for (int c = 0; c < 3; ++c) {
    const double shift = p.abbe_number == 0.0f || c == 1
                             ? 0.0
                             : (index - 1.0) / double(p.abbe_number) * (523655.0 / Square(kNanometres[c]) - 1.5168);
    factors.ior[c] = RoundToFiniteFloat(std::clamp(index + shift, 1.0, 1e6));
    const double forwards = double(p.subsurface_anisotropy) * SingleScatteringAlbedo(double(p.subsurface_color[c]));
    const double extinction = Extinction(double(p.attenuation_color[c]), double(p.attenuation_distance));
    factors.absorption[c] = RoundToFiniteFloat(extinction * (1.0 - forwards));
  }
  factors.thickness = p.thickness;
}

}  // namespace facet
