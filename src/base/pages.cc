#include "base/pages.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <new>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace facet {
namespace {

constexpr std::size_t kHugePage = std::size_t{2} << 20;

bool IsLarge(std::size_t bytes) { return bytes >= 2 * kHugePage; }

}  // namespace

void* AllocatePages(std::size_t bytes) {
  if (bytes > std::size_t(PTRDIFF_MAX)) throw std::bad_alloc();
  const std::size_t whole = (bytes + kHugePage - 1) / kHugePage * kHugePage;
  void* memory = IsLarge(bytes) ? std::aligned_alloc(kHugePage, whole) : std::malloc(std::max<std::size_t>(bytes, 1));
  if (memory == nullptr) throw std::bad_alloc();
  PreferHugePages(memory, bytes);
  return memory;
}

// Of both kinds. (Clang 14 runs both of two forms of operator delete, whichever is asked for.)
void FreePages(void* memory) { std::free(memory); }

void PreferHugePages([[maybe_unused]] void* memory, [[maybe_unused]] std::size_t bytes) {
#ifdef __linux__
  if (!IsLarge(bytes)) return;
  const auto begin = (reinterpret_cast<std::uintptr_t>(memory) + kHugePage - 1) / kHugePage * kHugePage;
  const auto end = (reinterpret_cast<std::uintptr_t>(memory) + bytes) / kHugePage * kHugePage;
  if (begin < end) ::madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE);  // what it answers is no matter
#endif
}

}  // namespace facet
