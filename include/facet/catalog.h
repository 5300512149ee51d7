// The shading models that have parameters of their own: what they are, as text, as a schema and as pictures.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "facet/image.h"
#include "facet/models.h"
#include "facet/scene.h"

namespace facet {

struct ParameterDescription {
  std::string name;  // as the model's documentation and material files write it
  std::string type;  // "number", "colour", "colour with alpha", "direction", "choice" or "true or false"
  std::vector<std::string> choices;  // of a choice
  std::vector<float> initial;        // its default; of a choice, the index
  float low = 0.0f, high = 0.0f;     // the range of each number; may be infinite
  std::optional<float> other;        // one more value that each number may have
  std::string unit;                  // empty: none
  std::string meaning;               // a phrase
  bool textured = false;             // whether a texture may scale it
};

// Named values, which material files start from.
struct PresetDescription {
  std::string name;
  // Those that are not the defaults, by the parameter's name: as ParameterDescription::initial.
  std::vector<std::pair<std::string, std::vector<float>>> stated;
};

struct ModelDescription {
  ShadingModel model;
  std::string name;     // in material files
  std::string summary;  // a sentence
  std::string source;   // where its formulas come from, with what its licence asks to be said
  std::vector<ParameterDescription> parameters;
  std::vector<PresetDescription> presets;
};

// All models with parameters of their own.
std::vector<ModelDescription> DescribeModels();

// The JSON schema (draft 2020-12) of material files.
std::string MaterialFileSchema();

// A picture in which each parameter goes from one end of its range to the other on spheres, a row each, lit by the
// built-in studio: U8, sRGB, 3 channels. Throws Error(InvalidUsage) for glTF's models.
Image ChartModel(ShadingModel model);

// The same base colour, metalness and roughness, drawn by glTF's model and by each model with parameters of its own.
struct ModelComparison {
  std::vector<std::string> models;     // the columns; the first is glTF's
  std::vector<std::string> materials;  // the rows
  // By row and column: the mean FLIP (facet/compare.h) against glTF's model, over the sphere's square.
  std::vector<std::vector<double>> flip;
  Image picture;  // U8, sRGB, 3 channels
};
ModelComparison CompareModels();

}  // namespace facet
