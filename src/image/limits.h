// What every decoder checks before it asks for memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "facet/image.h"

namespace facet {

// Throws Error: InvalidInput for an empty picture, OutOfMemory for one beyond kMaxImageSide or kMaxImagePixels
// (codec.h); the message names the size.
void CheckImageSize(std::uint64_t width, std::uint64_t height, const std::string& name);

// As RowReceiver; it may take the rows away where they are the whole picture.
using PieceReceiver = std::function<void(Image& rows, int height)>;

// `count` bytes of value 0. Throws Error(OutOfMemory) when the machine has no more.
std::vector<std::byte> AllocatePixels(std::size_t count, const std::string& name);

}  // namespace facet
