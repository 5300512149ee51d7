// Decoding the images that visible materials read.
#pragma once

#include <memory>
#include <vector>

#include "facet/render.h"
#include "plan/frame_plan.h"
#include "texture/texture.h"

namespace facet {

// One entry per FramePlan::textures; null where no visible material needs it or its image could not be decoded (a
// warning says so, and the materials do without it).
using FrameTextures = std::vector<std::unique_ptr<const TextureData>>;

// Also fills the texture slots of the plan's materials. Throws Error(MissingModule) where an image needs a module that
// is not installed, Error(OutOfMemory) for images beyond the limits.
FrameTextures DecodeTextures(const Scene& scene, const std::vector<bool>& material_visible, TexelBits texels,
                             FramePlan& plan, RenderStats& stats);

}  // namespace facet
