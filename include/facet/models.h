// The shading models that have parameters of their own, beside those of glTF.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "facet/models/enterprise.h"
#include "facet/models/filament.h"
#include "facet/models/lecture.h"

namespace facet {

// Material::parameters. The alternatives belong to the models of the same names.
struct ModelParameters : std::variant<LectureParameters, FilamentParameters, EnterpriseParameters> {
  using variant::variant;
};

// Gives the materials that have one of glTF's models another one, with the parameters that come nearest to what they
// state; parts without a material get one. Materials of other models stay as they are. Returns a sentence for each
// combination of what is lost. `model`: not one of glTF's. Unlit materials stay as they are if it has none.
std::vector<std::string> ConvertMaterials(Scene& scene, ShadingModel model);

}  // namespace facet
