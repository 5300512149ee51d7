// Accessors: typed, bounds-checked reading of buffer views.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "gltf/buffers.h"

namespace facet::gltf {

enum class ComponentType : std::uint16_t { I8 = 5120, U8, I16, U16, U32 = 5125, F32 };

constexpr std::size_t SizeOfComponent(ComponentType type) {
  switch (type) {
    case ComponentType::I8:
    case ComponentType::U8: return 1;
    case ComponentType::I16:
    case ComponentType::U16: return 2;
    default: return 4;
  }
}

// An accessor as the file describes it, without its sparse part.
struct AccessorInfo {
  int view = -1;  // -1: all zeros
  std::size_t offset = 0, count = 0;
  ComponentType type = ComponentType::F32;
  bool normalized = false;  // integers only
  int columns = 1, rows = 1;
  std::size_t size = 0;  // bytes of an element, with the padding of small matrices
};

// The elements of an accessor, which have been checked to lie within `bytes`.
struct AccessorView {
  Bytes bytes;             // the first element starts here; null data: all zeros
  std::size_t stride = 0;  // bytes from one element to the next
  std::size_t count = 0;
  ComponentType type = ComponentType::F32;
  int components = 1;  // 1 to 4 for vectors; 4, 9 or 16 for matrices
  bool is_matrix = false;
  bool normalized = false;
  // Sparse elements: the indices of the replaced elements, which never decrease (of equal ones the last counts), and as
  // many new elements.
  std::shared_ptr<const std::vector<std::uint32_t>> sparse_indices;  // may be null
  Bytes sparse_values;
};

// A run of elements.
struct Range {
  std::size_t first = 0, count = 0;
};

class AccessorReader {
 public:
  AccessorReader(Context& context, BufferStore& buffers) : context_(context), buffers_(buffers) {
    const std::size_t count = context.document.Count("accessors");
    context.Charge(count, sizeof(Known), Place(context.place, "accessors"));
    accessors_.resize(count);
  }

  // Throws Error(InvalidInput) if the file's description is broken.
  AccessorInfo Describe(int accessor);
  std::size_t Count(int accessor) { return Describe(accessor).count; }

  // Throws Error(InvalidInput) if an element lies outside of its bytes, and Error(OutOfMemory) if the accessor has too
  // many elements that no buffer contains.
  const AccessorView& View(int accessor);

  // Warns of errors in accessors that were not used, without reading their elements.
  void CheckUnused();

  // Reads the first min(components, view.components) components of each element of `range` (within view.count) as
  // float. Normalised integers are converted as in glTF 2.0's section 3.11 (max(c / 127, -1) and so on), others by
  // value. Values that are not finite become 0, with one warning at `place`. `out` has `components` floats per element;
  // components that the accessor lacks are not written.
  void ReadFloats(const AccessorView& view, Range range, int components, float* out, const Place& place);

  // Reads scalars or vectors of unsigned integers, without normalisation.
  void ReadUnsigned(const AccessorView& view, Range range, int components, std::uint32_t* out);

 private:
  struct Known {
    bool is_used = false;
    std::shared_ptr<const AccessorView> view;  // many primitives may share an accessor
  };

  AccessorView MakeView(std::size_t accessor, const Place& place);
  void ReadSparse(const Json& sparse, std::size_t element_size, const Place& place, AccessorView& view);
  void SortSparse(std::size_t element_size, const Place& place, std::vector<std::uint32_t>& targets, Bytes& values);
  // Returns `count` elements of `size` bytes, `stride` apart, from `offset` of a buffer view on.
  Bytes Run(int view, std::size_t offset, std::size_t count, std::size_t size, std::size_t stride, const Place& place);

  Context& context_;
  BufferStore& buffers_;
  std::vector<Known> accessors_;
};

}  // namespace facet::gltf
