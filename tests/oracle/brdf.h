// glTF 2.0's metallic-roughness BRDF (specification, appendix B) with the energy that docs/materials.md adds, written
// out in double; the albedos that it needs are integrals, done here by brute force.
#pragma once

#include "oracle/vec.h"

namespace oracle {

// Facet reads the albedos of the added energy from tables and interpolates: right to some 1e-3 of what they are part
// of. Pixels are expected within kLitTolerance of what they should be, or of kLitFloor where they are darker; lamps
// here give 1 to 5 lux.
constexpr double kLitTolerance = 3e-3, kLitFloor = 0.2;

struct Surface {
  Vec base{1, 1, 1};                       // linear
  double metallic = 1.0, roughness = 1.0;  // glTF's defaults
};

// BRDF times n.l, in 1/sr, of unit vectors; 0 for light from below.
Vec Reflect(const Surface& surface, Vec normal, Vec view, Vec light);

// What of a constant light of 1 from all around is reflected to `view`.
Vec ReflectAll(const Surface& surface, Vec normal, Vec view);

}  // namespace oracle
