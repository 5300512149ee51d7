// The same image without rounding in between.
#pragma once

#include "facet/film.h"
#include "facet/settings.h"

namespace facet {

// Render(), with every fragment shaded in double (see shade/shade_in_double.h): its difference to Render()'s film is
// the rounding error. The settings have no shaders. Throws what Render() throws, and InvalidUsage for a shader.
Film RenderInDouble(const Scene& scene, const RenderSettings& settings);

}  // namespace facet
