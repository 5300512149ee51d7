#include "facet/load.h"

#include <algorithm>
#include <new>

#include "base/float_environment.h"
#include "base/input_file.h"
#include "base/memory_budget.h"
#include "gltf/animation.h"
#include "gltf/container.h"
#include "gltf/extensions.h"
#include "gltf/material.h"
#include "gltf/nodes.h"
#include "gltf/pictures.h"
#include "gltf/primitive.h"
#include "scene/missing_sets.h"

namespace facet {
namespace gltf {
namespace {

void ReadVariants(Context& context, Scene& scene) {
  constexpr const char* kVariants = "KHR_materials_variants";
  const Json* extension = ExtensionOf(context.document.root, kVariants, context.place);
  if (!extension) return;
  const Place extensions_place(context.place, "extensions");
  const Place extension_place(extensions_place, kVariants);
  const Json* list = LenientArray(*extension, "variants", extension_place);
  if (!list) return;
  const Place list_place(extension_place, "variants");
  context.Charge(list->size(), sizeof(std::string), list_place);
  scene.variants.reserve(list->size());
  for (const Json& variant : *list) {
    const Place place(list_place, scene.variants.size());
    scene.variants.push_back(NameOf(LenientElement(variant, place), place));
  }
}

// `read` gets the file's index of each primitive that the mesh has.
void ReadPrimitives(Context& context, BufferStore& buffers, AccessorReader& reader, const Json& object,
                    const MeshUse& use, const Place& place, Mesh& mesh, std::vector<std::size_t>& read) {
  const Json& primitives = RequireArray(object, "primitives", place);
  const Place list_place(place, "primitives");
  context.Charge(primitives.size(), sizeof(Primitive) + sizeof(std::size_t), list_place);
  mesh.primitives.reserve(primitives.size());
  for (std::size_t p = 0; p < primitives.size(); ++p) {
    const Place primitive_place(list_place, p);
    if (IsAbsent(primitives[p], primitive_place)) continue;
    const auto read_one = [&] {
      CheckObject(primitives[p], primitive_place);
      auto primitive = ReadPrimitive(context, buffers, reader, primitives[p], use, primitive_place);
      if (!primitive) return;
      mesh.primitives.push_back(*std::move(primitive));
      read.push_back(p);
    };
    use.shown ? context.Try(true, primitive_place, "", read_one)
              : context.TryUnused(primitive_place, "ignored", read_one);
  }
}

void ReadMeshes(Context& context, BufferStore& buffers, AccessorReader& reader, const Shown& shown, Scene& scene) {
  const Place list_place(context.place, "meshes");
  context.Charge(shown.meshes.size(), sizeof(Mesh) + sizeof(context.primitives_read[0]), list_place);
  scene.meshes.reserve(shown.meshes.size());
  context.primitives_read.resize(shown.meshes.size());
  for (std::size_t m = 0; m < shown.meshes.size(); ++m) {
    const Json& object = context.Object("meshes", m);
    const Place place(list_place, m);
    Mesh mesh;
    mesh.name = NameOf(object, place);
    const auto read = [&] {
      ReadPrimitives(context, buffers, reader, object, shown.meshes[m], place, mesh, context.primitives_read[m]);
    };
    shown.meshes[m].shown ? context.Try(true, place, "", read) : context.TryUnused(place, "ignored", read);
    std::size_t most_targets = 0;
    for (const Primitive& primitive : mesh.primitives) most_targets = std::max(most_targets, primitive.targets.size());
    for (const Primitive& primitive : mesh.primitives) {
      if (primitive.targets.size() == most_targets) continue;
      place.Warn("its primitives do not have the same number of morph targets");
      break;
    }
    mesh.weights = LenientFloats(object, "weights", place);
    if (!mesh.weights.empty() && mesh.weights.size() != most_targets) {
      Place(place, "weights")
          .Warn("has " + std::to_string(mesh.weights.size()) + " numbers for " + std::to_string(most_targets) +
                " morph targets");
    }
    context.Charge(most_targets, sizeof(float), place);
    mesh.weights.resize(most_targets, 0.0f);
    scene.meshes.push_back(std::move(mesh));
  }
}

// Warns of a texture that shows and names a set of texture coordinates that the geometry lacks.
void WarnOfMissingSets(const Scene& scene, const Primitive& primitive, int material, const Place& place) {
  if (material < 0) return;
  ForEachMissingSet(primitive, scene.materials[std::size_t(material)], [&](const SlotInfo& info, std::size_t set) {
    Place(place, "attributes")
        .Warn("TEXCOORD_" + std::to_string(set) + " is missing, by which the " + info.name + " of materials[" +
              std::to_string(material) + "] is read; its texel at 0, 0 is used everywhere");
  });
}

void WarnOfMissingSets(const Context& context, const Shown& shown, const Scene& scene) {
  const Place list_place(context.place, "meshes");
  for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
    if (!shown.meshes[m].shown) continue;
    const Place mesh_place(list_place, m), primitives_place(mesh_place, "primitives");
    for (std::size_t p = 0; p < scene.meshes[m].primitives.size(); ++p) {
      const Primitive& primitive = scene.meshes[m].primitives[p];
      const Place place(primitives_place, context.primitives_read[m][p]);
      WarnOfMissingSets(scene, primitive, primitive.material, place);
      for (const int material : primitive.variant_materials) {
        if (material != primitive.material) WarnOfMissingSets(scene, primitive, material, place);
      }
    }
  }
}

void ReadAsset(Context& context) {
  const Json& asset = context.document.root["asset"];
  const Place place(context.place, "asset");
  context.report.generator = LenientString(asset, "generator", place).value_or("");
  context.report.copyright = LenientString(asset, "copyright", place).value_or("");
  context.report.version = context.document.version;
}

LoadedScene Load(const std::filesystem::path& path, const LoadOptions& options) {
  MemoryBudget budget(options.memory_limit);
  const MemoryBudget::Scope scope(budget);
  Context context(path, path.filename().string(), options);
  const Bytes file = ReadFile(path, {.map = options.map_files});
  context.report.file_bytes = file.size;
  context.report.files.push_back(path);
  const Container container = OpenContainer(file, context.place);
  context.document = ParseDocument(container.json, context.place);
  ReadAsset(context);
  ReadExtensions(context);
  // Most files have none, and need not be walked for them. (An escaped name would only go without its warning.)
  if (container.json.find("\"extensions\"") != container.json.npos) WarnOfUnlistedExtensions(context);
  context.Charge(container.json.size(), 1, context.place);  // names

  LoadedScene loaded;
  Scene& scene = loaded.scene;
  BufferStore buffers(context, container.bin);
  AccessorReader reader(context, buffers);
  const Shown shown = ReadNodeTree(context, scene);
  ReadTextures(context, ReadImages(context, buffers, scene), scene);
  ReadMaterials(context, scene);
  ReadVariants(context, scene);
  ReadMeshes(context, buffers, reader, shown, scene);
  WarnOfMissingSets(context, shown, scene);
  ReadSkins(context, reader, shown, scene);
  const std::vector<bool> usable_cameras = ReadCameras(context, scene);
  ReadLights(context, scene);
  ReadNodes(context, reader, shown, usable_cameras, scene);
  ReadAnimations(context, reader, scene);
  reader.CheckUnused();
  buffers.CheckUnused();
  try {
    ValidateScene(scene);
  } catch (const Error& error) {
    throw Error(error.code(), error.message(), context.file_name + ": " + error.where(), error.hint());
  }
  context.report.warnings = context.warnings.Lines();
  loaded.report = std::move(context.report);
  return loaded;
}

}  // namespace
}  // namespace gltf

LoadedScene LoadGltf(const std::filesystem::path& path, const LoadOptions& options) {
  const FloatEnvironment pinned;  // the C library reads decimal numbers by the host's rounding mode
  try {
    return gltf::Load(path, options);
  } catch (const Error& error) {
    if (!error.where().empty()) throw;
    throw Error(error.code(), error.message(), path.filename().string(), error.hint());
  } catch (const std::bad_alloc&) {
    throw Error(ErrorCode::OutOfMemory, "there is not enough memory to load the file", path.filename().string());
  }
}

}  // namespace facet
