// Images and textures. Pictures stay encoded until someone needs them.
#pragma once

#include "facet/scene.h"
#include "gltf/buffers.h"

namespace facet::gltf {

// One SceneImage for each image of the file, under the same index. A picture that is missing or malformed is a warning
// here, and an Error when it is decoded. By index: false for one of which it is known that there is no picture.
std::vector<bool> ReadImages(Context& context, BufferStore& buffers, Scene& scene);

// One Texture for each texture of the file, with its sampler. `images` is what ReadImages() returns; a texture whose
// image is not there has none.
void ReadTextures(Context& context, const std::vector<bool>& images, Scene& scene);

}  // namespace facet::gltf
