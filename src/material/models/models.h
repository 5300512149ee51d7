// The table of shading models. A model is a functor of its own file beside this one; it is compiled for lanes of every
// instruction set and in double by the shading stage, which loops over FACET_SHADING_MODELS.
#pragma once

#include <array>
#include <cstddef>

#include "facet/scene.h"
#include "material/slots.h"

// Names of functors, in the order of ShadingModel.
#define FACET_SHADING_MODELS(X) X(MetallicRoughness) X(Unlit)

namespace facet {

struct ModelInfo {
  ShadingModel model;
  const char* word;                // in the output of `facet info`
  const char* gltf_extension;      // whose presence chooses it; null: glTF's own
  MaterialFeatures texture_slots;  // bits of those that it reads
  bool reads_light;
};

inline constexpr auto kModels = std::to_array<ModelInfo>({
    {ShadingModel::MetallicRoughness, "metallic-roughness", nullptr, kTextureBits, true},
    {ShadingModel::Unlit, "unlit", "KHR_materials_unlit", BitOf(Slot::BaseColor), false},
});
inline constexpr std::size_t kModelCount = kModels.size();

#define FACET_MODEL_IN_ORDER(Name) &&kModels[i].model == ShadingModel::Name&& i++ < kModelCount
static_assert(
    [] {
      std::size_t i = 0;
      return true FACET_SHADING_MODELS(FACET_MODEL_IN_ORDER) && i == kModelCount;
    }(),
    "the table and the list of functors agree");
#undef FACET_MODEL_IN_ORDER

constexpr const ModelInfo& InfoOf(ShadingModel model) { return kModels[static_cast<std::size_t>(model)]; }

}  // namespace facet
