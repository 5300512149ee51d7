// The models as text, as a schema and as pictures.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "catalog/sphere_sheet.h"
#include "facet/catalog.h"
#include "facet/error.h"

namespace facet {
namespace {

TEST(Catalog, EveryModelHasParametersWithWords) {
  const std::vector<ModelDescription> models = DescribeModels();
  ASSERT_EQ(models.size(), 3u);
  for (const ModelDescription& model : models) {
    EXPECT_FALSE(model.summary.empty() || model.source.empty()) << model.name;
    std::set<std::string> names;
    for (const ParameterDescription& parameter : model.parameters) {
      EXPECT_TRUE(names.insert(parameter.name).second) << model.name << ": " << parameter.name << " is twice";
      EXPECT_FALSE(parameter.meaning.empty()) << parameter.name;
      EXPECT_EQ(parameter.choices.empty(), parameter.type != "choice") << parameter.name;
      for (const float number : parameter.initial) {
        if (parameter.type != "number" && parameter.type != "colour") continue;
        EXPECT_TRUE((number >= parameter.low && number <= parameter.high) || number == parameter.other)
            << model.name << ": " << parameter.name;
      }
    }
    EXPECT_FALSE(model.parameters.empty());
  }
}

TEST(Catalog, ThePublishedSchemaIsThePrograms) {
  std::ifstream file(std::string(FACET_SOURCE_DIR) + "/docs/material-file.schema.json");
  std::stringstream published;
  published << file.rdbuf();
  EXPECT_TRUE(published.str() == MaterialFileSchema())
      << "write it anew: facet models --schema > docs/material-file.schema.json";
  const auto schema = nlohmann::json::parse(MaterialFileSchema());
  EXPECT_EQ(schema.at("/properties/materials/items/oneOf"_json_pointer).size(), 3u);
}

// The largest difference between neighbouring cells of a row, in codes.
int ChangeAlong(const Image& picture, std::size_t row, std::size_t cells) {
  int change = 0;
  for (std::size_t c = 1; c < cells; ++c) {
    for (int y = 0; y < kCellSize; ++y) {
      for (int x = 0; x < kCellSize; ++x) {
        const auto at = [&](std::size_t column) {
          return picture.As<unsigned char>()[3 * (std::size_t(Sheet::Top(row) + y) * std::size_t(picture.width) +
                                                  std::size_t(Sheet::Left(column) + x))];
        };
        change = std::max(change, std::abs(at(c) - at(c - 1)));
      }
    }
  }
  return change;
}

TEST(Catalog, EveryParameterShowsInItsChart) {
  for (const ModelDescription& model : DescribeModels()) {
    const Image chart = ChartModel(model.model);
    std::size_t row = 0;
    for (const ParameterDescription& parameter : model.parameters) {
      // The first is not drawn (docs/models/enterprise.md), the second shows under lamps only.
      const bool is_drawn = parameter.name != "displacement" && parameter.name != "subsurfacePower";
      const std::size_t cells = parameter.type == "choice"          ? std::min<std::size_t>(parameter.choices.size(), 8)
                                : parameter.type == "true or false" ? 2
                                                                    : 6;
      EXPECT_EQ(ChangeAlong(chart, row, cells) >= 2, is_drawn) << model.name << ": " << parameter.name;
      row += std::max<std::size_t>((parameter.choices.size() + 7) / 8, 1);  // long lists go on in the next row
    }
  }
  EXPECT_THROW(ChartModel(ShadingModel::Unlit), Error);
}

TEST(Catalog, TheComparisonMeasuresFromGltfsModel) {
  const ModelComparison comparison = CompareModels();
  EXPECT_EQ(comparison.models.at(0), "metallic-roughness");
  ASSERT_EQ(comparison.flip.size(), comparison.materials.size());
  for (const std::vector<double>& row : comparison.flip) {
    ASSERT_EQ(row.size(), comparison.models.size());
    EXPECT_EQ(row[0], 0.0);
    // The lecture's model loses two thirds of the light on rough metal.
    for (std::size_t c = 1; c < row.size(); ++c) EXPECT_LT(row[c], 0.7) << comparison.models[c];
  }
  EXPECT_GT(ChangeAlong(comparison.picture, 0, comparison.models.size()), 0);
}

}  // namespace
}  // namespace facet
