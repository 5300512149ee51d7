#include "render/image_warnings.h"

#include <algorithm>

#include "base/memory_budget.h"
#include "facet/error.h"
#include "facet/shader.h"
#include "scene/hierarchy.h"

namespace facet {
namespace {

std::string WhyNothingIsDrawn(const Scene& scene, const RenderSettings& settings) {
  const auto draws = [&](int node) { return scene.nodes[std::size_t(node)].mesh >= 0; };
  const std::vector<int> nodes = NodesOf(scene, settings.scene, /*with_hidden=*/true);
  const std::vector<int> visible = NodesOf(scene, settings.scene, /*with_hidden=*/false);
  if (std::any_of(visible.begin(), visible.end(), draws)) return "its meshes have no vertices; is the file whole?";
  if (std::any_of(nodes.begin(), nodes.end(), draws)) return "every node that has a mesh is hidden; make one visible";
  const bool elsewhere = std::any_of(scene.nodes.begin(), scene.nodes.end(), [](const Node& n) { return n.mesh >= 0; });
  return elsewhere ? "no node of this scene has a mesh; choose another scene of the file"
                   : "no node has a mesh; is it the right file?";
}

// Where a box is that lies completely outside of the view.
std::string WhereOutside(const FrameView& view, const Bounds& box) {
  if (box.empty) return "no vertex has a finite position; is the file whole?";
  double nearest = view.far_distance, farthest = -nearest;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 place(corner & 1 ? box.high.x : box.low.x, corner & 2 ? box.high.y : box.low.y,
                           corner & 4 ? box.high.z : box.low.z);
    const double distance = -(view.camera_from_world * (place - view.eye_world)).z;
    nearest = corner == 0 ? distance : std::min(nearest, distance);
    farthest = corner == 0 ? distance : std::max(farthest, distance);
  }
  const std::string remedy = "; choose another camera, or none: then all is framed";
  if (farthest < 0.0) return "everything is behind the camera" + remedy;
  if (farthest < view.near_distance) return "everything is nearer than the camera's near plane" + remedy;
  if (nearest > view.far_distance) return "everything is beyond the camera's far plane" + remedy;
  return {};
}

bool ReachesTiles(const FrameGeometry& geometry) {
  return std::any_of(geometry.chunks.begin(), geometry.chunks.end(),
                     [](const TriangleChunk& chunk) { return !chunk.tiles.empty(); });
}

}  // namespace

std::string WhyNothingIsVisible(const Scene& scene, const PosedScene& posed, const FrameView& view,
                                const FramePlan& plan, const TileGrid& grid, const RenderSettings& settings,
                                const RenderStats& stats, FrameGeometry& geometry) {
  const bool any_fragment = stats.fragments_shaded + stats.fragments_blended > 0;
  if (any_fragment && stats.covered_pixels > 0) return {};
  const std::string nothing = "nothing is visible: ";
  if (posed.drawables.empty()) return nothing + WhyNothingIsDrawn(scene, settings);
  if (stats.triangles_in == 0) return nothing + "no mesh has vertices enough for a triangle; is the file whole?";
  if (any_fragment || (ReachesTiles(geometry) && (plan.alpha_test || plan.blending))) {
    return nothing + "what is in the view is wholly transparent; see the alpha of its materials";
  }
  FramePlan two_sided = plan;
  for (PlannedMaterial& material : two_sided.materials) material.frame.features |= kDoubleSided;
  RenderStats unused;
  try {
    MemoryBudget again(settings.memory_limit);  // it replaces the geometry of the frame
    const MemoryBudget::Scope scope(again);
    RunGeometry(view, posed, two_sided, grid, settings.samples, geometry, unused);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::OutOfMemory) throw;
    return nothing + "within the memory limit it cannot be said why";
  }
  if (unused.triangles_binned > stats.triangles_binned && ReachesTiles(geometry)) {
    return nothing +
           "what is in the view turns its back to the camera; look from the other side, or make its "
           "materials double-sided";
  }
  const std::string outside = WhereOutside(view, posed.bounds);
  if (!outside.empty()) return nothing + outside;
  if (stats.triangles_clipped >= stats.triangles_in) {
    return nothing + "everything is beside the view; choose another camera, or none: then all is framed";
  }
  return nothing + "what is in the view is smaller than the gaps between samples; look from nearer by";
}

std::string WhyNothingIsLit(const FramePlan& plan, const std::vector<bool>& material_visible, bool any_light,
                            const RenderSettings& settings) {
  const bool environment_shines = plan.environment_light && settings.environment.intensity > 0.0;
  if (any_light || environment_shines) return {};
  const auto asked_out = [&](Feature feature) { return settings.without.Has(feature); };
  if (asked_out(Feature::EnvironmentLight) || asked_out(Feature::PunctualLights)) return {};
  bool any_unlit = false;
  for (std::size_t m = 0; m < plan.materials.size(); ++m) {
    const FrameMaterial& material = plan.materials[m].frame;
    const bool reads_none = material.shader != nullptr && material.shader->Light() == LightUse::None;
    any_unlit = any_unlit || (material_visible[m] && material.Has(kLit) && !material.Has(kEmission) && !reads_none);
  }
  if (!any_unlit) return {};
  const bool has_environment = settings.environment.kind != EnvironmentSettings::Kind::None;
  return std::string("nothing lights the picture: ") +
         (has_environment ? "the environment's intensity is 0" : "there is no environment") +
         ", and no light of the scene shines; ask for an environment";
}

}  // namespace facet
