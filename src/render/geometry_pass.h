// From posed drawables to tile lists: the vertex, clip and bin stages over all of them.
#pragma once

#include <vector>

#include "base/memory_budget.h"
#include "facet/render.h"
#include "frame/geometry.h"
#include "frame/tile_grid.h"
#include "plan/frame_plan.h"
#include "scene/pose.h"

namespace facet {

// Kept from one frame to the next, its arrays need not be made anew.
struct FrameGeometry {
  std::vector<FrameDrawable> drawables;
  std::vector<TriangleChunk> chunks;
  TileLists lists;
  std::vector<bool> drawable_visible;  // some triangle of it reached a tile
  std::vector<bool> material_visible;  // of FramePlan::materials: some drawable with it is visible
  VertexBuffer vertices;
};

// Fills `frame` except for its lists, replacing its content. `posed` must outlive it, and may lack tangents. What the
// frame takes is charged to the current memory budget. Throws Error(OutOfMemory).
void RunGeometry(const FrameView& view, const PosedScene& posed, const FramePlan& plan, const TileGrid& grid,
                 int samples, FrameGeometry& frame, RenderStats& stats);

// Fills the lists for tiles [first, end) of the grid: those of tile `first` are the first. There are no more lists than
// that, so that a band of a large image needs few. The lease is what they take.
MemoryLease ListTiles(const FramePlan& plan, int first, int end, FrameGeometry& frame);

}  // namespace facet
