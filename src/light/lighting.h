// The lights and the environment of a frame, in the form that shading kernels take.
#pragma once

#include "light/albedo_tables.h"
#include "light/anisotropic_dfg.h"
#include "light/dfg.h"
#include "light/environment.h"
#include "light/punctual.h"
#include "light/sheen_albedo.h"

namespace facet {

// Does not own what it points to.
struct LightingData {
  const PunctualLight* lights = nullptr;
  int light_count = 0;
  const EnvironmentMap* environment = nullptr;  // null: no image-based lighting
  const DfgTable* dfg = nullptr;                // never null
  const SheenTable* sheen = nullptr;            // null: no material has sheen
  const SheenTable* cloth = nullptr;            // null: no material has Filament's fibres
  const AnisotropicDfgTable* anisotropic_dfg = nullptr;           // null: no material is anisotropic
  const DfgTable* schlick_dfg[2] = {};                            // of either LectureAlpha; null: no material reads it
  float environment_from_world[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};  // row by row: d_env[r] = sum over c of m[3 r + c] d[c]
  float environment_intensity = 1.0f;
};

// `environment` may be null. `rotation`: of the environment, in radians about +Y, counter-clockwise seen from above.
// `intensity`: a factor for the environment. `tables`: those that a material needs.
LightingData MakeLightingData(const std::vector<PunctualLight>& lights, const EnvironmentMap* environment,
                              double rotation = 0.0, double intensity = 1.0, AlbedoTables tables = {});

}  // namespace facet
