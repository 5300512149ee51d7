#include <string>
#include <utility>

#include "gltf/nodes.h"

namespace facet::gltf {
namespace {

void ReadSkin(Context& context, AccessorReader& reader, const Json& object, Skin& skin, const Place& place) {
  const Json& joints = RequireArray(object, "joints", place);
  const Place joints_place(place, "joints");
  context.Charge(joints.size(), sizeof(int), joints_place);
  for (std::size_t k = 0; k < joints.size(); ++k) {
    skin.joints.push_back(AsIndex(joints[k], context.document.Count("nodes"), "nodes", Place(joints_place, k)));
  }
  const int accessor = IndexAt(object, "inverseBindMatrices", context.document.Count("accessors"), "accessors", place);
  if (accessor < 0) return;
  const Place matrices_place(place, "inverseBindMatrices");
  const AccessorView& view = reader.View(accessor);
  if (view.type != ComponentType::F32 || view.components != 16) Fail(matrices_place, "are not float matrices");
  if (view.count == 0) {
    matrices_place.Warn("has no matrices; none are used");
    return;
  }
  if (view.count < skin.joints.size()) {
    Fail(matrices_place,
         "has " + std::to_string(view.count) + " matrices for " + std::to_string(skin.joints.size()) + " joints");
  }
  // More than one for each joint is allowed, and useless.
  context.Charge(skin.joints.size(), sizeof(glm::mat4), matrices_place);
  skin.inverse_bind.resize(skin.joints.size());
  if (skin.joints.empty()) return;
  reader.ReadFloats(view, {0, skin.joints.size()}, 16, &skin.inverse_bind[0][0][0], matrices_place);
}

}  // namespace

void ReadSkins(Context& context, AccessorReader& reader, const Shown& shown, Scene& scene) {
  const Place list_place(context.place, "skins");
  context.Charge(context.document.Count("skins"), sizeof(Skin), list_place);
  scene.skins.reserve(context.document.Count("skins"));
  for (std::size_t i = 0; i < context.document.Count("skins"); ++i) {
    const Json& object = context.Object("skins", i);
    const Place place(list_place, i);
    Skin skin;
    const auto read = [&] { ReadSkin(context, reader, object, skin, place); };
    if (!(shown.skins[i] ? context.Try(true, place, "", read) : context.TryUnused(place, "ignored", read))) skin = {};
    skin.name = NameOf(object, place);
    LenientIndex(object, "skeleton", scene.nodes.size(), "nodes", place);  // says something about bounds only
    scene.skins.push_back(std::move(skin));
  }
}

}  // namespace facet::gltf
