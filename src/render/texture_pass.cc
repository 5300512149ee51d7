#include "render/texture_pass.h"

#include <algorithm>
#include <exception>

#include "base/parallel.h"
#include "facet/error.h"

namespace facet {

FrameTextures DecodeTextures(const Scene& scene, const std::vector<bool>& material_visible, TexelBits texels,
                             FramePlan& plan, RenderStats& stats) {
  FrameTextures textures(plan.textures.size());
  std::vector<bool> needed(plan.textures.size(), false);
  for (std::size_t m = 0; m < plan.materials.size(); ++m) {
    if (!material_visible[m]) continue;
    for (const int t : plan.materials[m].textures) {
      if (t >= 0) needed[std::size_t(t)] = true;
    }
  }
  // An image that is read in two roles is decoded once.
  std::vector<int> images;
  for (std::size_t t = 0; t < needed.size(); ++t) {
    const int image = plan.textures[t].image;
    if (needed[t] && std::find(images.begin(), images.end(), image) == images.end()) images.push_back(image);
  }
  std::vector<std::string> problems(images.size());
  std::vector<std::exception_ptr> failures(images.size());  // the first in the file's order is passed on
  ParallelFor(images.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      try {
        const Image image = scene.images[std::size_t(images[i])].source->Decode();
        for (std::size_t t = 0; t < needed.size(); ++t) {
          const PlannedTexture& planned = plan.textures[t];
          if (!needed[t] || planned.image != images[i]) continue;
          textures[t] = std::make_unique<const TextureData>(BuildTexture(image, planned.role, planned.mips, texels));
        }
      } catch (const Error& error) {
        if (error.code() != ErrorCode::InvalidInput && error.code() != ErrorCode::NotFound) {
          failures[i] = std::current_exception();
          continue;
        }
        const std::string name = scene.images[std::size_t(images[i])].source->Name();
        problems[i] = error.where().empty() ? name + ": " + error.what() : error.what();
      }
    }
  });
  for (const std::exception_ptr& failure : failures) {
    if (failure != nullptr) std::rethrow_exception(failure);
  }
  for (const std::string& problem : problems) {
    if (!problem.empty()) stats.warnings.push_back(problem + " (drawn without this texture)");
  }
  stats.images_decoded = static_cast<std::uint64_t>(std::count(problems.begin(), problems.end(), std::string()));
  for (const auto& texture : textures) {
    if (texture != nullptr) stats.texture_bytes += texture->Bytes();
  }

  constexpr MaterialFeature kFeatures[5] = {kBaseColorTexture, kMetallicRoughnessTexture, kNormalTexture,
                                            kOcclusionTexture, kEmissiveTexture};
  for (PlannedMaterial& material : plan.materials) {
    FrameMaterial& f = material.frame;
    TextureSlot* const slots[5] = {&f.base_color_texture, &f.metallic_roughness_texture, &f.normal_texture,
                                   &f.occlusion_texture, &f.emissive_texture};
    for (int i = 0; i < 5; ++i) {
      if (material.textures[i] < 0) continue;
      slots[i]->data = textures[std::size_t(material.textures[i])].get();
      if (slots[i]->data == nullptr) f.features &= ~std::uint32_t{kFeatures[i]};
    }
  }
  return textures;
}

}  // namespace facet
