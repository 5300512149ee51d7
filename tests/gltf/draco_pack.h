// Meshes packed by Draco's own encoder.
#pragma once

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wpedantic"
#pragma GCC diagnostic ignored "-Wunused-parameter"
#include <draco/compression/expert_encode.h>
#pragma GCC diagnostic pop

#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

namespace facet::testing {

struct DracoAttribute {
  draco::GeometryAttribute::Type type;
  draco::DataType data_type;
  int components;
  const void* values;
  int bits = 0;  // of quantisation; 0: as they are
};

struct DracoPacking {
  draco::MeshEncoderMethod method = draco::MESH_EDGEBREAKER_ENCODING;
  int speed = 5;  // 0 to 10: which predictions and codes the encoder takes
};

// The attributes' unique ids are their places in the list.
inline std::string PackDraco(std::size_t count, const std::vector<std::uint32_t>& indices,
                             const std::vector<DracoAttribute>& attributes, const DracoPacking& packing = {}) {
  draco::Mesh mesh;
  const auto points = static_cast<std::uint32_t>(count);
  mesh.set_num_points(points);
  for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
    mesh.AddFace({draco::PointIndex(indices[i]), draco::PointIndex(indices[i + 1]), draco::PointIndex(indices[i + 2])});
  }
  for (const DracoAttribute& attribute : attributes) {
    const int size = attribute.components * draco::DataTypeLength(attribute.data_type);
    draco::GeometryAttribute description;
    description.Init(attribute.type, nullptr, static_cast<std::uint8_t>(attribute.components), attribute.data_type,
                     false, size, 0);
    draco::PointAttribute* const made = mesh.attribute(mesh.AddAttribute(description, true, points));
    std::memcpy(made->buffer()->data(), attribute.values, count * static_cast<std::size_t>(size));
  }
  draco::ExpertEncoder encoder(mesh);
  encoder.SetEncodingMethod(packing.method);
  encoder.SetSpeedOptions(packing.speed, packing.speed);
  for (std::size_t i = 0; i < attributes.size(); ++i) {
    if (attributes[i].bits > 0) encoder.SetAttributeQuantization(static_cast<int>(i), attributes[i].bits);
  }
  draco::EncoderBuffer buffer;
  const draco::Status status = encoder.EncodeToBuffer(&buffer);
  if (!status.ok()) throw std::runtime_error("Draco cannot pack: " + status.error_msg_string());
  return {buffer.data(), buffer.size()};
}

}  // namespace facet::testing
