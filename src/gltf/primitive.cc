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
  const AccessorView view = reader.View(accessor);
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

// What the vertices of `indices` span; moves the indices to its start when it is much smaller than the whole: files
// may share one large vertex buffer among many primitives.
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

// Drops what is left over from a list of pairs or triples.
void TrimList(Context& context, Primitive& primitive, const Place& place) {
  const std::size_t each = primitive.topology == Topology::Lines       ? 2
                           : primitive.topology == Topology::Triangles ? 3
                                                                       : 1;
  const std::size_t count = primitive.indices.empty() ? primitive.positions.size() : primitive.indices.size();
  if (count % each == 0) return;
  context.Warn(place, "ignored: the last " + std::to_string(count % each) + " of " + std::to_string(count) +
                          " vertices, which make no " + (each == 2 ? "line" : "triangle"));
  if (!primitive.indices.empty()) primitive.indices.resize(count - count % each);
}

void NormaliseNormals(Context& context, std::vector<glm::vec3>& normals, const Place& place) {
  constexpr float kTolerance = 1e-3f;  // of the squared length: what is unit in the file keeps its bits
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
  if (zero) context.Warn(place, std::to_string(zero) + " normals without a direction were replaced by +Z");
}

void NormaliseTangents(Context& context, std::vector<glm::vec4>& tangents, const Place& place) {
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
  if (zero) context.Warn(place, std::to_string(zero) + " tangents without a direction were replaced by +X");
  if (bad_sign) context.Warn(place, std::to_string(bad_sign) + " tangents have a handedness that is not 1 or -1");
}

void ClampColors(Context& context, std::vector<glm::vec4>& colors, const Place& place) {
  std::size_t outside = 0;
  for (glm::vec4& color : colors) {
    for (int c = 0; c < 4; ++c) {
      outside += !(color[c] >= 0.0f && color[c] <= 1.0f);
      color[c] = std::min(std::max(color[c], 0.0f), 1.0f);
    }
  }
  if (outside) context.Warn(place, std::to_string(outside) + " numbers outside of [0, 1] were clamped");
}

void WarnOfIntegers(Context& context, AttributeSource& source, const char* semantic, const Place& place) {
  if (source.View(semantic, 2, 4).type != ComponentType::F32 && !context.IsUsed("KHR_mesh_quantization")) {
    context.Warn(Place(place, semantic), "integers without KHR_mesh_quantization");
  }
}

void ReadAttributes(Context& context, AttributeSource& source, const std::map<std::string, int>& attributes,
                    Primitive& out, const Place& place) {
  out.positions = source.Vec3("POSITION");
  WarnOfIntegers(context, source, "POSITION", place);
  if (source.Has("NORMAL")) {
    out.normals = source.Vec3("NORMAL");
    WarnOfIntegers(context, source, "NORMAL", place);
    NormaliseNormals(context, out.normals, Place(place, "NORMAL"));
  }
  if (source.Has("TANGENT") && !source.Has("NORMAL")) {
    context.Warn(Place(place, "TANGENT"), "ignored: tangents without normals");
  } else if (source.Has("TANGENT")) {
    out.tangents = source.Vec4("TANGENT");
    NormaliseTangents(context, out.tangents, Place(place, "TANGENT"));
  }
  if (source.Has("COLOR_0")) {
    out.colors = source.Color("COLOR_0", 1.0f);
    ClampColors(context, out.colors, Place(place, "COLOR_0"));
  }
  for (const auto& [semantic, accessor] : attributes) {
    const int set = SetOf(semantic, "TEXCOORD");
    if (set < 0 || set >= kMaxSets) continue;
    const auto i = static_cast<std::size_t>(set);
    if (out.tex_coords.size() <= i) out.tex_coords.resize(i + 1);
    out.tex_coords[i] = source.Vec2(semantic);
  }
  for (int set = 0; set < kMaxSets; ++set) {
    const std::string joints = "JOINTS_" + std::to_string(set), weights = "WEIGHTS_" + std::to_string(set);
    if (source.Has(joints) != source.Has(weights)) {
      context.Warn(
          place, "ignored: " + (source.Has(joints) ? joints + " without " + weights : weights + " without " + joints));
    } else if (source.Has(joints)) {
      out.joints.push_back(source.Joints(joints));
      out.weights.push_back(source.Weights(weights));
    }
  }
  source.WarnOfOthers(false);
}

MorphTarget ReadTarget(Context& context, AttributeSource& source, const std::map<std::string, int>& attributes,
                       const Primitive& base, const Place& place) {
  MorphTarget target;
  const auto based = [&](const std::string& semantic, bool has_base) {
    if (!has_base) context.Warn(Place(place, semantic), "ignored: the primitive has no such attribute");
    return has_base;
  };
  if (source.Has("POSITION")) target.positions = source.Vec3("POSITION");
  if (source.Has("NORMAL") && based("NORMAL", !base.normals.empty())) target.normals = source.Vec3("NORMAL");
  if (source.Has("TANGENT") && based("TANGENT", !base.tangents.empty())) {
    target.tangents = source.Vec3("TANGENT", 3, 4);
  }
  if (source.Has("COLOR_0") && based("COLOR_0", !base.colors.empty())) target.colors = source.Color("COLOR_0", 0.0f);
  for (const auto& [semantic, accessor] : attributes) {
    const int set = SetOf(semantic, "TEXCOORD");
    if (set < 0 || set >= kMaxSets) continue;
    const auto i = static_cast<std::size_t>(set);
    if (!based(semantic, i < base.tex_coords.size() && !base.tex_coords[i].empty())) continue;
    if (target.tex_coords.size() <= i) target.tex_coords.resize(i + 1);
    target.tex_coords[i] = source.Vec2(semantic);
  }
  source.WarnOfOthers(true);
  return target;
}

// Null where the primitive is not packed, or where its packed data is damaged and plain data stands beside it.
std::optional<DracoMesh> TryDraco(Context& context, BufferStore& buffers, const Json& object,
                                  const tinygltf::Primitive& primitive, const Place& place) {
  constexpr const char* kDraco = "KHR_draco_mesh_compression";
  const Json* extension = ExtensionOf(object, kDraco, place);
  if (!extension) return std::nullopt;
  const Place extensions_place(place, "extensions");
  const Place draco_place(extensions_place, kDraco);
  try {
    return DecodeDraco(context, buffers, *extension, primitive, draco_place);
  } catch (const Error& error) {
    if (context.IsRequired(kDraco) || error.code() == ErrorCode::OutOfMemory) throw;
    const auto& accessors = context.document.core.accessors;
    const auto backed = [&](int accessor) { return accessors[static_cast<std::size_t>(accessor)].bufferView >= 0; };
    bool has_plain = primitive.indices < 0 || backed(primitive.indices);
    for (const auto& [semantic, accessor] : primitive.attributes) has_plain = has_plain && backed(accessor);
    if (!has_plain) throw;
    context.Warn(draco_place, error.message() + "; the uncompressed data is used");
    return std::nullopt;
  }
}

// KHR_materials_variants.
std::vector<int> ReadVariantMaterials(Context& context, const Json& object, std::size_t material_count,
                                      const Place& place) {
  constexpr const char* kVariants = "KHR_materials_variants";
  const Json* extension = ExtensionOf(object, kVariants, place);
  if (!extension) return {};
  std::size_t variant_count = 0;
  if (const Json* root = ExtensionOf(context.document.root, kVariants, context.place)) {
    const Json* variants = ArrayAt(*root, "variants", Place(context.place, kVariants));
    variant_count = variants ? variants->size() : 0;
  }
  const Place extensions_place(place, "extensions");
  const Place variants_place(extensions_place, kVariants);
  const Json* mappings = ArrayAt(*extension, "mappings", variants_place);
  if (!mappings || variant_count == 0) return {};
  std::vector<int> materials(variant_count, -1);
  const Place mappings_place(variants_place, "mappings");
  std::size_t i = 0;
  for (const Json& mapping : *mappings) {
    const Place mapping_place(mappings_place, i++);
    RequireObject(mapping, mapping_place);
    const int material = RequireIndex(mapping, "material", material_count, "materials", mapping_place);
    for (const int variant : IndicesAt(mapping, "variants", variant_count, "variants", mapping_place)) {
      materials[static_cast<std::size_t>(variant)] = material;
    }
  }
  return materials;
}

}  // namespace

std::optional<Primitive> ReadPrimitive(Context& context, BufferStore& buffers, AccessorReader& reader,
                                       std::size_t mesh_index, std::size_t primitive_index) {
  const auto& core = context.document.core;
  const auto& from = core.meshes[mesh_index].primitives[primitive_index];
  const Json& object = context.Object("meshes", mesh_index)["primitives"][primitive_index];
  const Place meshes_place(context.place, "meshes");
  const Place mesh_place(meshes_place, mesh_index);
  const Place primitives_place(mesh_place, "primitives");
  const Place place(primitives_place, primitive_index);
  const Place attributes_place(place, "attributes");

  const auto position = from.attributes.find("POSITION");
  if (position == from.attributes.end()) {
    context.Warn(place, "ignored: the primitive has no positions");
    return std::nullopt;
  }
  Primitive out;
  out.topology = TopologyOf(from.mode);
  out.material = from.material;
  out.variant_materials = ReadVariantMaterials(context, object, core.materials.size(), place);

  std::optional<DracoMesh> draco = TryDraco(context, buffers, object, from, place);
  std::size_t vertex_count = reader.Count(position->second);
  Range range;
  if (draco) {
    vertex_count = draco->point_count;
    range = {0, vertex_count};
    out.indices = std::move(draco->indices);
    out.topology = Topology::Triangles;  // Draco unrolls strips
  } else {
    constexpr std::size_t kMaxVertices = 0xFFFFFFFFu;
    if (vertex_count > kMaxVertices) Fail(place, "has more than 4294967295 vertices", {}, ErrorCode::Unsupported);
    if (from.indices >= 0) {
      out.indices = ReadIndices(context, reader, from.indices, vertex_count, Place(place, "indices"));
    }
    range = NarrowRange(out.indices, vertex_count);
  }
  if (!IsTriangles(out.topology) && ExtensionOf(object, "KHR_draco_mesh_compression", place)) {
    context.Warn(place, "Draco compresses triangles only");
  }

  AttributeSource source(context, reader, from.attributes, draco ? &*draco : nullptr, vertex_count, range,
                         attributes_place);
  ReadAttributes(context, source, from.attributes, out, attributes_place);
  TrimList(context, out, place);

  const Place targets_place(place, "targets");
  for (std::size_t t = 0; t < from.targets.size(); ++t) {
    const Place target_place(targets_place, t);
    AttributeSource target(context, reader, from.targets[t], nullptr, vertex_count, range, target_place);
    out.targets.push_back(ReadTarget(context, target, from.targets[t], out, target_place));
  }
  return out;
}

}  // namespace facet::gltf
