// Memory for large arrays, in huge pages and without initialisation.
#pragma once

#include <cstddef>
#include <new>
#include <vector>

namespace facet {

// Arrays of this size and more, in bytes, are mapped from the operating system instead of taken from the heap: they are
// zeroed, and occupy physical memory only where they have been touched.
inline constexpr std::size_t kLargeArray = std::size_t{2} << 20;

// Allocates memory, from kLargeArray bytes on in huge pages where Linux offers them: page faults on first touch cost
// several times as much with small pages. Smaller allocations are not zeroed. Throws std::bad_alloc.
void* AllocatePages(std::size_t bytes);
void FreePages(void* memory, std::size_t bytes);

// Asks for huge pages for memory that was allocated elsewhere and has not been touched yet, such as a std::vector's
// between reserve() and resize().
void PreferHugePages(void* memory, std::size_t bytes);

// Asks for small pages for a large array of AllocatePages() of which much will never be touched: one touch makes a
// whole page resident.
void PreferSmallPages(void* memory, std::size_t bytes);

// An allocator for containers of trivial types whose resize() leaves added elements uninitialised.
template <class T>
struct PageAllocator {
  using value_type = T;
  PageAllocator() = default;
  template <class U>
  PageAllocator(const PageAllocator<U>&) {}  // NOLINT: containers convert it
  T* allocate(std::size_t count) {
    if (count > std::size_t(-1) / sizeof(T)) throw std::bad_array_new_length();
    return static_cast<T*>(AllocatePages(count * sizeof(T)));
  }
  void deallocate(T* memory, std::size_t count) { FreePages(memory, count * sizeof(T)); }
  template <class U>
  void construct(U* at) {
    ::new (static_cast<void*>(at)) U;
  }
  friend bool operator==(const PageAllocator&, const PageAllocator&) { return true; }
};

template <class T>
using PageVector = std::vector<T, PageAllocator<T>>;

}  // namespace facet
