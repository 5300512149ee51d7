// Bytes that someone else owns, kept alive: a file is read once, and its buffers and pictures are slices of it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>

namespace facet::gltf {

struct Bytes {
  std::shared_ptr<const void> owner;
  const std::byte* data = nullptr;
  std::size_t size = 0;

  std::span<const std::byte> Span() const { return {data, size}; }
  // The caller has checked offset + length <= size.
  Bytes Slice(std::size_t offset, std::size_t length) const { return {owner, data + offset, length}; }
};

struct MutableBytes {
  std::shared_ptr<std::byte[]> owner;
  std::size_t size = 0;

  std::byte* data() const { return owner.get(); }
  Bytes Freeze() const { return {owner, owner.get(), size}; }
};

// Uninitialised.
MutableBytes AllocateBytes(std::size_t size);

// A whole file; a large one is mapped, and must not be changed while the bytes are in use. Throws Error(NotFound) when
// it is not there, not readable, or not a regular file.
Bytes ReadWholeFile(const std::filesystem::path& path);

// The first `most` bytes of a file, or all where it has no more. `file_size` gets the size of the whole, where given.
// Throws as ReadWholeFile.
Bytes ReadFileStart(const std::filesystem::path& path, std::size_t most, std::uintmax_t* file_size = nullptr);

}  // namespace facet::gltf
