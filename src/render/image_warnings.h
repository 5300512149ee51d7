// Explains images that show nothing, or only black, which is rarely what the user wanted.
#pragma once

#include <string>
#include <vector>

#include "facet/render.h"
#include "plan/frame_plan.h"
#include "render/geometry_pass.h"
#include "scene/pose.h"

namespace facet {

// Why no part of the scene is visible in the frame that `stats` is of, and what to do about it; empty where some is.
// `geometry` is memory to work in.
std::string WhyNothingIsVisible(const Scene& scene, const PosedScene& posed, const FrameView& view,
                                const FramePlan& plan, const TileGrid& grid, const RenderSettings& settings,
                                const RenderStats& stats, FrameGeometry& geometry);

// Why surfaces that are visible, and that need light to be seen, get none; empty where they do, or where that was asked
// for feature by feature. `any_light`: some light of the scene shines.
std::string WhyNothingIsLit(const FramePlan& plan, const std::vector<bool>& material_visible, bool any_light,
                            const RenderSettings& settings);

}  // namespace facet
