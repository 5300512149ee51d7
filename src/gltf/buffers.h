// Buffers and buffer views: from the GLB, data URIs or files; plain or compressed by meshoptimizer.
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

// Buffers are read when something asks for them: one that nothing needs may be broken, or not there.
class BufferStore {
 public:
  BufferStore(Context& context, std::optional<Bytes> bin);

  // Warns of a view that reaches past its buffer. Throws Error(InvalidInput) where the file's description is broken.
  const BufferView& Describe(int view);

  // The bytes of a buffer view, decompressed where it is compressed (once). Of a view that reaches past its buffer
  // those that are there. Throws Error (NotFound, InvalidInput).
  const Bytes& Read(int view);

  // How many bytes Read() would give, as far as the file's descriptions say.
  std::size_t Size(int view);

  // False for a view of a buffer without data (a placeholder that no extension fills).
  bool HasData(int view);

  // Why a view may have fewer bytes than it says; empty where it has them all.
  std::string Shortage(int view);

  // Warns of what is wrong with views and buffers that nobody has asked for.
  void CheckUnused();

 private:
  struct Buffer {
    std::optional<std::size_t> declared_length;
    bool has_data = false;  // false: a placeholder, or one of meshopt's fallbacks
    std::optional<Bytes> bytes;
    std::optional<Error> error;  // why it cannot be read
    std::string shortage;
  };
  struct View {
    std::optional<BufferView> description;  // where something has asked for it
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
