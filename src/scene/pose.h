// A scene at one moment: every mesh placed, deformed and ready to be drawn.
#pragma once

#include <deque>
#include <glm/glm.hpp>
#include <vector>

#include "facet/scene.h"

namespace facet {

struct PoseSettings {
  int scene = -1;      // -1: the default one
  int animation = -1;  // -1: rest pose
  double time = 0.0;   // seconds, clamped to the keys of each channel
  int variant = -1;    // -1: none
  bool generate_tangents = false;  // also where the geometry has some
  // False: as if the scene had none.
  bool normal_textures = true, skins = true, morph_targets = true;

  bool operator==(const PoseSettings&) const = default;
};

// A box around vertices. `empty` when there is none.
struct Bounds {
  glm::dvec3 low{0.0}, high{0.0};
  bool empty = true;
};

// One primitive of one mesh, placed by one node (or one of its instances).
struct Drawable {
  const Primitive* geometry = nullptr;  // in the Scene or in PosedScene::owned
  glm::dmat4 world_from_mesh{1.0};
  int material = -1;                    // after the variant's choice; -1: glTF's default material
  int node = -1, mesh = -1, primitive = -1;
  Bounds bounds_mesh;                   // of all its finite vertices; empty: not known
};

struct PosedLight {
  const Light* light = nullptr;
  glm::dvec3 position_world{0.0};
  glm::dvec3 direction_world{0.0, 0.0, -1.0};  // unit: where it shines
};

// Geometry of the scene that has no tangents, though the material it is drawn with reads a normal map.
struct IncompleteGeometry {
  std::vector<std::size_t> drawables;  // that draw it, all with one material
  TextureRef normal_map;
};

struct PosedCamera {
  int camera = -1;  // index into Scene::cameras
  glm::dmat4 world_from_camera{1.0};
};

// Refers to the Scene it was made from, which must outlive it. Guaranteed of each drawable's geometry: attribute arrays
// as long as positions or empty; indices in range; where its material has a normal texture and its topology is one of
// triangles: normals and tangents present (made by MikkTSpace where the file has none; a primitive without normals
// gets flat ones first). Triangles without normals and without normal texture keep `normals` empty: flat shading.
struct PosedScene {
  PoseSettings settings;            // that it was made with
  std::vector<Drawable> drawables;  // in the order of a depth-first walk of the scene's roots
  std::vector<PosedLight> lights;
  std::vector<PosedCamera> cameras;  // those of hidden nodes, too
  Bounds bounds;  // of all vertices of all drawables
  std::deque<Primitive> owned;  // deformed or completed copies
  std::vector<IncompleteGeometry> incomplete;  // none by Pose()
  bool skinned = false, morphed = false;  // some geometry is
};

// Animation, hierarchy, visibility, instances, morph targets, skins, variants, missing tangents. Runs in parallel
// where it pays. What that takes is charged to the current memory budget until it is done; who keeps the posed scene
// charges HeldBytes(). Throws Error: InvalidUsage for an index out of range, InvalidInput for scenes that break their
// rules, OutOfMemory.
PosedScene Pose(const Scene& scene, const PoseSettings& settings);

// As Pose(), but geometry that has normals and is not deformed is the scene's own, and `incomplete` says where it lacks
// the tangents that Pose() promises. All but shading can do without.
PosedScene PoseIncomplete(const Scene& scene, const PoseSettings& settings);

// What Pose() draws in place of incomplete geometry, which has normals: the same triangles in the same order, with
// tangents.
// Thread-safe.
Primitive Completed(const Primitive& geometry, const TextureRef& normal_map);

// The bounds only, without keeping deformed geometry.
Bounds PosedBounds(const Scene& scene, const PoseSettings& settings);

// How far the farthest vertex of a pose is from a point; 0 where there is none. Deformed geometry is not kept.
double PosedReach(const Scene& scene, const PoseSettings& settings, const glm::dvec3& point);

}  // namespace facet
