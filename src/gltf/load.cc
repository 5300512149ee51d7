#include "facet/load.h"

#include <new>

#include "base/float_environment.h"
#include "gltf/animation.h"
#include "gltf/container.h"
#include "gltf/extensions.h"
#include "gltf/material.h"
#include "gltf/nodes.h"
#include "gltf/pictures.h"
#include "gltf/primitive.h"
#include "math/round_to_float.h"

namespace facet {
namespace gltf {
namespace {

void ReadVariants(Context& context, Scene& scene) {
  constexpr const char* kVariants = "KHR_materials_variants";
  const Json* extension = ExtensionOf(context.document.root, kVariants, context.place);
  if (!extension) return;
  const Place extensions_place(context.place, "extensions");
  const Place extension_place(extensions_place, kVariants);
  const Json* list = ArrayAt(*extension, "variants", extension_place);
  if (!list) return;
  const Place list_place(extension_place, "variants");
  for (const Json& variant : *list) {
    const Place place(list_place, scene.variants.size());
    RequireObject(variant, place);
    scene.variants.push_back(NameOf(variant, place));
  }
}

void ReadMeshes(Context& context, BufferStore& buffers, AccessorReader& reader, Scene& scene) {
  const Place list_place(context.place, "meshes");
  for (std::size_t m = 0; m < context.document.core.meshes.size(); ++m) {
    const auto& from = context.document.core.meshes[m];
    const Place place(list_place, m);
    Mesh mesh;
    mesh.name = from.name;
    std::size_t most_targets = 0;
    for (std::size_t p = 0; p < from.primitives.size(); ++p) {
      auto primitive = ReadPrimitive(context, buffers, reader, m, p);
      if (!primitive) continue;
      most_targets = std::max(most_targets, primitive->targets.size());
      mesh.primitives.push_back(*std::move(primitive));
    }
    for (Primitive& primitive : mesh.primitives) {
      if (primitive.targets.size() == most_targets) continue;
      context.Warn(place, "its primitives do not have the same number of morph targets");
      primitive.targets.resize(most_targets);
    }
    for (const double weight : from.weights) mesh.weights.push_back(RoundToFiniteFloat(weight));
    if (!mesh.weights.empty() && mesh.weights.size() != most_targets) {
      context.Warn(Place(place, "weights"), "has " + std::to_string(mesh.weights.size()) + " numbers for " +
                                                std::to_string(most_targets) + " morph targets");
    }
    mesh.weights.resize(most_targets, 0.0f);
    scene.meshes.push_back(std::move(mesh));
  }
}

LoadedScene Load(const std::filesystem::path& path, const LoadOptions& options) {
  Context context(path, path.filename().string(), options);
  const Bytes file = ReadWholeFile(path);
  context.report.file_bytes = file.size;
  const Container container = OpenContainer(file, context.file_name, context.report.warnings);
  context.document = ParseDocument(container.json, context.place);
  const auto& asset = context.document.core.asset;
  context.report.generator = asset.generator;
  context.report.copyright = asset.copyright;
  context.report.version = asset.version;
  if (asset.version != "2.0") {
    context.WarnLine("asset.version: glTF " + asset.version + " is read as 2.0");
  }
  ReadExtensions(context);

  LoadedScene loaded;
  Scene& scene = loaded.scene;
  BufferStore buffers(context, container.bin);
  AccessorReader reader(context, buffers);
  ReadImages(context, buffers, scene);
  ReadTextures(context, scene);
  ReadMaterials(context, scene);
  ReadVariants(context, scene);
  ReadMeshes(context, buffers, reader, scene);
  ReadSkins(context, reader, scene);
  ReadCameras(context, scene);
  ReadLights(context, scene);
  ReadNodes(context, reader, scene);
  ReadAnimations(context, reader, scene);
  try {
    ValidateScene(scene);
  } catch (const Error& error) {
    throw Error(error.code(), error.message(), context.file_name + ": " + error.where(), error.hint());
  }
  loaded.report = std::move(context.report);
  return loaded;
}

}  // namespace
}  // namespace gltf

LoadedScene LoadGltf(const std::filesystem::path& path, const LoadOptions& options) {
  const FloatEnvironment pinned;  // the C library reads decimal numbers by the host's rounding mode
  try {
    return gltf::Load(path, options);
  } catch (const std::bad_alloc&) {
    throw Error(ErrorCode::OutOfMemory, "there is not enough memory to load the file", path.filename().string());
  }
}

}  // namespace facet
