// The table of shading models. A model is a functor in a file of its own beside this one. The shading stage, which
// loops over FACET_SHADING_MODELS, compiles it for the lanes of every instruction set, and for double. The reference
// has its own evaluation of each (reference/models_exact.cc).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "facet/models/enterprise.h"
#include "facet/scene.h"
#include "material/slots.h"

// Names of functors, in the order of ShadingModel.
#define FACET_SHADING_MODELS(X) FACET_GLTF_MODELS(X) FACET_OWN_MODELS(X)
#define FACET_GLTF_MODELS(X) X(MetallicRoughness) X(SpecularGlossiness) X(Unlit)
// Those that have parameters of their own.
#define FACET_OWN_MODELS(X) X(Lecture) X(Filament) X(Enterprise)

// Those that light can pass through. (Specular-glossiness materials have metallic-roughness' closure, and its kernels.)
#define FACET_MODELS_SEEN_THROUGH(X) X(MetallicRoughness) X(Filament) X(Enterprise)

namespace facet {

struct ModelInfo {
  ShadingModel model;
  const char* word;                // in the output of `facet info`, and in material files
  const char* gltf_extension;      // the extension that selects it; null: core glTF
  MaterialFeatures reads;          // bits of glTF's texture slots and features that it reads
  bool reads_light;
  // Of models with parameters of their own: a sentence, and where the formulas come from.
  const char* summary = "";
  const char* source = "";
};

inline constexpr MaterialFeatures kMetallicRoughnessOnly =
    BitOf(Slot::MetallicRoughness) | BitOf(Slot::Specular) | BitOf(Slot::SpecularColor) | kSpecular | kIor;
inline constexpr MaterialFeatures kAllButSpecularGlossiness = ~BitOf(Slot::SpecularGlossiness);

inline constexpr auto kModels = std::to_array<ModelInfo>({
    {ShadingModel::MetallicRoughness, "metallic-roughness", nullptr, kAllButSpecularGlossiness, true},
    {ShadingModel::SpecularGlossiness, "specular-glossiness", "KHR_materials_pbrSpecularGlossiness",
     ~kMetallicRoughnessOnly, true},
    {ShadingModel::Unlit, "unlit", "KHR_materials_unlit", BitOf(Slot::BaseColor), false},
    {ShadingModel::Lecture, "lecture", nullptr, 0, true,
     "The textbook's microfacet model, with each of its terms a choice.",
     "Akenine-Moller et al., 2018, Real-Time Rendering, chapter 9; Karis, 2013, Real Shading in Unreal Engine 4"},
    {ShadingModel::Filament, "filament", nullptr, 0, true,
     "The material models of the engine Filament: lit, cloth, subsurface, specular-glossiness and unlit.",
     "Guy and Agopian, 2018, Physically Based Rendering in Filament"},
    {ShadingModel::Enterprise, "enterprise", nullptr, 0, true,
     "Layers for products: a core of metal, plastic and glass under film, sheen, flakes and a clear coat.",
     kEnterpriseAcknowledgement},
});

#define FACET_MODEL_OF(Name) ShadingModel::Name,
static_assert(std::ranges::equal(std::to_array({FACET_SHADING_MODELS(FACET_MODEL_OF)}), kModels, {}, {},
                                 &ModelInfo::model),
              "the table and the list of functors agree");
#undef FACET_MODEL_OF

constexpr const ModelInfo& InfoOf(ShadingModel model) { return kModels[static_cast<std::size_t>(model)]; }

}  // namespace facet
