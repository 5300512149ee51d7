// The parameters of the model "lecture".
#pragma once

#include "facet/models/parameter.h"

namespace facet {

struct LectureParameters {
  Textured<glm::vec4> albedo{glm::vec4(1.0f)};
  Textured<float> metalness{0.0f};
  Textured<float> roughness{0.5f};
  TangentSpaceNormal normal;
  Textured<float> ambient_occlusion{1.0f};
  Textured<glm::vec3> emission{glm::vec3(0.0f)};
};

}  // namespace facet
