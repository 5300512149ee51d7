// Shows what the material would show without a shader.
#include "facet/shader/shader-inl.h"

FACET_SHADER_BEGIN
struct ShowModel {
  template <class T>
  FACET_INLINE Shaded<T> operator()(const Surface<T>& surface, const MaterialView<T>& material,
                                    const LightingView<T>& lighting) const {
    return ModelOfMaterial()(surface, material, lighting);
  }
};
FACET_SHADER_END
