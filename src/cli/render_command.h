// `facet render`: renders a scene to a picture file.
#pragma once

#include "cli/options.h"

namespace facet::cli {

// Loads the scene, renders it, and writes the encoded image. Warnings go to standard error. Throws Error.
void RunRender(RenderOptions options);

}  // namespace facet::cli
