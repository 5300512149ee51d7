// The parameters of the model "enterprise".
#pragma once

#include "facet/models/parameter.h"

namespace facet {

struct EnterpriseParameters {
  Textured<glm::vec3> albedo{glm::vec3(1.0f)};
  Textured<float> metallic{0.0f};
  Textured<float> roughness{0.0f};
  TangentSpaceNormal normal;
  Textured<float> cutout_opacity{1.0f};
};

}  // namespace facet
