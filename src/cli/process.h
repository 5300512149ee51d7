// Signal handlers and a memory limit of the process, which the program sets up first.
#pragma once

#include <cstdint>

namespace facet::cli {

// Ctrl-C and other terminating signals remove unfinished files. Exceeding the limit on file sizes becomes an ordinary
// write error. If another program truncates a mapped input file, the process prints one line and exits.
void HandleSignals();

// A backstop behind the library's memory budget: allocations that the budget does not count, such as those of other
// libraries, fail with std::bad_alloc far beyond `limit` bytes (0: DefaultMemoryLimit()). The stacks of `threads` (0:
// one per core) are allowed on top, because failing to create a thread would end the process.
void LimitMemory(std::uint64_t limit, int threads);

}  // namespace facet::cli
