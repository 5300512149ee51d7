// Checks that every decoder makes before it allocates memory.
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

// CheckImageSize(), and charges `rows` rows of the image at `bytes_per_pixel` to the memory budget for the lifetime of
// the lease. Throws Error(OutOfMemory) if that exceeds the budget.
MemoryLease LeaseImage(std::uint64_t width, std::uint64_t height, std::uint64_t rows, std::uint64_t bytes_per_pixel,
                       const std::string& name);

// As RowReceiver, but may move the rows away if they are the whole image.
using PieceReceiver = std::function<void(Image& rows, int height)>;

// Reserves `count` bytes without touching them, so that a truncated file takes only memory for what it contains. Throws
// Error(OutOfMemory) if the machine has no more.
void ReservePixels(std::vector<std::byte>& pixels, std::size_t count, const std::string& name);

// Allocates `count` zeroed bytes.
std::vector<std::byte> AllocatePixels(std::size_t count, const std::string& name);

}  // namespace facet
