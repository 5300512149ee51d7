// All light of a frame, as it crosses into a kernel.
#pragma once

#include "light/dfg.h"
#include "light/environment.h"
#include "light/punctual.h"

namespace facet {

// Refers to what it was made from.
struct LightingData {
  const PunctualLight* lights = nullptr;
  int light_count = 0;
  const EnvironmentMap* environment = nullptr;  // may be null: no light from all around
  const DfgTable* dfg = nullptr;                // never null
  float environment_from_world[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};  // row by row: d_env[r] = sum over c of m[3 r + c] d[c]
  float environment_intensity = 1.0f;
};

// `environment` may be null. `rotation`: radians about +Y, counter-clockwise seen from above; `intensity` scales it.
LightingData MakeLightingData(const std::vector<PunctualLight>& lights, const EnvironmentMap* environment,
                              double rotation = 0.0, double intensity = 1.0);

}  // namespace facet
