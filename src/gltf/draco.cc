#include "gltf/draco.h"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wpedantic"
#pragma GCC diagnostic ignored "-Wunused-parameter"
#include <draco/compression/mesh/mesh_edgebreaker_decoder.h>
#include <draco/compression/mesh/mesh_sequential_decoder.h>
#include <draco/core/varint_decoding.h>
#include <draco/metadata/metadata_decoder.h>
#pragma GCC diagnostic pop

#include <cstring>
#include <memory>
#include <new>
#include <optional>
#include <utility>
#include <vector>

#include "base/memory_budget.h"
#include "gltf/draco_transforms.h"

namespace facet::gltf {
namespace {

std::optional<ComponentType> ComponentOf(draco::DataType type) {
  switch (type) {
    case draco::DT_INT8: return ComponentType::I8;
    case draco::DT_UINT8:
    case draco::DT_BOOL: return ComponentType::U8;
    case draco::DT_INT16: return ComponentType::I16;
    case draco::DT_UINT16: return ComponentType::U16;
    case draco::DT_UINT32: return ComponentType::U32;
    case draco::DT_FLOAT32: return ComponentType::F32;
    default: return std::nullopt;
  }
}

// The sizes in the connectivity's header. Draco allocates memory by them before it reads the data.
struct Claims {
  std::uint32_t faces = 0;
  std::uint8_t attribute_decoders = 0;  // each with its own connectivity
};

// Reads the header in advance; nothing if the data is truncated. Source: Google, "Draco bitstream specification" (2.2),
// sections "Header", "Metadata" and "Connectivity", and for what older versions wrote, the decoder of Draco 1.5.
std::optional<Claims> ReadClaims(const draco::DracoHeader& header, draco::DecoderBuffer buffer) {
  const unsigned version = header.version_major * 256u + header.version_minor;
  buffer.set_bitstream_version(static_cast<std::uint16_t>(version));
  if (version >= 0x0103 && (header.flags & METADATA_FLAG_MASK) != 0) {
    draco::GeometryMetadata ignored;
    if (!draco::MetadataDecoder().DecodeGeometryMetadata(&buffer, &ignored)) return std::nullopt;
  }
  const auto read = [&](std::uint32_t& number, bool fixed_width) {
    return fixed_width ? buffer.Decode(&number) : draco::DecodeVarint(&number, &buffer);
  };
  Claims claims;
  std::uint32_t ignored = 0;
  if (header.encoder_method == draco::MESH_SEQUENTIAL_ENCODING) {
    if (!read(claims.faces, version < 0x0202)) return std::nullopt;
    return claims;
  }
  std::uint8_t traversal = 0;
  const bool is_read = buffer.Decode(&traversal) && (version >= 0x0202 || read(ignored, version < 0x0200)) &&
                       read(ignored, version < 0x0200) && read(claims.faces, version < 0x0200) &&
                       buffer.Decode(&claims.attribute_decoders);
  if (!is_read) return std::nullopt;
  return claims;
}

// Throws Error(InvalidInput) if the data is too short for the sizes that it states. The lease covers the memory for
// decoding.
MemoryLease CheckClaims(const draco::DracoHeader& header, const draco::DecoderBuffer& rest, const Place& place) {
  constexpr std::uint64_t kFacesPerByte = 4096;  // far more than its entropy coder reaches for real meshes
  const std::optional<Claims> claims = ReadClaims(header, rest);
  if (!claims) Fail(place, "Draco data is cut short");
  const auto bytes = static_cast<std::uint64_t>(rest.remaining_size());
  if (claims->faces / kFacesPerByte > bytes) {
    Fail(place, std::to_string(bytes) + " bytes of Draco data claim " + std::to_string(claims->faces) + " triangles");
  }
  // The measured maximum of the decoder, for meshes and for data with wrong sizes.
  constexpr std::uint64_t kPerFace = 128, kPerFaceAndDecoder = 48;
  return MemoryLease(claims->faces, kPerFace + kPerFaceAndDecoder * claims->attribute_decoders, "Draco data",
                     place.Full());
}

// Charges attributes when the decoder announces them, because it allocates memory for the stated number of points.
class ChargedMesh final : public draco::Mesh {
 public:
  explicit ChargedMesh(std::string where) : where_(std::move(where)) {}

  void SetAttribute(int id, std::unique_ptr<draco::PointAttribute> attribute) override {
    // Its values, the integers that they are made from, the order of the points and a value's index for each.
    const auto components = static_cast<std::uint64_t>(attribute->num_components());
    const auto size = static_cast<std::uint64_t>(draco::DataTypeLength(attribute->data_type()));
    leases_.emplace_back(num_points(), components * (size + sizeof(std::int32_t)) + 16, "Draco data", where_);
    draco::Mesh::SetAttribute(id, std::move(attribute));
  }

 private:
  std::string where_;
  std::vector<MemoryLease> leases_;
};

// Does what draco::Decoder does, but keeps the decoder, which has the integers from which the floats were made.
draco::Status DecodeMesh(const Bytes& packed, const Place& place, draco::Mesh& mesh) {
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(packed.data), packed.size);
  draco::DecoderBuffer start = buffer;
  draco::DracoHeader header;
  if (const draco::Status status = draco::PointCloudDecoder::DecodeHeader(&start, &header); !status.ok()) return status;
  const MemoryLease lease = CheckClaims(header, start, place);
  std::unique_ptr<draco::MeshDecoder> decoder;
  if (header.encoder_method == draco::MESH_EDGEBREAKER_ENCODING) {
    decoder = std::make_unique<draco::MeshEdgebreakerDecoder>();
  } else if (header.encoder_method == draco::MESH_SEQUENTIAL_ENCODING) {
    decoder = std::make_unique<draco::MeshSequentialDecoder>();
  } else {
    return draco::Status(draco::Status::DRACO_ERROR, "Unsupported encoding method.");
  }
  const draco::DecoderOptions options;
  const draco::Status status = decoder->Decode(options, &buffer, &mesh);
  if (status.ok()) DequantizeDraco(*decoder, mesh);
  return status;
}

AccessorView CopyAttribute(Context& context, const draco::Mesh& mesh, const draco::PointAttribute& attribute,
                           const Place& place) {
  const auto type = ComponentOf(attribute.data_type());
  const int components = attribute.num_components();
  if (!type || components < 1 || components > 4) Fail(place, "has a type that glTF does not have");
  const std::size_t size = SizeOfComponent(*type) * static_cast<std::size_t>(components);
  const std::size_t count = mesh.num_points();
  context.Charge(count, size, place);
  MutableBytes bytes = AllocateBytes(count * size);
  const std::size_t held = attribute.size();
  const auto stride = static_cast<std::size_t>(attribute.byte_stride());
  const auto offset = static_cast<std::size_t>(attribute.byte_offset());
  const std::size_t buffer_size = attribute.buffer() ? attribute.buffer()->data_size() : 0;
  if (held == 0 || buffer_size < offset + size || (held - 1) > (buffer_size - offset - size) / (stride ? stride : 1)) {
    Fail(place, "Draco attribute is cut short");
  }
  const auto* from = reinterpret_cast<const std::byte*>(attribute.buffer()->data()) + offset;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t value = attribute.mapped_index(draco::PointIndex(static_cast<std::uint32_t>(i))).value();
    if (value >= held) Fail(place, "Draco attribute has fewer values than points");
    std::memcpy(bytes.data() + i * size, from + value * stride, size);
  }
  AccessorView view;
  view.bytes = bytes.Freeze();
  view.stride = size;
  view.count = count;
  view.type = *type;
  view.components = components;
  return view;
}

}  // namespace

DracoMesh DecodeDraco(Context& context, BufferStore& buffers, AccessorReader& reader, const Json& extension,
                      const std::function<bool(const std::string&)>& is_needed, std::map<std::string, int>& attributes,
                      const Place& place) {
  const Json& packed_attributes = RequireObject(extension, "attributes", place);
  const Bytes& packed =
      buffers.Read(RequireIndex(extension, "bufferView", context.document.Count("bufferViews"), "bufferViews", place));
  const auto mesh = std::make_unique<ChargedMesh>(place.Full());
  try {
    const draco::Status status = DecodeMesh(packed, place, *mesh);
    if (!status.ok()) Fail(place, "Draco data is damaged: " + status.error_msg_string(), "pack the file again");
  } catch (const std::bad_alloc&) {
    Fail(place, "Draco data claims more than there is memory", "pack the file again", ErrorCode::OutOfMemory);
  } catch (const std::length_error&) {
    Fail(place, "Draco data is damaged", "pack the file again");
  }

  DracoMesh out;
  out.point_count = mesh->num_points();
  if (out.point_count == 0) Fail(place, "Draco data holds no point");
  context.Charge(mesh->num_faces(), 3 * sizeof(std::uint32_t), place);
  out.indices.resize(std::size_t(mesh->num_faces()) * 3);
  for (std::uint32_t f = 0; f < mesh->num_faces(); ++f) {
    const auto& face = mesh->face(draco::FaceIndex(f));
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint32_t index = face[c].value();
      if (index >= out.point_count) Fail(place, "Draco data has a corner that is not one of its points");
      out.indices[std::size_t(f) * 3 + c] = index;
    }
  }

  const Place attributes_place(place, "attributes");
  for (const auto& item : packed_attributes.items()) {
    const std::string& semantic = item.key();
    const Place attribute_place(attributes_place, semantic);
    const auto accessor = attributes.find(semantic);
    if (accessor == attributes.end()) {
      attribute_place.Warn("ignored: is not an attribute of the primitive");
      continue;
    }
    const bool is_read = context.Try(is_needed(semantic), attribute_place, "ignored", [&] {
      const int id = AsIndex(item.value(), std::size_t(1) << 31, "Draco attributes", attribute_place);
      const draco::PointAttribute* attribute = mesh->GetAttributeByUniqueId(static_cast<std::uint32_t>(id));
      if (!attribute) Fail(attribute_place, "no Draco attribute has the unique id " + std::to_string(id));
      AccessorView view = CopyAttribute(context, *mesh, *attribute, attribute_place);
      view.normalized = reader.Describe(accessor->second).normalized && view.type != ComponentType::F32;
      out.attributes.emplace(semantic, std::move(view));
    });
    if (!is_read) attributes.erase(accessor);
  }
  return out;
}

}  // namespace facet::gltf
