#include "light/lighting.h"

#include "math/elementary.h"

namespace facet {

LightingData MakeLightingData(const std::vector<PunctualLight>& lights, const EnvironmentMap* environment,
                              double rotation, double intensity, AlbedoTables tables) {
  LightingData data;
  data.lights = lights.data();
  data.light_count = static_cast<int>(lights.size());
  data.environment = environment;
  data.dfg = &SharedDfgTable();
  if (tables.sheen) data.sheen = &SharedSheenTable();
  if (tables.cloth) data.cloth = &SharedClothTable();
  if (tables.anisotropic_dfg) data.anisotropic_dfg = &SharedAnisotropicDfgTable();
  for (const LectureAlpha alpha : {LectureAlpha::RoughnessSquared, LectureAlpha::Roughness}) {
    const auto i = static_cast<std::size_t>(alpha);
    if (tables.schlick_dfg[i]) data.schlick_dfg[i] = &SharedSchlickDfgTable(alpha);
  }
  // The environment is turned by +rotation, so a direction is looked up turned by -rotation:
  // x' = c x - s z, z' = s x + c z, where turning by +rotation is x' = c x + s z, z' = c z - s x.
  const auto c = static_cast<float>(Cos(rotation));
  const auto s = static_cast<float>(Sin(rotation));
  const float rows[9] = {c, 0.0f, -s, 0.0f, 1.0f, 0.0f, s, 0.0f, c};
  for (int i = 0; i < 9; ++i) data.environment_from_world[i] = rows[i];
  data.environment_intensity = static_cast<float>(intensity);
  return data;
}

}  // namespace facet
