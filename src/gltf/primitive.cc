#include "gltf/primitive.h"

#include <algorithm>
#include <cmath>

#include "gltf/attributes.h"
#include "gltf/draco.h"

namespace facet::gltf {
namespace {

Topology TopologyOf(int mode) {
  switch (mode) {
    case 0: return Topology::Points;
    case 1: return Topology::Lines;
    case 2: return Topology::LineLoop;
    case 3: return Topology::LineStrip;
    case 5: return Topology::TriangleStrip;
    case 6: return Topology::TriangleFan;
    default: return Topology::Triangles;
  }
}

bool IsTriangles(Topology topology) {
  return topology == Topology::Triangles || topology == Topology::TriangleStrip || topology == Topology::TriangleFan;
}

std::vector<std::uint32_t> ReadIndices(Context& context, AccessorReader& reader, int accessor, std::size_t vertex_count,
                                       const Place& place) {
  const AccessorView& view = reader.View(accessor);
  const bool is_unsigned =
      view.type == ComponentType::U8 || view.type == ComponentType::U16 || view.type == ComponentType::U32;
  if (!is_unsigned || view.components != 1) Fail(place, "indices are not unsigned scalars");
  context.Charge(view.count, sizeof(std::uint32_t), place);
  std::vector<std::uint32_t> indices(view.count);
  reader.ReadUnsigned(view, {0, view.count}, 1, indices.data());
  std::uint32_t largest = 0;
  for (const std::uint32_t index : indices) largest = index > largest ? index : largest;
  if (largest >= vertex_count) {
    const std::uint32_t restart = view.type == ComponentType::U8    ? 0xFFu
                                  : view.type == ComponentType::U16 ? 0xFFFFu
                                                                    : 0xFFFFFFFFu;
    Fail(place, largest == restart ? "holds a primitive restart value, which glTF forbids"
                                   : "index " + std::to_string(largest) + " is not one of " +
                                         std::to_string(vertex_count) + " vertices");
  }
  return indices;
}

// The range of vertices that `indices` use. If it is much smaller than the whole, indices are made relative to its
// start, because files may share one large vertex buffer among many primitives.
Range NarrowRange(std::vector<std::uint32_t>& indices, std::size_t vertex_count) {
  if (indices.empty()) return {0, vertex_count};
  std::uint32_t low = indices[0], high = indices[0];
  for (const std::uint32_t index : indices) {
    low = index < low ? index : low;
    high = index > high ? index : high;
  }
  const std::size_t span = std::size_t(high) - low + 1;
  if (span > vertex_count / 2) return {0, vertex_count};
  for (std::uint32_t& index : indices) index -= low;
  return {low, span};
}

// Drops an incomplete pair or triple at the end. False: nothing remains.
bool TrimList(Primitive& primitive, const Place& place) {
  const std::size_t each = primitive.topology == Topology::Lines       ? 2
                           : primitive.topology == Topology::Triangles ? 3
                                                                       : 1;
  const std::size_t count = primitive.indices.empty() ? primitive.positions.size() : primitive.indices.size();
  if (count % each == 0) return true;
  place.Warn("ignored: the last " + std::to_string(count % each) + " of " + std::to_string(count) +
             " vertices, which make no " + (each == 2 ? "line" : "triangle"));
  if (!primitive.indices.empty()) primitive.indices.resize(count - count % each);
  return count >= each;
}

void NormaliseNormals(std::vector<glm::vec3>& normals, const Place& place) {
  constexpr float kTolerance = 1e-3f;  // of the squared length, so that unit vectors in the file keep their bits
  std::size_t zero = 0;
  for (glm::vec3& normal : normals) {
    const float squared = normal.x * normal.x + normal.y * normal.y + normal.z * normal.z;
    if (std::fabs(squared - 1.0f) <= kTolerance) continue;
    if (squared > 0.0f && std::isfinite(squared)) {
      normal /= std::sqrt(squared);
    } else {
      normal = glm::vec3(0.0f, 0.0f, 1.0f);
      ++zero;
    }
  }
  if (zero) place.Warn(std::to_string(zero) + " normals without a direction were replaced by +Z");
}

void NormaliseTangents(std::vector<glm::vec4>& tangents, const Place& place) {
  constexpr float kTolerance = 1e-3f;
  std::size_t zero = 0, bad_sign = 0;
  for (glm::vec4& tangent : tangents) {
    const float squared = tangent.x * tangent.x + tangent.y * tangent.y + tangent.z * tangent.z;
    if (!(std::fabs(squared - 1.0f) <= kTolerance)) {
      const bool has_direction = squared > 0.0f && std::isfinite(squared);
      const glm::vec3 direction = has_direction ? glm::vec3(tangent) / std::sqrt(squared) : glm::vec3(1.0f, 0.0f, 0.0f);
      zero += !has_direction;
      tangent = glm::vec4(direction, tangent.w);
    }
    bad_sign += std::fabs(tangent.w) != 1.0f;
    tangent.w = tangent.w < 0.0f ? -1.0f : 1.0f;
  }
  if (zero) place.Warn(std::to_string(zero) + " tangents without a direction were replaced by +X");
  if (bad_sign) place.Warn(std::to_string(bad_sign) + " tangents have a handedness that is not 1 or -1");
}

void ClampColors(std::vector<glm::vec4>& colors, const Place& place) {
  std::size_t outside = 0;
  for (glm::vec4& color : colors) {
    for (int c = 0; c < 4; ++c) {
      outside += !(color[c] >= 0.0f && color[c] <= 1.0f);
      color[c] = std::min(std::max(color[c], 0.0f), 1.0f);
    }
  }
  if (outside) place.Warn(std::to_string(outside) + " numbers outside of [0, 1] were clamped");
}

void WarnOfIntegers(Context& context, AttributeSource& source, const char* semantic, const Place& place) {
  if (source.View(semantic, 2, 4).type != ComponentType::F32 && !context.IsUsed("KHR_mesh_quantization")) {
    Place(place, semantic).Warn("integers without KHR_mesh_quantization");
  }
}

bool IsJointsOrWeights(const std::string& semantic) {
  return SetOf(semantic, "JOINTS") >= 0 || SetOf(semantic, "WEIGHTS") >= 0;
}

class PrimitiveReader {
 public:
  PrimitiveReader(Context& context, BufferStore& buffers, AccessorReader& reader, const Json& object,
                  const MeshUse& use, const Place& place)
      : context_(context), buffers_(buffers), reader_(reader), object_(object), use_(use), place_(place) {}

  std::optional<Primitive> Read();

 private:
  bool IsNeeded(const std::string& semantic) const {
    return semantic == "POSITION" || (use_.skinned && IsJointsOrWeights(semantic));
  }

  // Reads one attribute, which may be broken if it is not needed.
  template <class Function>
  bool Optionally(const std::string& semantic, bool is_needed, const Place& place, const Function& function) {
    return context_.Try(is_needed, Place(place, semantic), "ignored", function);
  }

  void ReadAttributes(AttributeSource& source, const Place& place);
  void ReadTexCoords(AttributeSource& source, const Place& place);
  void ReadJoints(AttributeSource& source, const Place& place);
  MorphTarget ReadTarget(AttributeSource& source, bool is_needed, const Place& place);
  void ReadTargets(std::size_t vertex_count, Range range);
  std::optional<DracoMesh> TryDraco();
  std::vector<int> ReadVariantMaterials();

  Context& context_;
  BufferStore& buffers_;
  AccessorReader& reader_;
  const Json& object_;
  const MeshUse& use_;
  const Place& place_;
  std::map<std::string, int> attributes_;  // accessors by semantic
  int indices_ = -1;
  Primitive out_;
};

void PrimitiveReader::ReadTexCoords(AttributeSource& source, const Place& place) {
  for (const auto& attribute : attributes_) {
    const std::string& semantic = attribute.first;  // not bound: Clang 14's lambdas do not capture bindings
    const int set = SetOf(semantic, "TEXCOORD");
    if (set < 0 || set >= kMaxSets) continue;
    const auto i = static_cast<std::size_t>(set);
    if (out_.tex_coords.size() <= i) out_.tex_coords.resize(i + 1);
    Optionally(semantic, false, place, [&] { out_.tex_coords[i] = source.Vec2(semantic); });
  }
}

void PrimitiveReader::ReadJoints(AttributeSource& source, const Place& place) {
  for (int set = 0; set < kMaxSets; ++set) {
    const std::string joints = "JOINTS_" + std::to_string(set), weights = "WEIGHTS_" + std::to_string(set);
    if (source.Has(joints) != source.Has(weights)) {
      place.Warn("ignored: " + (source.Has(joints) ? joints + " without " + weights : weights + " without " + joints));
    } else if (source.Has(joints)) {
      std::vector<glm::u16vec4> joint_list;
      std::vector<glm::vec4> weight_list;
      const bool is_read = Optionally(joints, use_.skinned, place, [&] { joint_list = source.Joints(joints); }) &&
                           Optionally(weights, use_.skinned, place, [&] { weight_list = source.Weights(weights); });
      if (!is_read) continue;
      out_.joints.push_back(std::move(joint_list));
      out_.weights.push_back(std::move(weight_list));
    }
  }
}

void PrimitiveReader::ReadAttributes(AttributeSource& source, const Place& place) {
  out_.positions = source.Vec3("POSITION");
  WarnOfIntegers(context_, source, "POSITION", place);
  if (source.Has("NORMAL")) {
    Optionally("NORMAL", false, place, [&] {
      out_.normals = source.Vec3("NORMAL");
      WarnOfIntegers(context_, source, "NORMAL", place);
      NormaliseNormals(out_.normals, Place(place, "NORMAL"));
    });
  }
  if (source.Has("TANGENT") && out_.normals.empty()) {
    Place(place, "TANGENT").Warn("ignored: tangents without normals");
  } else if (source.Has("TANGENT")) {
    Optionally("TANGENT", false, place, [&] {
      out_.tangents = source.Vec4("TANGENT");
      NormaliseTangents(out_.tangents, Place(place, "TANGENT"));
    });
  }
  if (source.Has("COLOR_0")) {
    Optionally("COLOR_0", false, place, [&] {
      out_.colors = source.Color("COLOR_0", 1.0f);
      ClampColors(out_.colors, Place(place, "COLOR_0"));
    });
  }
  ReadTexCoords(source, place);
  ReadJoints(source, place);
  source.WarnOfOthers(false);
}

MorphTarget PrimitiveReader::ReadTarget(AttributeSource& source, bool is_needed, const Place& place) {
  MorphTarget target;
  const auto read = [&](const std::string& semantic, bool has_base, const auto& function) {
    if (!source.Has(semantic)) return;
    if (!has_base) return Place(place, semantic).Warn("ignored: the primitive has no such attribute");
    Optionally(semantic, is_needed && semantic == "POSITION", place, function);
  };
  read("POSITION", true, [&] { target.positions = source.Vec3("POSITION"); });
  read("NORMAL", !out_.normals.empty(), [&] { target.normals = source.Vec3("NORMAL"); });
  read("TANGENT", !out_.tangents.empty(), [&] { target.tangents = source.Vec3("TANGENT", 3, 4); });
  read("COLOR_0", !out_.colors.empty(), [&] { target.colors = source.Color("COLOR_0", 0.0f); });
  for (std::size_t i = 0; i < std::size_t(kMaxSets); ++i) {
    const std::string semantic = "TEXCOORD_" + std::to_string(i);
    read(semantic, i < out_.tex_coords.size() && !out_.tex_coords[i].empty(), [&] {
      if (target.tex_coords.size() <= i) target.tex_coords.resize(i + 1);
      target.tex_coords[i] = source.Vec2(semantic);
    });
  }
  source.WarnOfOthers(true);
  return target;
}

void PrimitiveReader::ReadTargets(std::size_t vertex_count, Range range) {
  const Json* targets = LenientArray(object_, "targets", place_);
  if (!targets) return;
  const Place targets_place(place_, "targets");
  context_.Charge(targets->size(), sizeof(MorphTarget), targets_place);
  out_.targets.reserve(targets->size());
  for (std::size_t t = 0; t < targets->size(); ++t) {
    const Place place(targets_place, t);
    const bool is_needed = t < use_.moving_targets.size() && use_.moving_targets[t];
    const std::map<std::string, int> attributes =
        ReadAttributeList(context_, LenientElement((*targets)[t], place), place,
                          [&](const std::string& semantic) { return is_needed && semantic == "POSITION"; });
    AttributeSource source(context_, reader_, attributes, nullptr, vertex_count, range, place);
    out_.targets.push_back(ReadTarget(source, is_needed, place));
  }
}

// Nothing if the primitive is not compressed, or if its compressed data is damaged and there is an uncompressed
// fallback.
std::optional<DracoMesh> PrimitiveReader::TryDraco() {
  constexpr const char* kDraco = "KHR_draco_mesh_compression";
  const Json* extension = ExtensionOf(object_, kDraco, place_);
  if (!extension) return std::nullopt;
  const Place extensions_place(place_, "extensions");
  const Place draco_place(extensions_place, kDraco);
  const auto is_backed = [&](int accessor) { return reader_.Describe(accessor).view >= 0; };
  bool has_plain = !context_.IsRequired(kDraco) && (indices_ < 0 || is_backed(indices_));
  for (const auto& [semantic, accessor] : attributes_) has_plain = has_plain && is_backed(accessor);
  std::optional<DracoMesh> mesh;
  context_.Try(!has_plain, draco_place, "the uncompressed data is used", [&] {
    mesh = DecodeDraco(
        context_, buffers_, reader_, *extension, [&](const std::string& semantic) { return IsNeeded(semantic); },
        attributes_, draco_place);
  });
  return mesh;
}

// KHR_materials_variants.
std::vector<int> PrimitiveReader::ReadVariantMaterials() {
  constexpr const char* kVariants = "KHR_materials_variants";
  const Json* extension = ExtensionOf(object_, kVariants, place_);
  if (!extension) return {};
  std::size_t variant_count = 0;
  if (const Json* root = ExtensionOf(context_.document.root, kVariants, context_.place)) {
    const Json* variants = LenientArray(*root, "variants", Place(context_.place, kVariants));
    variant_count = variants ? variants->size() : 0;
  }
  const Place extensions_place(place_, "extensions");
  const Place variants_place(extensions_place, kVariants);
  const Json* mappings = LenientArray(*extension, "mappings", variants_place);
  if (!mappings || variant_count == 0) return {};
  context_.Charge(variant_count, sizeof(int), variants_place);
  std::vector<int> materials(variant_count, -1);
  const Place mappings_place(variants_place, "mappings");
  for (std::size_t i = 0; i < mappings->size(); ++i) {
    const Place place(mappings_place, i), list_place(place, "variants");
    const Json& mapping = LenientElement((*mappings)[i], place);
    if (!Find(mapping, "material")) place.Warn("\"material\" is missing");
    const int material = LenientIndex(mapping, "material", context_.document.Count("materials"), "materials", place);
    const Json* variants = LenientArray(mapping, "variants", place);
    for (std::size_t v = 0; variants && v < variants->size(); ++v) {
      const Place variant_place(list_place, v);
      context_.Try(false, variant_place, "ignored", [&] {
        materials[std::size_t(AsIndex((*variants)[v], variant_count, "variants", variant_place))] = material;
      });
    }
  }
  return materials;
}

std::optional<Primitive> PrimitiveReader::Read() {
  const Place attributes_place(place_, "attributes");
  const auto is_needed = [&](const std::string& semantic) { return IsNeeded(semantic); };
  attributes_ = ReadAttributeList(context_, RequireObject(object_, "attributes", place_), attributes_place, is_needed);
  const std::size_t accessor_count = context_.document.Count("accessors");
  indices_ = IndexAt(object_, "indices", accessor_count, "accessors", place_);
  const auto position = attributes_.find("POSITION");
  if (position == attributes_.end()) {
    place_.Warn("ignored: the primitive has no positions");
    return std::nullopt;
  }
  out_.topology = TopologyOf(OneOfAt(object_, "mode", {0, 1, 2, 3, 4, 5, 6}, place_).value_or(4));
  out_.material = LenientIndex(object_, "material", context_.document.Count("materials"), "materials", place_);
  out_.variant_materials = ReadVariantMaterials();

  std::optional<DracoMesh> draco = TryDraco();
  std::size_t vertex_count = reader_.Count(position->second);
  Range range;
  if (draco) {
    vertex_count = draco->point_count;
    range = {0, vertex_count};
    out_.indices = std::move(draco->indices);
    if (!IsTriangles(out_.topology)) place_.Warn("Draco compresses triangles only");
    out_.topology = Topology::Triangles;  // Draco unrolls strips
  } else {
    constexpr std::size_t kMaxVertices = 0xFFFFFFFFu;
    if (vertex_count > kMaxVertices) Fail(place_, "has more than 4294967295 vertices", {}, ErrorCode::Unsupported);
    if (indices_ >= 0) {
      out_.indices = ReadIndices(context_, reader_, indices_, vertex_count, Place(place_, "indices"));
    }
    if (vertex_count == 0 || (indices_ >= 0 && out_.indices.empty())) {
      place_.Warn(std::string("ignored: the primitive has no ") + (vertex_count == 0 ? "vertices" : "indices"));
      return std::nullopt;
    }
    range = NarrowRange(out_.indices, vertex_count);
  }

  AttributeSource source(context_, reader_, attributes_, draco ? &*draco : nullptr, vertex_count, range,
                         attributes_place);
  ReadAttributes(source, attributes_place);
  if (!TrimList(out_, place_)) return std::nullopt;
  ReadTargets(vertex_count, range);
  return std::optional(std::move(out_));
}

}  // namespace

std::optional<Primitive> ReadPrimitive(Context& context, BufferStore& buffers, AccessorReader& reader,
                                       const Json& object, const MeshUse& use, const Place& place) {
  return PrimitiveReader(context, buffers, reader, object, use, place).Read();
}

}  // namespace facet::gltf
