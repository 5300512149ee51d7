// What every decoder checks before it asks for memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "base/memory_budget.h"
#include "facet/image.h"

namespace facet {

// Throws Error: InvalidInput for an empty image, OutOfMemory for one beyond kMaxImageSide or kMaxImagePixels
// (codec.h); the message names the size.
void CheckImageSize(std::uint64_t width, std::uint64_t height, const std::string& name);

// CheckImageSize(), and counts `rows` of the image at `bytes_per_pixel` against the memory budget for as long as it is
// being decoded. Throws Error(OutOfMemory) where that is too much.
MemoryLease LeaseImage(std::uint64_t width, std::uint64_t height, std::uint64_t rows, std::uint64_t bytes_per_pixel,
                       const std::string& name);

// As RowReceiver; it may take the rows away where they are the whole image.
using PieceReceiver = std::function<void(Image& rows, int height)>;

// Makes room for `count` bytes without touching them: a file that ends early takes no more than what it held. Throws
// Error(OutOfMemory) when the machine has no more.
void ReservePixels(std::vector<std::byte>& pixels, std::size_t count, const std::string& name);

// `count` bytes of value 0.
std::vector<std::byte> AllocatePixels(std::size_t count, const std::string& name);

}  // namespace facet
