#include "gltf/draco.h"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wpedantic"
#pragma GCC diagnostic ignored "-Wunused-parameter"
#include <draco/compression/mesh/mesh_edgebreaker_decoder.h>
#include <draco/compression/mesh/mesh_sequential_decoder.h>
#pragma GCC diagnostic pop

#include <cstring>
#include <memory>
#include <new>
#include <optional>

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

// Draco's LEB128.
std::optional<std::uint64_t> ReadVarint(const Bytes& bytes, std::size_t& at) {
  std::uint64_t value = 0;
  for (int shift = 0; shift < 63 && at < bytes.size; shift += 7) {
    const auto byte = std::to_integer<std::uint64_t>(bytes.data[at++]);
    value |= (byte & 0x7F) << shift;
    if (!(byte & 0x80)) return value;
  }
  return std::nullopt;
}

// Draco takes memory for as many faces as the header claims before it looks at the data, so the claim is read first.
// Source: Google, "Draco bitstream specification" (2.2), sections "Header" and "Connectivity".
void CheckClaims(const Bytes& packed, const Place& place) {
  constexpr std::size_t kHeader = 11;
  constexpr unsigned kMetadata = 0x8000;
  constexpr std::uint64_t kFacesPerByte = 4096;  // far beyond what its entropy coder reaches on real meshes
  if (packed.size < kHeader || std::memcmp(packed.data, "DRACO", 5) != 0) Fail(place, "is not Draco data");
  const auto byte = [&](std::size_t i) { return std::to_integer<unsigned>(packed.data[i]); };
  const unsigned version = byte(5) * 256 + byte(6), method = byte(8), flags = byte(9) + byte(10) * 256;
  constexpr unsigned kVersion22 = 2 * 256 + 2;
  if (version < kVersion22 || (flags & kMetadata)) return;  // older or annotated: left to Draco's own checks
  std::size_t at = kHeader;
  if (method == 1) {  // edgebreaker: traversal type, number of encoded vertices, number of faces
    ++at;
    if (!ReadVarint(packed, at)) Fail(place, "Draco data is cut short");
  }
  const auto faces = ReadVarint(packed, at);
  if (!faces) Fail(place, "Draco data is cut short");
  if (*faces / kFacesPerByte > packed.size) {
    Fail(place, std::to_string(packed.size) + " bytes of Draco data claim " + std::to_string(*faces) + " triangles");
  }
}

// What draco::Decoder does, with the decoder at hand afterwards: it holds the integers that the floats were made from.
draco::Status DecodeMesh(const Bytes& packed, draco::Mesh& mesh) {
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(packed.data), packed.size);
  draco::DecoderBuffer start = buffer;
  draco::DracoHeader header;
  if (const draco::Status status = draco::PointCloudDecoder::DecodeHeader(&start, &header); !status.ok()) return status;
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
  CheckClaims(packed, place);

  const auto mesh = std::make_unique<draco::Mesh>();
  try {
    const draco::Status status = DecodeMesh(packed, *mesh);
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
