// Images and textures. Images stay encoded until they are needed.
#pragma once

#include <filesystem>
#include <memory>

#include "facet/scene.h"
#include "gltf/buffers.h"

namespace facet::gltf {

// Makes a SceneImage for each image of the file, with the same index. A missing or malformed image is a warning here,
// and an Error when it is decoded. The result is false for each image that is known not to exist.
std::vector<bool> ReadImages(Context& context, BufferStore& buffers, Scene& scene);

// Makes a Texture for each texture of the file, with its sampler. `images`: the result of ReadImages(); a texture whose
// image does not exist has none.
void ReadTextures(Context& context, const std::vector<bool>& images, Scene& scene);

// A picture in a file of its own, which is read when it is decoded. The file need not be there.
std::shared_ptr<const ImageSource> OpenPicture(const std::filesystem::path& path);

}  // namespace facet::gltf
