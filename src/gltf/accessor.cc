#include "gltf/accessor.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <string>

namespace facet::gltf {
namespace {

static_assert(std::endian::native == std::endian::little, "buffers are read as they lie, and glTF's are little-endian");

// Elements that no buffer holds cost a file nothing, so they are bounded by themselves.
constexpr std::size_t kMaxUnbackedElements = std::size_t(1) << 24;

template <class T>
T Load(const std::byte* p) {
  T value;
  std::memcpy(&value, p, sizeof value);
  return value;
}

template <class T>
float ToFloat(T value, bool normalized) {
  if (!normalized) return static_cast<float>(value);
  if constexpr (std::is_same_v<T, std::int8_t>) return std::max(static_cast<float>(value) / 127.0f, -1.0f);
  if constexpr (std::is_same_v<T, std::int16_t>) return std::max(static_cast<float>(value) / 32767.0f, -1.0f);
  if constexpr (std::is_same_v<T, std::uint8_t>) return static_cast<float>(value) / 255.0f;
  if constexpr (std::is_same_v<T, std::uint16_t>) return static_cast<float>(value) / 65535.0f;
  if constexpr (std::is_same_v<T, std::uint32_t>) return static_cast<float>(double(value) / 4294967295.0);
  return static_cast<float>(value);
}

template <class T>
void Convert(const std::byte* from, std::size_t stride, std::size_t count, int read, int components, bool normalized,
             float* out) {
  if (std::is_same_v<T, float> && read == components && stride == std::size_t(read) * sizeof(float)) {
    std::memcpy(out, from, count * stride);
    return;
  }
  for (std::size_t i = 0; i < count; ++i, from += stride, out += components) {
    for (int c = 0; c < read; ++c) out[c] = ToFloat(Load<T>(from + std::size_t(c) * sizeof(T)), normalized);
  }
}

void ConvertAny(ComponentType type, const std::byte* from, std::size_t stride, std::size_t count, int read,
                int components, bool normalized, float* out) {
  switch (type) {
    case ComponentType::I8: return Convert<std::int8_t>(from, stride, count, read, components, normalized, out);
    case ComponentType::U8: return Convert<std::uint8_t>(from, stride, count, read, components, normalized, out);
    case ComponentType::I16: return Convert<std::int16_t>(from, stride, count, read, components, normalized, out);
    case ComponentType::U16: return Convert<std::uint16_t>(from, stride, count, read, components, normalized, out);
    case ComponentType::U32: return Convert<std::uint32_t>(from, stride, count, read, components, normalized, out);
    case ComponentType::F32: return Convert<float>(from, stride, count, read, components, false, out);
  }
}

std::uint32_t LoadUnsigned(ComponentType type, const std::byte* p) {
  switch (type) {
    case ComponentType::U8: return Load<std::uint8_t>(p);
    case ComponentType::U16: return Load<std::uint16_t>(p);
    default: return Load<std::uint32_t>(p);
  }
}

template <class T>
void ConvertUnsigned(const std::byte* from, std::size_t stride, std::size_t count, int components, std::uint32_t* out) {
  for (std::size_t i = 0; i < count; ++i, from += stride) {
    for (int c = 0; c < components; ++c) *out++ = Load<T>(from + std::size_t(c) * sizeof(T));
  }
}

struct Layout {
  int columns = 1, rows = 1;
  std::size_t size = 0;  // bytes of an element, with the padding of small matrices
};

Layout LayoutOf(int tinygltf_type, ComponentType type) {
  Layout layout;
  switch (tinygltf_type) {
    case TINYGLTF_TYPE_VEC2: layout.rows = 2; break;
    case TINYGLTF_TYPE_VEC3: layout.rows = 3; break;
    case TINYGLTF_TYPE_VEC4: layout.rows = 4; break;
    case TINYGLTF_TYPE_MAT2: layout.columns = layout.rows = 2; break;
    case TINYGLTF_TYPE_MAT3: layout.columns = layout.rows = 3; break;
    case TINYGLTF_TYPE_MAT4: layout.columns = layout.rows = 4; break;
    default: break;
  }
  std::size_t column = SizeOfComponent(type) * static_cast<std::size_t>(layout.rows);
  if (layout.columns > 1) column = (column + 3) / 4 * 4;  // matrix columns start at multiples of four bytes
  layout.size = column * static_cast<std::size_t>(layout.columns);
  return layout;
}

// `count` elements of `size` bytes, `stride` apart, from `offset` on.
Bytes CheckedRun(const Bytes& view, std::size_t offset, std::size_t count, std::size_t size, std::size_t stride,
                 const Place& place) {
  const bool fits =
      offset <= view.size && size <= view.size - offset && (count - 1) <= (view.size - offset - size) / stride;
  if (!fits) {
    Fail(place, std::to_string(count) + " elements from byte " + std::to_string(offset) + " on reach past the " +
                    std::to_string(view.size) + " bytes of their buffer view");
  }
  return view.Slice(offset, (count - 1) * stride + size);
}

}  // namespace

std::size_t AccessorReader::Count(int accessor) const {
  return context_.document.core.accessors[static_cast<std::size_t>(accessor)].count;
}

AccessorView AccessorReader::View(int index) {
  const auto i = static_cast<std::size_t>(index);
  const auto& accessor = context_.document.core.accessors[i];
  const Place list_place(context_.place, "accessors");
  const Place place(list_place, i);

  AccessorView view;
  view.count = accessor.count;
  view.type = static_cast<ComponentType>(accessor.componentType);
  view.normalized = accessor.normalized && view.type != ComponentType::F32;
  const Layout layout = LayoutOf(accessor.type, view.type);
  view.components = layout.columns * layout.rows;
  view.is_matrix = layout.columns > 1;
  view.stride = layout.size;
  const bool is_placeholder = accessor.bufferView >= 0 && !buffers_.HasData(accessor.bufferView);
  if (is_placeholder) context_.Warn(place, "its buffer has no data; zeros are read");
  if (accessor.bufferView >= 0 && !is_placeholder) {
    const std::size_t stride =
        context_.document.core.bufferViews[static_cast<std::size_t>(accessor.bufferView)].byteStride;
    if (stride != 0 && stride < layout.size) {
      Fail(place, "its elements of " + std::to_string(layout.size) + " bytes overlap: byteStride is " +
                      std::to_string(stride));
    }
    if (stride != 0) view.stride = stride;
    view.bytes = CheckedRun(buffers_.View(accessor.bufferView), accessor.byteOffset, view.count, layout.size,
                            view.stride, place);
  } else if (view.count > kMaxUnbackedElements) {
    Fail(place, "claims " + std::to_string(view.count) + " elements that no buffer view holds", {},
         ErrorCode::OutOfMemory);
  }

  if (const Json* sparse = Find(context_.Object("accessors", i), "sparse")) {
    const Place sparse_place(place, "sparse");
    view.sparse_count = RequireSize(*sparse, "count", sparse_place);
    if (view.sparse_count == 0) return view;
    const Json& indices = *Find(*sparse, "indices");
    const Json& values = *Find(*sparse, "values");
    view.sparse_type = static_cast<ComponentType>(RequireSize(indices, "componentType", sparse_place));
    const std::size_t index_size = SizeOfComponent(view.sparse_type);
    view.sparse_indices =
        CheckedRun(buffers_.View(indices["bufferView"].get<int>()), SizeAt(indices, "byteOffset", place).value_or(0),
                   view.sparse_count, index_size, index_size, Place(sparse_place, "indices"));
    view.sparse_values =
        CheckedRun(buffers_.View(values["bufferView"].get<int>()), SizeAt(values, "byteOffset", place).value_or(0),
                   view.sparse_count, layout.size, layout.size, Place(sparse_place, "values"));
    for (std::size_t k = 0; k < view.sparse_count; ++k) {
      const std::size_t target = LoadUnsigned(view.sparse_type, view.sparse_indices.data + k * index_size);
      if (target >= view.count) {
        Fail(Place(sparse_place, "indices"),
             std::to_string(target) + " is not one of the " + std::to_string(view.count) + " elements");
      }
    }
  }
  return view;
}

void AccessorReader::ReadFloats(const AccessorView& view, Range range, int components, float* out, const Place& place) {
  const int read = std::min(components, view.components);
  if (view.bytes.data) {
    ConvertAny(view.type, view.bytes.data + range.first * view.stride, view.stride, range.count, read, components,
               view.normalized, out);
  } else {
    for (std::size_t i = 0; i < range.count; ++i) {
      for (int c = 0; c < read; ++c) out[i * static_cast<std::size_t>(components) + static_cast<std::size_t>(c)] = 0.0f;
    }
  }
  if (view.sparse_count != 0) {
    const std::size_t value_size = view.sparse_values.size / view.sparse_count;
    for (std::size_t k = 0; k < view.sparse_count; ++k) {
      const std::size_t target =
          LoadUnsigned(view.sparse_type, view.sparse_indices.data + k * SizeOfComponent(view.sparse_type));
      if (target < range.first || target - range.first >= range.count) continue;
      ConvertAny(view.type, view.sparse_values.data + k * value_size, value_size, 1, read, components, view.normalized,
                 out + (target - range.first) * static_cast<std::size_t>(components));
    }
  }
  if (view.type != ComponentType::F32) return;
  const std::size_t total = range.count * static_cast<std::size_t>(components);
  std::size_t bad = 0;
  constexpr std::uint32_t kExponent = 0x7F800000u;
  for (std::size_t i = 0; i < total; ++i) bad += (std::bit_cast<std::uint32_t>(out[i]) & kExponent) == kExponent;
  if (bad == 0) return;
  for (std::size_t i = 0; i < total; ++i) {
    if ((std::bit_cast<std::uint32_t>(out[i]) & kExponent) == kExponent) out[i] = 0.0f;
  }
  context_.Warn(place, std::to_string(bad) + " numbers that are not finite were replaced by 0");
}

void AccessorReader::ReadUnsigned(const AccessorView& view, Range range, int components, std::uint32_t* out) {
  const std::byte* from = view.bytes.data ? view.bytes.data + range.first * view.stride : nullptr;
  if (!from) {
    std::fill_n(out, range.count * static_cast<std::size_t>(components), 0u);
  } else if (view.type == ComponentType::U8) {
    ConvertUnsigned<std::uint8_t>(from, view.stride, range.count, components, out);
  } else if (view.type == ComponentType::U16) {
    ConvertUnsigned<std::uint16_t>(from, view.stride, range.count, components, out);
  } else {
    ConvertUnsigned<std::uint32_t>(from, view.stride, range.count, components, out);
  }
  const std::size_t value_size = view.sparse_count ? view.sparse_values.size / view.sparse_count : 0;
  for (std::size_t k = 0; k < view.sparse_count; ++k) {
    const std::size_t target =
        LoadUnsigned(view.sparse_type, view.sparse_indices.data + k * SizeOfComponent(view.sparse_type));
    if (target < range.first || target - range.first >= range.count) continue;
    for (int c = 0; c < components; ++c) {
      const std::byte* value = view.sparse_values.data + k * value_size;
      out[(target - range.first) * static_cast<std::size_t>(components) + static_cast<std::size_t>(c)] =
          LoadUnsigned(view.type, value + static_cast<std::size_t>(c) * SizeOfComponent(view.type));
    }
  }
}

}  // namespace facet::gltf
