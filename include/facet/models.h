// The shading models that have parameters of their own, beside those of glTF.
#pragma once

#include <variant>

#include "facet/models/enterprise.h"
#include "facet/models/filament.h"
#include "facet/models/lecture.h"

namespace facet {

// Material::parameters. The alternatives belong to the models of the same names.
struct ModelParameters : std::variant<LectureParameters, FilamentParameters, EnterpriseParameters> {
  using variant::variant;
};

}  // namespace facet
