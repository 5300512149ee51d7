#include "render/render_in_double.h"

#include "facet/error.h"
#include "facet/render.h"
#include "shade/shade_in_double.h"

namespace facet {

Film RenderInDouble(const Scene& scene, const RenderSettings& settings) {
  if (settings.HasShaders()) {
    throw Error(ErrorCode::InvalidUsage, "a shader of one's own has no form in double", "render settings");
  }
  const auto shader = MakeDoubleShader();
  RenderSettings in_double = settings;
  in_double.shader = shader.get();
  return Render(scene, in_double);
}

}  // namespace facet
