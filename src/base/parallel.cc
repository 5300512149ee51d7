#include "base/parallel.h"

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>

#include "base/float_environment.h"

// TBB's library is not compiled for the thread sanitizer, which then misses that a task starts after it was made and
// ends before it was waited for. It is told so here; tasks of one call stay unordered among themselves.
#if defined(__SANITIZE_THREAD__)
#define FACET_THREAD_SANITIZER 1
#elif defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define FACET_THREAD_SANITIZER 1
#endif
#endif
#if defined(FACET_THREAD_SANITIZER)
#include <sanitizer/tsan_interface.h>
#define FACET_RELEASE(address) __tsan_release(address)
#define FACET_ACQUIRE(address) __tsan_acquire(address)
#else
#define FACET_RELEASE(address) void()
#define FACET_ACQUIRE(address) void()
#endif

namespace facet {

void RunWithThreads(int threads, const std::function<void()>& body) {
  const FloatEnvironment pinned;
  // More threads than cores are granted only on demand (they serve tests of determinism).
  const std::size_t wanted =
      std::max<std::size_t>(static_cast<std::size_t>(threads),
                            tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
  const tbb::global_control allowance(tbb::global_control::max_allowed_parallelism, wanted);
  tbb::task_arena arena(threads > 0 ? threads : tbb::task_arena::automatic);
  arena.execute([&] { body(); });
}

int CurrentThreadCount() { return tbb::this_task_arena::max_concurrency(); }

void ParallelFor(std::size_t count, std::size_t grain, const std::function<void(std::size_t, std::size_t)>& body) {
  const std::size_t pieces = count / grain + (count % grain != 0);
  if (pieces == 0) return;
  const auto run = [&](std::size_t piece) {
    const FloatEnvironment pinned;
    const std::size_t begin = piece * grain;
    body(begin, begin + std::min(grain, count - begin));
  };
  if (pieces == 1) return run(0);
  [[maybe_unused]] char started = 0, ended = 0;
  FACET_RELEASE(&started);
  // Isolated: while it waits for the last pieces of an inner loop, a thread must not begin a piece of an outer one, or
  // the memory of both would be in use at once.
  tbb::this_task_arena::isolate([&] {
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, pieces, 1),
        [&](const tbb::blocked_range<std::size_t>& range) {
          FACET_ACQUIRE(&started);
          for (std::size_t piece = range.begin(); piece != range.end(); ++piece) run(piece);
          FACET_RELEASE(&ended);
        },
        tbb::simple_partitioner());
  });
  FACET_ACQUIRE(&ended);
}

}  // namespace facet
