#include "base/parallel.h"

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <utility>

#include "base/float_environment.h"
#include "base/memory_budget.h"

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
namespace {

// Whether the thread is at work for facet in an arena of facet's, where all tasks are facet's own.
thread_local bool in_own_arena = false;

class InOwnArena {
 public:
  InOwnArena() : before_(std::exchange(in_own_arena, true)) {}
  ~InOwnArena() { in_own_arena = before_; }
  InOwnArena(const InOwnArena&) = delete;
  InOwnArena& operator=(const InOwnArena&) = delete;

 private:
  const bool before_;
};

// How many threads an arena may have. TBB gives as many as there are cores; more are a request of the caller's, and
// serve tests of determinism. TBB says on standard error when it does not grant a request, so that none is made that it
// would not. Its limit is the least of all controls that live: ours stays, since one for each call would lower what
// another call has just asked for.
int Granted(int threads) {
  if (threads <= 0) return tbb::task_arena::automatic;
  using tbb::global_control;
  if (threads > tbb::info::default_concurrency()) {
    static const auto* const allowance = new global_control(global_control::max_allowed_parallelism, kMaxThreads);
    static_cast<void>(allowance);
  }
  const std::size_t most = global_control::active_value(global_control::max_allowed_parallelism);
  return static_cast<int>(std::min<std::size_t>(static_cast<std::size_t>(threads), most));
}

}  // namespace

void RunWithThreads(int threads, const std::function<void()>& body) {
  CheckThreads(threads);
  const FloatEnvironment pinned;
  MemoryBudget& budget = MemoryBudget::Current();
  tbb::task_arena arena(Granted(threads));
  arena.execute([&] {
    const MemoryBudget::Scope scope(budget);
    const InOwnArena own;
    body();
  });
}

int CurrentThreadCount() { return tbb::this_task_arena::max_concurrency(); }

void ParallelFor(std::size_t count, std::size_t grain, const std::function<void(std::size_t, std::size_t)>& body) {
  const std::size_t pieces = count / grain + (count % grain != 0);
  if (pieces == 0) return;
  MemoryBudget& budget = MemoryBudget::Current();
  const auto run = [&](std::size_t piece) {
    const FloatEnvironment pinned;
    const MemoryBudget::Scope scope(budget);
    const std::size_t begin = piece * grain;
    body(begin, begin + std::min(grain, count - begin));
  };
  if (pieces == 1) return run(0);
  [[maybe_unused]] char started = 0, ended = 0;
  FACET_RELEASE(&started);
  const auto loop = [&] {
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, pieces, 1),
        [&](const tbb::blocked_range<std::size_t>& range) {
          FACET_ACQUIRE(&started);
          const InOwnArena own;
          // Isolated: while it waits for the last pieces of an inner loop, a thread must not begin a piece of an outer
          // one, or the memory of both would be in use at once. Whoever waits for the outermost loop helps with any.
          tbb::this_task_arena::isolate([&] {
            for (std::size_t piece = range.begin(); piece != range.end(); ++piece) run(piece);
          });
          FACET_RELEASE(&ended);
        },
        tbb::simple_partitioner());
  };
  // In an arena of the host's a thread that waits might begin one of the host's tasks, whose locks it may hold.
  in_own_arena ? loop() : tbb::this_task_arena::isolate(loop);
  FACET_ACQUIRE(&ended);
}

}  // namespace facet
