// CompareModels() of facet/catalog.h.
#include <array>
#include <cstring>
#include <memory>

#include "base/number_text.h"
#include "catalog/sphere_sheet.h"
#include "facet/catalog.h"
#include "facet/compare.h"
#include "material/from_gltf.h"
#include "material/model_parameters.h"
#include "material/models/models.h"

namespace facet {
namespace {

struct Look {
  const char* name;
  glm::vec3 base_color;
  float metalness;
};
constexpr std::array kLooks = {
    Look{"white plastic", glm::vec3(0.8f), 0.0f}, Look{"red plastic", glm::vec3(0.7f, 0.05f, 0.03f), 0.0f},
    Look{"half metal", glm::vec3(0.7f, 0.5f, 0.3f), 0.5f}, Look{"gold", glm::vec3(1.0f, 0.78f, 0.34f), 1.0f}};
constexpr std::array kRoughnesses = {0.0f, 0.25f, 0.5f, 1.0f};

Material MaterialLike(ShadingModel model, const Look& look, float roughness) {
  Material material;
  material.base_color_factor = glm::vec4(look.base_color, 1.0f);
  material.metallic_factor = look.metalness;
  material.roughness_factor = roughness;
  if (HasParameters(model)) {
    material.parameters = std::make_shared<const ModelParameters>(ConvertFromGltf(material, model).parameters);
    material.model = model;
  }
  return material;
}

Image CellOf(const Image& sheet, std::size_t row, std::size_t column) {
  Image cell{kCellSize, kCellSize, 3, ChannelType::U8, Encoding::Srgb, {}};
  cell.bytes.resize(cell.PixelCount() * 3);
  for (int y = 0; y < kCellSize; ++y) {
    const auto from = (std::size_t(Sheet::Top(row) + y) * std::size_t(sheet.width) + std::size_t(Sheet::Left(column)));
    std::memcpy(&cell.bytes[std::size_t(y) * kCellSize * 3], &sheet.bytes[from * 3], std::size_t{kCellSize} * 3);
  }
  return cell;
}

}  // namespace

ModelComparison CompareModels() {
  ModelComparison comparison;
  std::vector<ShadingModel> models = {ShadingModel::MetallicRoughness};
  for (const ModelDescription& model : DescribeModels()) models.push_back(model.model);
  for (const ShadingModel model : models) comparison.models.emplace_back(InfoOf(model).word);

  std::vector<SheetRow> rows;
  for (const Look& look : kLooks) {
    for (const float roughness : kRoughnesses) {
      SheetRow& row = rows.emplace_back();
      row.label = std::string(look.name) + "\nroughness " + ShortNumber(double{roughness});
      comparison.materials.push_back(std::string(look.name) + ", roughness " + ShortNumber(double{roughness}));
      for (const ShadingModel model : models) {
        row.cells.push_back({MaterialLike(model, look, roughness), InfoOf(model).word});
      }
    }
  }
  Sheet sheet = DrawSheet(rows);
  for (std::size_t r = 0; r < rows.size(); ++r) {
    std::vector<double>& flip = comparison.flip.emplace_back();
    const Image reference = CellOf(sheet.picture, r, 0);
    for (std::size_t c = 0; c < models.size(); ++c) {
      flip.push_back(CompareImages(reference, CellOf(sheet.picture, r, c)).flip_mean);
    }
  }
  comparison.picture = std::move(sheet.picture);
  return comparison;
}

}  // namespace facet
