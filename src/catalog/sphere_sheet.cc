#include "catalog/sphere_sheet.h"

#include <algorithm>
#include <numbers>

#include "facet/film.h"
#include "facet/render.h"
#include "image/draw_text.h"
#include "material/features.h"
#include "math/elementary.h"

namespace facet {
namespace {

constexpr int kLabelWidth = 180, kTextHeight = kFontHeight + 3, kMargin = 4;
constexpr float kHalfCell = 1.12f;  // in radii of a sphere
constexpr unsigned char kInk = 225;

// Of radius 1, with texture coordinates.
Primitive Sphere() {
  constexpr int kRings = 48, kSegments = 96;
  Primitive sphere;
  sphere.tex_coords.resize(1);
  for (int i = 0; i <= kRings; ++i) {
    for (int k = 0; k <= kSegments; ++k) {
      const double v = double(i) / kRings, u = double(k) / kSegments;
      const double theta = std::numbers::pi * v, phi = 2.0 * std::numbers::pi * u;
      const glm::dvec3 n(Sin(theta) * Sin(phi), Cos(theta), Sin(theta) * Cos(phi));
      sphere.positions.emplace_back(n);
      sphere.normals.emplace_back(n);
      sphere.tex_coords[0].emplace_back(u, v);
    }
  }
  for (std::uint32_t i = 0; i < kRings; ++i) {
    for (std::uint32_t k = 0; k < kSegments; ++k) {
      const std::uint32_t a = i * (kSegments + 1) + k, b = a + kSegments + 1;
      sphere.indices.insert(sphere.indices.end(), {a, b, b + 1, a, b + 1, a + 1});
    }
  }
  return sphere;
}

// Eight by eight squares, black and white by vertex colours.
Primitive Checkerboard() {
  constexpr int kSquares = 8;
  Primitive board;
  for (int y = 0; y < kSquares; ++y) {
    for (int x = 0; x < kSquares; ++x) {
      const auto first = static_cast<std::uint32_t>(board.positions.size());
      for (int corner = 0; corner < 4; ++corner) {
        const int cx = x + (corner == 1 || corner == 2), cy = y + (corner >= 2);
        board.positions.emplace_back(2.0f * float(cx) / kSquares - 1.0f, 2.0f * float(cy) / kSquares - 1.0f, -1.5f);
        board.colors.emplace_back(glm::vec3((x + y) % 2 == 0 ? 0.6f : 0.1f), 1.0f);
      }
      board.indices.insert(board.indices.end(), {first, first + 1, first + 2, first, first + 2, first + 3});
    }
  }
  return board;
}

int MeshOf(Scene& scene, Primitive primitive, const Material& material) {
  primitive.material = static_cast<int>(scene.materials.size());
  scene.materials.push_back(material);
  scene.meshes.emplace_back().primitives.push_back(std::move(primitive));
  return static_cast<int>(scene.meshes.size()) - 1;
}

void Place(Scene& scene, int mesh, const glm::dvec2& at) {
  Node node;
  node.mesh = mesh;
  node.transform.translation = glm::dvec3(at, 0.0);
  scene.nodes.push_back(node);
}

}  // namespace

int Sheet::Left(std::size_t column) { return kLabelWidth + static_cast<int>(column) * (kCellSize + kMargin); }
int Sheet::Top(std::size_t row) { return kMargin + static_cast<int>(row) * (kCellSize + kTextHeight + kMargin); }

Sheet DrawSheet(const std::vector<SheetRow>& rows) {
  std::size_t columns = 0;
  for (const SheetRow& row : rows) columns = std::max(columns, row.cells.size());
  RenderSettings settings;
  settings.width = Sheet::Left(columns);
  settings.height = Sheet::Top(rows.size());
  settings.samples = 8;

  // The scene's unit is a sphere's radius; its origin is the picture's top left corner.
  constexpr double kUnits = 2.0 * double{kHalfCell} / kCellSize;  // of a pixel
  Scene scene;
  const Primitive sphere = Sphere(), checkerboard = Checkerboard();
  Material unlit;
  unlit.model = ShadingModel::Unlit;
  const int board = MeshOf(scene, checkerboard, unlit);
  for (std::size_t r = 0; r < rows.size(); ++r) {
    for (std::size_t c = 0; c < rows[r].cells.size(); ++c) {
      const Material& material = rows[r].cells[c].material;
      const glm::dvec2 center((Sheet::Left(c) + kCellSize / 2) * kUnits, -(Sheet::Top(r) + kCellSize / 2) * kUnits);
      Place(scene, MeshOf(scene, sphere, material), center);
      const bool is_see_through = material.alpha_mode != AlphaMode::Opaque ||
                                  (FeaturesOf(material) & (kTransmission | kDiffuseTransmission)) != 0;
      if (is_see_through) Place(scene, board, center);
    }
  }
  FreeCamera camera;
  camera.lens.orthographic = true;
  camera.lens.xmag = settings.width * kUnits / 2.0;
  camera.lens.ymag = settings.height * kUnits / 2.0;
  camera.world_from_camera[3] = glm::dvec4(camera.lens.xmag, -camera.lens.ymag, 10.0, 1.0);
  settings.camera = camera;

  DisplaySettings display;
  display.background_srgb = glm::vec3(0.22f);
  Sheet sheet{EncodeFilm(Render(scene, settings), display)};
  for (std::size_t r = 0; r < rows.size(); ++r) {
    int y = Sheet::Top(r) + kCellSize / 2 - kFontHeight;
    for (std::size_t start = 0; start <= rows[r].label.size(); y += kFontHeight) {
      const std::size_t end = std::min(rows[r].label.find('\n', start), rows[r].label.size());
      DrawText(sheet.picture, kMargin, y, rows[r].label.substr(start, end - start), kInk);
      start = end + 1;
    }
    for (std::size_t c = 0; c < rows[r].cells.size(); ++c) {
      const std::string& label = rows[r].cells[c].label;
      const int inset = std::max(kCellSize - static_cast<int>(label.size()) * kFontWidth, 0) / 2;
      DrawText(sheet.picture, Sheet::Left(c) + inset, Sheet::Top(r) + kCellSize + 1, label, kInk);
    }
  }
  return sheet;
}

}  // namespace facet
