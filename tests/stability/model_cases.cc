// The models with parameters of their own: every parameter at the ends of its range.
#include <array>
#include <memory>
#include <type_traits>
#include <vector>

#include "facet/models.h"
#include "material/model_parameters.h"
#include "material_file/material_file.h"
#include "render/hand_built.h"
#include "render/render_in_double.h"
#include "stability/stability_case.h"

namespace facet::stability {
namespace {

// Stands for an infinite end: light of that strength is still finite after it has been multiplied.
constexpr float kFarEnd = 1e12f;

std::array<float, 2> EndsOf(const ParameterRange& range) {
  return {std::isinf(range.low) ? -kFarEnd : range.low, std::isinf(range.high) ? kFarEnd : range.high};
}

// The blocks in which one parameter has another value: an end of its range, or each word. Directions stay.
template <class Block, class Value>
std::vector<Block> Variants(const Block& base, Value Block::*member, const RowOptions& row) {
  std::vector<Block> variants;
  const auto add = [&](const auto& set) { set(variants.emplace_back(base).*member); };
  if constexpr (std::is_same_v<Value, bool>) {
    for (const bool on : {false, true}) add([on](bool& value) { value = on; });
  } else if constexpr (std::is_enum_v<Value>) {
    for (std::size_t i = 0; i < row.words.size(); ++i) add([i](Value& value) { value = static_cast<Value>(i); });
  } else if constexpr (std::is_same_v<Value, float>) {
    for (const float end : EndsOf(row.range)) add([end](float& value) { value = end; });
  } else if constexpr (std::is_same_v<Value, glm::vec3>) {
    for (const float end : EndsOf(row.range)) add([end](glm::vec3& value) { value = glm::vec3(end); });
  } else if constexpr (!std::is_same_v<Value, TangentSpaceNormal>) {
    using Number = decltype(Value::value);
    for (const float end : EndsOf(row.range)) add([end](Value& value) { value.value = Number(end); });
  }
  return variants;
}

// A sphere for each variant, before a board with stripes, under a lamp and a white environment.
Scene VariantsOf(ShadingModel model) {
  Scene scene;
  std::vector<Material> materials;
  ForEachParameterOf(DefaultsOf(model), [&](const auto& row, const auto&) {
    ModelParameters base = DefaultsOf(model);
    StateParameters(row.chart, row.name, base);  // makes the parameter visible
    std::visit(
        [&]<class Block>(const Block& block) {
          if constexpr (requires { block.*row.member; }) {
            for (const Block& variant : Variants(block, row.member, row)) {
              Material& material = materials.emplace_back();
              material.name = row.name;
              material.model = model;
              if (row.is_coverage) material.alpha_mode = AlphaMode::Blend;
              material.parameters = std::make_shared<const ModelParameters>(variant);
            }
          }
        },
        base);
  });
  Material board;
  board.model = ShadingModel::Unlit;
  board.base_color_texture = Ref(
      AddTexture(scene, MakeImage(8, 8, [](int x, int y) { return glm::u8vec4(x % 2 * 200, y % 2 * 200, 120, 255); })));
  Add(scene, Rectangle(-8, -8, 8, 8, -1.0f), AddMaterial(scene, board));
  constexpr int kColumns = 12;
  for (std::size_t i = 0; i < materials.size(); ++i) {
    Transform at;
    at.translation = {double(i % kColumns) - 5.5, 5.5 - double(i / kColumns), 0.0};
    Add(scene, Sphere(0.45f, 8, 12), AddMaterial(scene, materials[i]), at);
  }
  return scene;
}

// The error is that of float against double.
Measured MeasureEnds(ShadingModel model) {
  Measured m;
  const Scene scene = VariantsOf(model);
  RenderSettings settings = Settings(144, 144, 1, Orthographic(6.0));
  settings.environment = ConstantEnvironment(1.0f);
  const Film film = Draw(scene, settings, m);
  m.Error(LargestRelativeDifference(film, RenderInDouble(scene, settings), 1e-3));
  return m;
}

}  // namespace

std::vector<Case> ModelCases() {
  // Of a lobe as narrow as the models allow, float loses 2.5e-3 (closure_cases.cc); a few of them add up.
  constexpr double kBound = 0.01;
  return {
      {"models", "lecture: each parameter at both ends, each term",
       "roots and logarithms of 0; divisions by a width of 0", "terms bounded as those of glTF's model", "relative",
       kBound, [] { return MeasureEnds(ShadingModel::Lecture); }},
      {"models", "filament: each parameter at both ends, each choice", "absorption of infinity times a thickness of 0",
       "bounded exponents; coverage from 2^-16 on where it divides", "relative", kBound,
       [] { return MeasureEnds(ShadingModel::Filament); }},
      {"models", "enterprise: each parameter at both ends, each choice", "flakes of size 0; emission without area",
       "cells and densities clamped", "relative", kBound, [] { return MeasureEnds(ShadingModel::Enterprise); }},
  };
}

}  // namespace facet::stability
