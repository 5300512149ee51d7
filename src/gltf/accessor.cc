#include "gltf/accessor.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <numeric>
#include <string>
#include <utility>

#include "base/memory_budget.h"

namespace facet::gltf {
namespace {

static_assert(std::endian::native == std::endian::little, "buffers are read as they lie, and glTF's are little-endian");

// A limit for elements that no buffer contains, since they take no space in a file.
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

// Calls visit(index within the range, new bytes) for each element of the range that a sparse accessor replaces.
template <class Visit>
void ForEachReplaced(const AccessorView& view, Range range, const Visit& visit) {
  if (!view.sparse_indices) return;
  const std::vector<std::uint32_t>& indices = *view.sparse_indices;
  const std::size_t value_size = view.sparse_values.size / indices.size();
  for (auto it = std::lower_bound(indices.begin(), indices.end(), range.first);
       it != indices.end() && *it - range.first < range.count; ++it) {
    visit(*it - range.first, view.sparse_values.data + std::size_t(it - indices.begin()) * value_size);
  }
}

void SetShape(const std::string& name, const Place& place, AccessorInfo& info) {
  struct Shape {
    const char* name;
    int columns, rows;
  };
  constexpr Shape kShapes[] = {{"SCALAR", 1, 1}, {"VEC2", 1, 2}, {"VEC3", 1, 3}, {"VEC4", 1, 4},
                               {"MAT2", 2, 2},   {"MAT3", 3, 3}, {"MAT4", 4, 4}};
  const auto* const shape =
      std::find_if(std::begin(kShapes), std::end(kShapes), [&](const Shape& s) { return name == s.name; });
  if (shape == std::end(kShapes)) Fail(place, "is not a type that glTF knows");
  info.columns = shape->columns;
  info.rows = shape->rows;
  std::size_t column = SizeOfComponent(info.type) * static_cast<std::size_t>(info.rows);
  if (info.columns > 1) column = (column + 3) / 4 * 4;  // matrix columns start at multiples of four bytes
  info.size = column * static_cast<std::size_t>(info.columns);
}

// Throws if elements reach beyond `available` bytes.
void CheckRun(std::size_t available, std::size_t offset, std::size_t count, std::size_t size, std::size_t stride,
              const std::string& shortage, const Place& place) {
  if (count == 0) return;
  const bool fits = offset <= available && size <= available - offset &&
                    (stride == 0 || (count - 1) <= (available - offset - size) / stride);
  if (fits) return;
  Fail(place,
       std::to_string(count) + " elements from byte " + std::to_string(offset) + " on reach past the " +
           std::to_string(available) + " bytes of their buffer view",
       shortage);
}

}  // namespace

AccessorInfo AccessorReader::Describe(int index) {
  const auto i = static_cast<std::size_t>(index);
  const Json& object = context_.Object("accessors", i);
  const Place list_place(context_.place, "accessors");
  const Place place(list_place, i);
  accessors_[i].is_used = true;
  AccessorInfo info;
  info.view = IndexAt(object, "bufferView", context_.document.Count("bufferViews"), "bufferViews", place);
  info.offset = SizeAt(object, "byteOffset", place).value_or(0);
  info.count = RequireSize(object, "count", place);
  RequireSize(object, "componentType", place);
  info.type =
      static_cast<ComponentType>(*OneOfAt(object, "componentType", {5120, 5121, 5122, 5123, 5125, 5126}, place));
  info.normalized = BoolAt(object, "normalized", place).value_or(false) && info.type != ComponentType::F32;
  SetShape(RequireString(object, "type", place), Place(place, "type"), info);
  return info;
}

Bytes AccessorReader::Run(int view, std::size_t offset, std::size_t count, std::size_t size, std::size_t stride,
                          const Place& place) {
  const Bytes& bytes = buffers_.Read(view);
  CheckRun(bytes.size, offset, count, size, stride, buffers_.Shortage(view), place);
  return count == 0 ? Bytes() : bytes.Slice(offset, (count - 1) * stride + size);
}

const AccessorView& AccessorReader::View(int index) {
  const auto i = static_cast<std::size_t>(index);
  Known& known = accessors_[i];
  if (!known.view) {
    const Place list_place(context_.place, "accessors");
    const Place place(list_place, i);
    const std::size_t before = context_.Charged();
    context_.Charge(1, sizeof(AccessorView), place);
    known.view = std::make_shared<const AccessorView>(MakeView(i, place));
    context_.KeepSince(before);
  }
  return *known.view;
}

AccessorView AccessorReader::MakeView(std::size_t i, const Place& place) {
  const AccessorInfo info = Describe(static_cast<int>(i));
  AccessorView view;
  view.count = info.count;
  view.type = info.type;
  view.normalized = info.normalized;
  view.components = info.columns * info.rows;
  view.is_matrix = info.columns > 1;
  view.stride = info.size;
  const bool is_placeholder = info.view >= 0 && !buffers_.HasData(info.view);
  if (is_placeholder) place.Warn("its buffer has no data; zeros are read");
  if (info.view >= 0 && !is_placeholder) {
    const std::size_t stride = buffers_.Describe(info.view).stride;
    if (stride != 0 && stride < info.size) {
      Fail(place,
           "its elements of " + std::to_string(info.size) + " bytes overlap: byteStride is " + std::to_string(stride));
    }
    if (stride != 0) view.stride = stride;
    view.bytes = Run(info.view, info.offset, view.count, info.size, view.stride, place);
  } else if (view.count > kMaxUnbackedElements) {
    Fail(place, "claims " + std::to_string(view.count) + " elements that no buffer view holds", {},
         ErrorCode::OutOfMemory);
  }
  if (const Json* sparse = ObjectAt(context_.Object("accessors", i), "sparse", place)) {
    ReadSparse(*sparse, info.size, Place(place, "sparse"), view);
  }
  return view;
}

void AccessorReader::ReadSparse(const Json& sparse, std::size_t element_size, const Place& place, AccessorView& view) {
  const std::size_t count = RequireSize(sparse, "count", place);
  if (count > view.count) Fail(Place(place, "count"), "is larger than the accessor's");
  if (count == 0) return;
  const Place indices_place(place, "indices"), values_place(place, "values");
  const Json &indices = RequireObject(sparse, "indices", place), &values = RequireObject(sparse, "values", place);
  const std::size_t views = context_.document.Count("bufferViews");
  RequireSize(indices, "componentType", indices_place);
  const auto type = static_cast<ComponentType>(*OneOfAt(indices, "componentType", {5121, 5123, 5125}, indices_place));
  const std::size_t index_size = SizeOfComponent(type);
  const Bytes index_bytes =
      Run(RequireIndex(indices, "bufferView", views, "bufferViews", indices_place),
          SizeAt(indices, "byteOffset", indices_place).value_or(0), count, index_size, index_size, indices_place);
  view.sparse_values =
      Run(RequireIndex(values, "bufferView", views, "bufferViews", values_place),
          SizeAt(values, "byteOffset", values_place).value_or(0), count, element_size, element_size, values_place);
  context_.Charge(count, sizeof(std::uint32_t), indices_place);
  std::vector<std::uint32_t> targets(count);
  bool sorted = true;
  for (std::size_t k = 0; k < count; ++k) {
    targets[k] = LoadUnsigned(type, index_bytes.data + k * index_size);
    if (targets[k] >= view.count) {
      Fail(indices_place,
           std::to_string(targets[k]) + " is not one of the " + std::to_string(view.count) + " elements");
    }
    sorted = sorted && (k == 0 || targets[k] > targets[k - 1]);
  }
  if (!sorted) {
    indices_place.Warn("do not increase");
    SortSparse(element_size, indices_place, targets, view.sparse_values);
  }
  view.sparse_indices = std::make_shared<const std::vector<std::uint32_t>>(std::move(targets));
}

// Sorts stably, so that the order of equal indices does not change.
void AccessorReader::SortSparse(std::size_t element_size, const Place& place, std::vector<std::uint32_t>& targets,
                                Bytes& values) {
  const std::size_t count = targets.size();
  context_.Charge(count, element_size, place);
  const MemoryLease lease(count, 2 * sizeof(std::uint32_t), "sorting");
  std::vector<std::uint32_t> order(count), sorted(count);
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return targets[a] < targets[b]; });
  const MutableBytes moved = AllocateBytes(count * element_size);
  for (std::size_t k = 0; k < count; ++k) {
    sorted[k] = targets[order[k]];
    std::memcpy(moved.data() + k * element_size, values.data + order[k] * element_size, element_size);
  }
  targets = std::move(sorted);
  values = moved.Freeze();
}

void AccessorReader::CheckUnused() {
  const Place list_place(context_.place, "accessors");
  for (std::size_t i = 0; i < accessors_.size(); ++i) {
    if (accessors_[i].is_used) continue;
    const Place place(list_place, i);
    context_.TryUnused(place, "nothing reads it", [&] {
      const AccessorInfo info = Describe(static_cast<int>(i));
      if (info.view < 0) return;
      const std::size_t stride = buffers_.Describe(info.view).stride;
      CheckRun(buffers_.Size(info.view), info.offset, info.count, info.size, stride != 0 ? stride : info.size, {},
               place);
    });
  }
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
  ForEachReplaced(view, range, [&](std::size_t i, const std::byte* value) {
    ConvertAny(view.type, value, 0, 1, read, components, view.normalized,
               out + i * static_cast<std::size_t>(components));
  });
  if (view.type != ComponentType::F32) return;
  const std::size_t total = range.count * static_cast<std::size_t>(components);
  std::size_t bad = 0;
  constexpr std::uint32_t kExponent = 0x7F800000u;
  for (std::size_t i = 0; i < total; ++i) bad += (std::bit_cast<std::uint32_t>(out[i]) & kExponent) == kExponent;
  if (bad == 0) return;
  for (std::size_t i = 0; i < total; ++i) {
    if ((std::bit_cast<std::uint32_t>(out[i]) & kExponent) == kExponent) out[i] = 0.0f;
  }
  place.Warn(std::to_string(bad) + " numbers that are not finite were replaced by 0");
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
  ForEachReplaced(view, range, [&](std::size_t i, const std::byte* value) {
    for (std::size_t c = 0; c < static_cast<std::size_t>(components); ++c) {
      out[i * static_cast<std::size_t>(components) + c] =
          LoadUnsigned(view.type, value + c * SizeOfComponent(view.type));
    }
  });
}

}  // namespace facet::gltf
