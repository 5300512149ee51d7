// Accessors: typed, bounds-checked reading of what buffer views hold.
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

// An accessor as the file describes it, its sparse part aside.
struct AccessorInfo {
  int view = -1;  // -1: all zeros
  std::size_t offset = 0, count = 0;
  ComponentType type = ComponentType::F32;
  bool normalized = false;  // integers only
  int columns = 1, rows = 1;
  std::size_t size = 0;  // bytes of an element, with the padding of small matrices
};

// Elements that have been checked to lie within their bytes.
struct AccessorView {
  Bytes bytes;             // the first element starts here; null data: all zeros
  std::size_t stride = 0;  // bytes from one element to the next
  std::size_t count = 0;
  ComponentType type = ComponentType::F32;
  int components = 1;  // 1 to 4 for vectors; 4, 9 or 16 for matrices
  bool is_matrix = false;
  bool normalized = false;
  // Elements replaced: their indices, which never decrease (of equal ones the last counts), and as many elements.
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

  // Throws Error(InvalidInput) where the file's description is broken.
  AccessorInfo Describe(int accessor);
  std::size_t Count(int accessor) { return Describe(accessor).count; }

  // Throws Error(InvalidInput) when an element lies outside of its bytes, Error(OutOfMemory) when the accessor claims
  // more elements than a file that does not hold them may.
  const AccessorView& View(int accessor);

  // Warns of what is wrong with accessors that nobody has asked for, without reading what they hold.
  void CheckUnused();

  // The first min(components, view.components) numbers of each element of `range` (within view.count), as float:
  // integers that are normalised by glTF 2.0's section 3.11 (max(c / 127, -1) and its like), others by value. What is
  // not finite becomes 0, with one warning at `place`. `out` is `components` floats an element; what an element lacks
  // is left as it is.
  void ReadFloats(const AccessorView& view, Range range, int components, float* out, const Place& place);

  // Of scalars or vectors of unsigned integers, without normalisation.
  void ReadUnsigned(const AccessorView& view, Range range, int components, std::uint32_t* out);

 private:
  struct Known {
    bool is_used = false;
    std::shared_ptr<const AccessorView> view;  // many primitives may share an accessor
  };

  AccessorView MakeView(std::size_t accessor, const Place& place);
  void ReadSparse(const Json& sparse, std::size_t element_size, const Place& place, AccessorView& view);
  void SortSparse(std::size_t element_size, const Place& place, std::vector<std::uint32_t>& targets, Bytes& values);
  // `count` elements of `size` bytes, `stride` apart, from `offset` of a buffer view on.
  Bytes Run(int view, std::size_t offset, std::size_t count, std::size_t size, std::size_t stride, const Place& place);

  Context& context_;
  BufferStore& buffers_;
  std::vector<Known> accessors_;
};

}  // namespace facet::gltf
