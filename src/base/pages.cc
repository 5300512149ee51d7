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

bool IsLarge(std::size_t bytes) { return bytes >= kLargeArray; }

#ifdef __linux__
std::size_t WholePages(std::size_t bytes) { return (bytes + kHugePage - 1) / kHugePage * kHugePage; }

// Maps zeroed memory that begins at the boundary of a huge page: maps one page too many, and unmaps what lies outside.
void* MapPages(std::size_t bytes) {
  const std::size_t whole = WholePages(bytes);
  void* const mapped = ::mmap(nullptr, whole + kHugePage, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (mapped == MAP_FAILED) throw std::bad_alloc();
  auto* const first = static_cast<std::byte*>(mapped);
  const std::size_t before = -reinterpret_cast<std::uintptr_t>(mapped) % kHugePage;
  if (before > 0) ::munmap(first, before);
  if (before < kHugePage) ::munmap(first + before + whole, kHugePage - before);
  return first + before;
}
#endif

}  // namespace

void* AllocatePages(std::size_t bytes) {
  if (bytes > std::size_t(PTRDIFF_MAX) - 2 * kHugePage) throw std::bad_alloc();
#ifdef __linux__
  void* memory = IsLarge(bytes) ? MapPages(bytes) : std::malloc(std::max<std::size_t>(bytes, 1));
#else
  void* memory = IsLarge(bytes) ? std::calloc(bytes, 1) : std::malloc(std::max<std::size_t>(bytes, 1));
#endif
  if (memory == nullptr) throw std::bad_alloc();
  PreferHugePages(memory, bytes);
  return memory;
}

// `bytes` must be what was allocated: it tells whether the memory was mapped or comes from malloc.
void FreePages(void* memory, [[maybe_unused]] std::size_t bytes) {
#ifdef __linux__
  if (IsLarge(bytes)) {
    ::munmap(memory, WholePages(bytes));
    return;
  }
#endif
  std::free(memory);
}

#ifdef __linux__
// A failure of madvise is ignored: it is a hint, and costs only speed.
void PreferHugePages(void* memory, std::size_t bytes) {
  if (!IsLarge(bytes)) return;
  const auto begin = (reinterpret_cast<std::uintptr_t>(memory) + kHugePage - 1) / kHugePage * kHugePage;
  const auto end = (reinterpret_cast<std::uintptr_t>(memory) + bytes) / kHugePage * kHugePage;
  if (begin < end) ::madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE);
}

void PreferSmallPages(void* memory, std::size_t bytes) {
  if (IsLarge(bytes)) ::madvise(memory, WholePages(bytes), MADV_NOHUGEPAGE);
}
#else
void PreferHugePages(void*, std::size_t) {}
void PreferSmallPages(void*, std::size_t) {}
#endif

}  // namespace facet
