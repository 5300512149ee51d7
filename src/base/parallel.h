// Work spread over threads. The only place that knows the thread library.
#pragma once

#include <cstddef>
#include <functional>

namespace facet {

// Runs `body` inside an arena of `threads` threads (0: one per core); every ParallelFor called from it uses that arena.
// Exceptions of `body` are passed on.
void RunWithThreads(int threads, const std::function<void()>& body);

// How many threads the current arena has.
int CurrentThreadCount();

// Calls body(begin, end) for consecutive pieces of [0, count) of at most `grain` items each (grain >= 1), in any order
// and on any thread, with the floating-point environment pinned (see float_environment.h). Piece boundaries are
// multiples of `grain`: they depend on the arguments alone. The first exception is passed on when all have stopped.
void ParallelFor(std::size_t count, std::size_t grain, const std::function<void(std::size_t, std::size_t)>& body);

}  // namespace facet
