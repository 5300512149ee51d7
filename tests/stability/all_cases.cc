#include "stability/stability_case.h"

namespace facet::stability {

std::vector<Case> AllCases() {
  std::vector<Case> all;
  for (const auto& family : {BrdfCases(), ClosureCases(), LayerCases(), GlassCases(), ModelCases(), PlacementCases(),
                             TriangleCases(), TransformCases(), TextureCases(), LightCases(), FilmCases()}) {
    all.insert(all.end(), family.begin(), family.end());
  }
  return all;
}

}  // namespace facet::stability
