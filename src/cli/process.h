// What the program asks of the system before it begins.
#pragma once

#include <cstdint>

namespace facet::cli {

// Ctrl-C and other ways of being ended leave no unfinished file behind. Writing beyond a limit on the size of files is
// an error as any other, and a mapped input file that another program cuts short ends this one with one line.
void HandleSignals();

// A second line behind the library's own accounts: what libraries allocate that it does not know of fails too, with
// std::bad_alloc, when it goes far beyond `limit` bytes (0: DefaultMemoryLimit()). The stacks of `threads` (0: one per
// core) are not counted: a thread that cannot be made ends the process.
void LimitMemory(std::uint64_t limit, int threads);

}  // namespace facet::cli
