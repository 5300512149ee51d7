// Parallel loops. This is the only room that uses the thread library.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

#include "facet/error.h"

namespace facet {

// The largest number of threads that settings may ask for.
inline constexpr int kMaxThreads = 1024;

// Throws Error(InvalidUsage) unless `threads` is 0 (one per core) or a number up to kMaxThreads.
inline void CheckThreads(int threads) {
  if (threads >= 0 && threads <= kMaxThreads) return;
  throw Error(ErrorCode::InvalidUsage, std::to_string(threads) + " threads", "settings",
              "0 (one per core) to " + std::to_string(kMaxThreads) + " are accepted");
}

// Runs `body` inside an arena of `threads` threads (0: one per core; at most kMaxThreads); every ParallelFor called
// from it uses that arena. Exceptions of `body` are passed on. Throws as CheckThreads().
void RunWithThreads(int threads, const std::function<void()>& body);

// The number of threads of the current arena.
int CurrentThreadCount();

// Calls body(begin, end) for consecutive pieces of [0, count) of at most `grain` items each (grain >= 1), in any order
// and on any thread, with the floating-point environment pinned (see float_environment.h) and under the caller's memory
// budget. Piece boundaries are multiples of `grain`, so they depend on the arguments only. The first exception is
// passed on after all pieces have stopped.
void ParallelFor(std::size_t count, std::size_t grain, const std::function<void(std::size_t, std::size_t)>& body);

}  // namespace facet
