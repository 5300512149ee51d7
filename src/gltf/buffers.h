// Buffers and buffer views: from the GLB, data URIs or files; plain or compressed by meshoptimizer.
#pragma once

#include <optional>
#include <vector>

#include "gltf/context.h"

namespace facet::gltf {

class BufferStore {
 public:
  // Reads every buffer. Throws Error (NotFound, InvalidInput).
  BufferStore(Context& context, std::optional<Bytes> bin);

  // The bytes of a buffer view, decompressed where it is compressed (once). Throws Error(InvalidInput).
  const Bytes& View(int index);

  // False for a view of a buffer without data (a placeholder that no extension fills).
  bool HasData(int index) const;

 private:
  struct Buffer {
    Bytes bytes;
    std::size_t declared_length = 0;
    bool present = false;  // false for those without data: placeholders and meshopt's fallbacks
  };

  Buffer LoadBuffer(std::size_t index, const std::optional<Bytes>& bin);
  Bytes Slice(std::size_t buffer, std::size_t offset, std::size_t length, const Place& place) const;

  Context& context_;
  std::vector<Buffer> buffers_;
  std::vector<std::optional<Bytes>> views_;
};

}  // namespace facet::gltf
