// Buffers and buffer views, from the GLB, data URIs or files, plain or compressed by meshoptimizer.
#pragma once

#include <optional>
#include <vector>

#include "gltf/context.h"

namespace facet::gltf {

// A buffer view as the file describes it.
struct BufferView {
  int buffer = -1;
  std::size_t offset = 0, length = 0;
  std::size_t stride = 0;  // 0: tightly packed
};

// Buffers are read when they are needed, so unused ones may be broken or missing.
class BufferStore {
 public:
  BufferStore(Context& context, std::optional<Bytes> bin);

  // Warns of a view that reaches past the end of its buffer. Throws Error(InvalidInput) if the description is broken.
  const BufferView& Describe(int view);

  // The bytes of a buffer view; a compressed one is decompressed once. Of a view that reaches past the end of its
  // buffer, the existing bytes. Throws Error (NotFound, InvalidInput).
  const Bytes& Read(int view);

  // The number of bytes that Read() would return, according to the file's descriptions.
  std::size_t Size(int view);

  // False for a view of a buffer without data (a placeholder that no extension fills).
  bool HasData(int view);

  // Why a view has fewer bytes than it says; empty if it has all.
  std::string Shortage(int view);

  // Warns of errors in views and buffers that were not used.
  void CheckUnused();

 private:
  struct Buffer {
    std::optional<std::size_t> declared_length;
    bool has_data = false;  // false: a placeholder, or one of meshopt's fallbacks
    std::optional<Bytes> bytes;
    std::optional<Error> error;  // why the buffer cannot be read
    std::string shortage;
  };
  struct View {
    std::optional<BufferView> description;  // set when the view is first used
    std::optional<Bytes> bytes;
  };

  Bytes Load(std::size_t buffer);
  const Bytes& Whole(std::size_t buffer);
  Bytes Slice(std::size_t buffer, std::size_t offset, std::size_t length, const Place& place);
  std::optional<Bytes> Unpack(std::size_t view, const Place& place);

  Context& context_;
  std::optional<Bytes> bin_;
  std::vector<Buffer> buffers_;
  std::vector<View> views_;
};

}  // namespace facet::gltf
