// What the model "enterprise" needs to know of the mesh that it is on.
#pragma once

#include <array>

#include "facet/models/enterprise.h"
#include "scene/pose.h"

namespace facet {

struct MeshMeasures {
  double area = 0.0;           // m2, world
  double mean_chord = 0.0;     // metres: 4 volume / area, the mean length of straight ways through a closed convex mesh
  double metres_per_uv = 0.0;  // the square root of the mesh's area over that in TEXCOORD_0; 0: it has none
};
MeshMeasures MeasureMesh(const Drawable& drawable);

// The parameters that depend on the mesh: emission, thickness, scale of TEXCOORD_0. Drawables of one material that
// agree in them share a plan.
using EnterpriseMeasures = std::array<float, 3>;

// As a plan needs them: emission in lm/m2, thickness and scale measured. Zeros for what the parameters
// do not use, so that meshes are measured only where it shows.
EnterpriseMeasures MeasuresFor(const EnterpriseParameters& p, const Drawable& drawable);
EnterpriseParameters WithMeasures(EnterpriseParameters p, const EnterpriseMeasures& measures);

}  // namespace facet
