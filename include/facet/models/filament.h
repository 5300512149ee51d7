// The parameters of the model "filament".
#pragma once

#include "facet/models/parameter.h"

namespace facet {

struct FilamentParameters {
  Textured<glm::vec4> base_color{glm::vec4(1.0f)};
  Textured<float> metallic{0.0f};
  Textured<float> roughness{1.0f};
  TangentSpaceNormal normal;
  Textured<float> ambient_occlusion{1.0f};
  Textured<glm::vec4> emissive{glm::vec4(0.0f)};
};

}  // namespace facet
