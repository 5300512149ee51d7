// What glTF's materials state, in the parameters of other models.
#pragma once

#include <string>
#include <vector>

#include "facet/models.h"

namespace facet {

struct FromGltf {
  ModelParameters parameters;
  std::vector<std::string> lost;  // what the model does not have, in words
};

// The nearest parameters of `model`, which is not glTF's, to those of a material of one of glTF's models.
FromGltf ConvertFromGltf(const Material& material, ShadingModel model);

// A sentence that says what is lost.
std::string SentenceOf(const std::vector<std::string>& lost, ShadingModel model);

// The index of a material for parts without one, which is added at the end of `materials` if the scene has such parts
// and `index` is -1.
void AddDefaultMaterial(const Scene& scene, std::vector<Material>& materials, int& index);
void UseDefaultMaterial(Scene& scene, int index);

}  // namespace facet
