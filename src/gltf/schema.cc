#include "gltf/schema.h"

#include <cctype>
#include <functional>

namespace facet::gltf {
namespace {

std::size_t CountOf(const Json& root, const char* key) {
  const Json* array = Find(root, key);
  return array && array->is_array() ? array->size() : 0;
}

class Checker {
 public:
  Checker(const Json& root, const Place& place) : root_(root), place_(place) {}

  void Run() {
    RequireObject(root_, place_);
    Asset();
    Extensions(root_, place_);
    Strings("extensionsUsed");
    Strings("extensionsRequired");
    Each(root_, "buffers", place_, [&](const Json& o, const Place& p) {
      RequireSize(o, "byteLength", p);
      StringAt(o, "uri", p);
    });
    Each(root_, "bufferViews", place_, [&](const Json& o, const Place& p) { BufferView(o, p); });
    Each(root_, "accessors", place_, [&](const Json& o, const Place& p) { Accessor(o, p); });
    Each(root_, "images", place_, [&](const Json& o, const Place& p) {
      Ref(o, "bufferView", "bufferViews", p);
      StringAt(o, "uri", p);
      StringAt(o, "mimeType", p);
    });
    Each(root_, "samplers", place_, [&](const Json& o, const Place& p) {
      OneOfAt(o, "magFilter", {9728, 9729}, p);
      OneOfAt(o, "minFilter", {9728, 9729, 9984, 9985, 9986, 9987}, p);
      OneOfAt(o, "wrapS", {33071, 33648, 10497}, p);
      OneOfAt(o, "wrapT", {33071, 33648, 10497}, p);
    });
    Each(root_, "textures", place_, [&](const Json& o, const Place& p) {
      Ref(o, "sampler", "samplers", p);
      Ref(o, "source", "images", p);
    });
    Each(root_, "materials", place_, [&](const Json& o, const Place& p) { Material(o, p); });
    Each(root_, "meshes", place_, [&](const Json& o, const Place& p) { Mesh(o, p); });
    Each(root_, "skins", place_, [&](const Json& o, const Place& p) {
      Ref(o, "inverseBindMatrices", "accessors", p);
      Ref(o, "skeleton", "nodes", p);
      RequireMember(o, "joints", p);
      Refs(o, "joints", "nodes", p);
    });
    Each(root_, "cameras", place_, [&](const Json& o, const Place& p) { Camera(o, p); });
    Each(root_, "nodes", place_, [&](const Json& o, const Place& p) { Node(o, p); });
    Each(root_, "animations", place_, [&](const Json& o, const Place& p) { Animation(o, p); });
    Each(root_, "scenes", place_, [&](const Json& o, const Place& p) { Refs(o, "nodes", "nodes", p); });
    Ref(root_, "scene", "scenes", place_);
  }

 private:
  using Visit = std::function<void(const Json&, const Place&)>;

  // Every object of an array: its name and its extensions are checked here.
  static void Each(const Json& object, const char* key, const Place& place, const Visit& visit) {
    const Json* array = ArrayAt(object, key, place);
    if (!array) return;
    const Place array_place(place, key);
    std::size_t i = 0;
    for (const Json& element : *array) {
      const Place element_place(array_place, i++);
      RequireObject(element, element_place);
      NameOf(element, element_place);
      Extensions(element, element_place);
      visit(element, element_place);
    }
  }

  static void Extensions(const Json& object, const Place& place) {
    const Json* extensions = ObjectAt(object, "extensions", place);
    if (!extensions) return;
    const Place extensions_place(place, "extensions");
    for (const auto& item : extensions->items()) RequireObject(item.value(), Place(extensions_place, item.key()));
  }

  void Strings(const char* key) {
    const Json* array = ArrayAt(root_, key, place_);
    if (!array) return;
    std::size_t i = 0;
    for (const Json& value : *array) {
      if (!value.is_string()) Fail(Place(Place(place_, key), i), "is not a string");
      ++i;
    }
  }

  int Ref(const Json& o, const char* key, const char* list, const Place& p) {
    return IndexAt(o, key, CountOf(root_, list), list, p);
  }
  void RequireRef(const Json& o, const char* key, const char* list, const Place& p) {
    RequireIndex(o, key, CountOf(root_, list), list, p);
  }
  void Refs(const Json& o, const char* key, const char* list, const Place& p) {
    IndicesAt(o, key, CountOf(root_, list), list, p);
  }

  void Asset() {
    const Json* asset = ObjectAt(root_, "asset", place_);
    if (!asset) Fail(place_, "\"asset\" is missing: not a glTF 2.0 file", "convert it to glTF 2.0");
    const Place p(place_, "asset");
    const auto major = [&](const std::string& version, const char* key) {
      std::size_t i = 0, digits = 0;
      while (i < version.size() && std::isdigit(static_cast<unsigned char>(version[i]))) ++i;
      const std::size_t dot = i;
      if (i > 0 && i < version.size() && version[i] == '.') {
        while (++i < version.size() && std::isdigit(static_cast<unsigned char>(version[i]))) ++digits;
      }
      if (dot == 0 || digits == 0 || i != version.size()) Fail(Place(p, key), "is not a version such as \"2.0\"");
      return version.substr(0, dot);
    };
    const std::string version = RequireString(*asset, "version", p);
    if (major(version, "version") != "2") {
      Fail(Place(p, "version"), "glTF " + version + " is not supported", "convert it to glTF 2.0",
           ErrorCode::Unsupported);
    }
    if (const auto minimum = StringAt(*asset, "minVersion", p)) {
      major(*minimum, "minVersion");
      if (*minimum != "2.0") {
        Fail(Place(p, "minVersion"), "glTF " + *minimum + " is required", "convert it to glTF 2.0",
             ErrorCode::Unsupported);
      }
    }
    StringAt(*asset, "generator", p);
    StringAt(*asset, "copyright", p);
  }

  void BufferView(const Json& o, const Place& p) {
    RequireRef(o, "buffer", "buffers", p);
    SizeAt(o, "byteOffset", p);
    RequireSize(o, "byteLength", p);
    const auto stride = SizeAt(o, "byteStride", p);
    if (stride && (*stride > 252 || *stride % 4 != 0)) {  // 0, which some exporters write, is "tightly packed"
      Fail(Place(p, "byteStride"), std::to_string(*stride) + " is not a multiple of 4 up to 252");
    }
  }

  void Accessor(const Json& o, const Place& p) {
    Ref(o, "bufferView", "bufferViews", p);
    SizeAt(o, "byteOffset", p);
    BoolAt(o, "normalized", p);
    RequireMember(o, "componentType", p);
    OneOfAt(o, "componentType", {5120, 5121, 5122, 5123, 5125, 5126}, p);
    if (RequireSize(o, "count", p) == 0) Fail(Place(p, "count"), "is zero");
    const std::string type = RequireString(o, "type", p);
    bool known = false;
    for (const char* name : {"SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"}) known = known || type == name;
    if (!known) Fail(Place(p, "type"), "is not a type that glTF knows");
    ArrayAt(o, "min", p);
    ArrayAt(o, "max", p);
    const Json* sparse = ObjectAt(o, "sparse", p);
    if (!sparse) return;
    const Place sp(p, "sparse");
    if (RequireSize(*sparse, "count", sp) > RequireSize(o, "count", p)) {
      Fail(Place(sp, "count"), "is larger than the accessor's");
    }
    for (const char* key : {"indices", "values"}) {
      const Json* part = ObjectAt(*sparse, key, sp);
      RequireMember(*sparse, key, sp);
      const Place pp(sp, key);
      RequireRef(*part, "bufferView", "bufferViews", pp);
      SizeAt(*part, "byteOffset", pp);
    }
    RequireMember(*Find(*sparse, "indices"), "componentType", Place(sp, "indices"));
    OneOfAt(*Find(*sparse, "indices"), "componentType", {5121, 5123, 5125}, Place(sp, "indices"));
  }

  void TextureInfo(const Json& o, const char* key, const Place& p) {
    const Json* info = ObjectAt(o, key, p);
    if (!info) return;
    const Place ip(p, key);
    RequireRef(*info, "index", "textures", ip);
    if (SizeAt(*info, "texCoord", ip).value_or(0) > 0xFFFF) Fail(Place(ip, "texCoord"), "is absurdly large");
    NumberAt(*info, "scale", ip);
    NumberAt(*info, "strength", ip);
    Extensions(*info, ip);
  }

  void Material(const Json& o, const Place& p) {
    if (const Json* pbr = ObjectAt(o, "pbrMetallicRoughness", p)) {
      const Place pp(p, "pbrMetallicRoughness");
      NumbersAt(*pbr, "baseColorFactor", 4, pp);
      NumberAt(*pbr, "metallicFactor", pp);
      NumberAt(*pbr, "roughnessFactor", pp);
      TextureInfo(*pbr, "baseColorTexture", pp);
      TextureInfo(*pbr, "metallicRoughnessTexture", pp);
    }
    TextureInfo(o, "normalTexture", p);
    TextureInfo(o, "occlusionTexture", p);
    TextureInfo(o, "emissiveTexture", p);
    NumbersAt(o, "emissiveFactor", 3, p);
    StringAt(o, "alphaMode", p);
    NumberAt(o, "alphaCutoff", p);
    BoolAt(o, "doubleSided", p);
  }

  void Attributes(const Json& attributes, const Place& p) {
    for (const auto& item : attributes.items()) {
      AsIndex(item.value(), CountOf(root_, "accessors"), "accessors", Place(p, item.key()));
    }
  }

  void Mesh(const Json& o, const Place& p) {
    RequireMember(o, "primitives", p);
    NumbersAt(o, "weights", 0, p);
    Each(o, "primitives", p, [&](const Json& primitive, const Place& pp) {
      Ref(primitive, "indices", "accessors", pp);
      Ref(primitive, "material", "materials", pp);
      OneOfAt(primitive, "mode", {0, 1, 2, 3, 4, 5, 6}, pp);
      RequireMember(primitive, "attributes", pp);
      Attributes(*ObjectAt(primitive, "attributes", pp), Place(pp, "attributes"));
      Each(primitive, "targets", pp, [&](const Json& target, const Place& tp) {
        for (const auto& item : target.items()) {
          if (item.key() == "extensions") Fail(Place(tp, "extensions"), "is not an attribute");
        }
        Attributes(target, tp);
      });
    });
  }

  void Camera(const Json& o, const Place& p) {
    const std::string type = RequireString(o, "type", p);
    if (type != "perspective" && type != "orthographic") Fail(Place(p, "type"), "is not a type that glTF knows");
    const Json* lens = ObjectAt(o, type.c_str(), p);
    RequireMember(o, type.c_str(), p);
    const Place lp(p, type);
    for (const char* key : {"aspectRatio", "yfov", "xmag", "ymag", "znear", "zfar"}) NumberAt(*lens, key, lp);
    if (type == "perspective") {
      RequireMember(*lens, "yfov", lp);
    } else {
      for (const char* key : {"xmag", "ymag", "zfar"}) RequireMember(*lens, key, lp);
    }
    RequireMember(*lens, "znear", lp);
  }

  void Node(const Json& o, const Place& p) {
    Ref(o, "mesh", "meshes", p);
    Ref(o, "skin", "skins", p);
    Ref(o, "camera", "cameras", p);
    Refs(o, "children", "nodes", p);
    NumbersAt(o, "matrix", 16, p);
    NumbersAt(o, "translation", 3, p);
    NumbersAt(o, "rotation", 4, p);
    NumbersAt(o, "scale", 3, p);
    NumbersAt(o, "weights", 0, p);
  }

  void Animation(const Json& o, const Place& p) {
    RequireMember(o, "channels", p);
    RequireMember(o, "samplers", p);
    Each(o, "samplers", p, [&](const Json& sampler, const Place& sp) {
      RequireRef(sampler, "input", "accessors", sp);
      RequireRef(sampler, "output", "accessors", sp);
      StringAt(sampler, "interpolation", sp);
    });
    Each(o, "channels", p, [&](const Json& channel, const Place& cp) {
      RequireIndex(channel, "sampler", CountOf(o, "samplers"), "samplers", cp);
      RequireMember(channel, "target", cp);
      const Json& target = *ObjectAt(channel, "target", cp);
      const Place tp(cp, "target");
      Ref(target, "node", "nodes", tp);
      RequireString(target, "path", tp);
      Extensions(target, tp);
    });
  }

  const Json& root_;
  const Place& place_;
};

}  // namespace

void CheckSchema(const Json& root, const Place& place) { Checker(root, place).Run(); }

}  // namespace facet::gltf
