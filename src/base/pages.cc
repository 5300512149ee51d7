#include "base/pages.h"

#include <cstdint>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace facet {
namespace {

constexpr std::size_t kHugePage = std::size_t{2} << 20;
constexpr std::align_val_t kAlignment{kHugePage};

bool IsLarge(std::size_t bytes) { return bytes >= 2 * kHugePage; }

}  // namespace

void* AllocatePages(std::size_t bytes) {
  if (!IsLarge(bytes)) return ::operator new(bytes);
  void* memory = ::operator new(bytes, kAlignment);
  PreferHugePages(memory, bytes);
  return memory;
}

void FreePages(void* memory, std::size_t bytes) {
  IsLarge(bytes) ? ::operator delete(memory, kAlignment) : ::operator delete(memory);
}

void PreferHugePages([[maybe_unused]] void* memory, [[maybe_unused]] std::size_t bytes) {
#ifdef __linux__
  if (!IsLarge(bytes)) return;
  const auto begin = (reinterpret_cast<std::uintptr_t>(memory) + kHugePage - 1) / kHugePage * kHugePage;
  const auto end = (reinterpret_cast<std::uintptr_t>(memory) + bytes) / kHugePage * kHugePage;
  if (begin < end) ::madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE);  // what it answers is no matter
#endif
}

}  // namespace facet
