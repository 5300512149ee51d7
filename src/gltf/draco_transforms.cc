#include "gltf/draco_transforms.h"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wpedantic"
#pragma GCC diagnostic ignored "-Wunused-parameter"
#include <draco/attributes/attribute_octahedron_transform.h>
#include <draco/attributes/attribute_quantization_transform.h>
#include <draco/compression/mesh/mesh_decoder.h>
#pragma GCC diagnostic pop

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace facet::gltf {
namespace {

// Whether an attribute has integers or floats without gaps between elements.
struct Values {
  std::byte* data = nullptr;
  std::size_t count = 0, components = 0;
};

// Nothing if the attribute does not have the form of Draco's quantised attributes.
Values ValuesOf(draco::PointAttribute& attribute, bool integers) {
  const draco::DataType type = attribute.data_type();
  const bool fits = integers ? type == draco::DT_INT32 || type == draco::DT_UINT32 : type == draco::DT_FLOAT32;
  Values values;
  values.count = attribute.size();
  values.components = attribute.num_components();
  const std::size_t stride = values.components * sizeof(float);
  if (!fits || values.components == 0 || !attribute.buffer() || attribute.byte_offset() != 0 ||
      attribute.byte_stride() != static_cast<std::int64_t>(stride) ||
      attribute.buffer()->data_size() / stride < values.count) {
    return {};
  }
  values.data = reinterpret_cast<std::byte*>(attribute.buffer()->data());
  return values;
}

template <class T>
T Load(const Values& values, std::size_t at) {
  T value;
  std::memcpy(&value, values.data + at * sizeof value, sizeof value);
  return value;
}

void Dequantize(const draco::AttributeQuantizationTransform& transform, const Values& in, const Values& out) {
  const float step = transform.range() / static_cast<float>((1u << transform.quantization_bits()) - 1);
  for (std::size_t i = 0; i < out.count * out.components; ++i) {
    const float from_least = static_cast<float>(Load<std::int32_t>(in, i)) * step;
    const float value = from_least + transform.min_value(static_cast<int>(i % out.components));
    std::memcpy(out.data + i * sizeof value, &value, sizeof value);
  }
}

void DecodeNormals(int bits, const Values& in, const Values& out) {
  const float step = 2.0f / static_cast<float>((1u << bits) - 2);
  for (std::size_t i = 0; i < out.count; ++i) {
    float y = static_cast<float>(Load<std::int32_t>(in, 2 * i)) * step - 1.0f;
    float z = static_cast<float>(Load<std::int32_t>(in, 2 * i + 1)) * step - 1.0f;
    const float x = 1.0f - std::fabs(y) - std::fabs(z);
    const float fold = std::max(-x, 0.0f);  // the far half lies folded outwards
    y += y < 0.0f ? fold : -fold;
    z += z < 0.0f ? fold : -fold;
    const float square = x * x + y * y + z * z;
    const float scale = static_cast<double>(square) < 1e-6 ? 0.0f : 1.0f / std::sqrt(square);
    const std::array<float, 3> normal{x * scale, y * scale, z * scale};
    std::memcpy(out.data + i * sizeof normal, normal.data(), sizeof normal);
  }
}

}  // namespace

void DequantizeDraco(draco::MeshDecoder& decoder, draco::Mesh& mesh) {
  for (std::int32_t id = 0; id < mesh.num_attributes(); ++id) {
    const draco::PointAttribute* const portable = decoder.GetPortableAttribute(id);
    if (!portable) continue;
    const Values in = ValuesOf(const_cast<draco::PointAttribute&>(*portable), true);
    const Values out = ValuesOf(*mesh.attribute(id), false);
    if (!in.data || !out.data || in.count < out.count) continue;
    draco::AttributeQuantizationTransform quantization;
    draco::AttributeOctahedronTransform octahedron;
    if (in.components == out.components && quantization.InitFromAttribute(*portable)) {
      Dequantize(quantization, in, out);
    } else if (in.components == 2 && out.components == 3 && octahedron.InitFromAttribute(*portable)) {
      DecodeNormals(octahedron.quantization_bits(), in, out);
    }
  }
}

}  // namespace facet::gltf
