// Parts of material files for the rest of facet; ApplyMaterialFile() is in facet/load.h.
#pragma once

#include <string>

#include "facet/models.h"

namespace facet {

// Sets parameters by the text of a JSON object, as "parameters" in a material file. `name`: in messages. Throws
// Error(InvalidInput).
void StateParameters(const std::string& json, const std::string& name, ModelParameters& parameters);

}  // namespace facet
