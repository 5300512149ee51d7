// Decoding the images that visible materials read.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "base/memory_budget.h"
#include "facet/render.h"
#include "plan/frame_plan.h"
#include "texture/texture.h"

namespace facet {

// What was decoded for one plan; kept from one frame to the next, nothing is decoded twice.
struct FrameTextures {
  struct Entry {
    std::unique_ptr<const TextureData> data;  // null: no visible material needed it yet, or it could not be decoded
    std::string problem;                      // why it could not be decoded
    std::string damage;                       // what was broken in the file, where it could be decoded all the same
  };
  std::vector<PlannedTexture> planned;  // equal to FramePlan::textures
  TexelBits texels = TexelBits::Mixed;
  std::vector<Entry> entries;  // as many
};

// Other work for the same threads.
struct WorkBeside {
  std::function<void()> run;
  std::size_t size = 0;  // its duration, as the size of an image file that takes as long to decode, in bytes
};

// Decodes what visible materials read and `textures` lacks, and runs `beside`. An image that cannot be decoded gives a
// warning. Throws Error(MissingModule) where an image needs a module that is not installed, Error(OutOfMemory) for
// images beyond the limits, before any is decoded where their headers say so.
void DecodeTextures(const Scene& scene, const std::vector<bool>& material_visible, TexelBits texels,
                    const FramePlan& plan, FrameTextures& textures, MemoryBudget& budget, const WorkBeside& beside,
                    RenderStats& stats);

// The plan's materials with their textures, which must outlive them. A material does without those that could not be
// decoded.
std::vector<FrameMaterial> BindTextures(const FramePlan& plan, const FrameTextures& textures);

}  // namespace facet
