// Memory for large arrays that are written in full.
#pragma once

#include <cstddef>
#include <new>
#include <vector>

namespace facet {

// From here on memory comes from the system, not from the heap: it is zero, and taken when it is first touched.
inline constexpr std::size_t kLargeArray = std::size_t{2} << 20;

// Bytes in huge pages where Linux has them: the first touch of memory costs several times as much in small ones. Less
// than kLargeArray is not zeroed. Throws std::bad_alloc.
void* AllocatePages(std::size_t bytes);
void FreePages(void* memory, std::size_t bytes);

// The same wish for memory that comes from elsewhere and has not been touched: a vector's between reserve() and
// resize().
void PreferHugePages(void* memory, std::size_t bytes);

// For a large array of AllocatePages() in which much will never be touched: a huge page is taken as a whole.
void PreferSmallPages(void* memory, std::size_t bytes);

// An allocator whose containers do not zero what they grow by: resize() leaves numbers unset.
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
