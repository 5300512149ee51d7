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

// TBB's library is not compiled with the thread sanitizer, which therefore does not see that a task starts after it was
// created and ends before the wait for it returns. These annotations tell it; tasks of one call stay unordered.
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

// Whether the thread is running a task in an arena of facet's, where all tasks are facet's own.
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

// The number of threads that an arena can have. By default TBB allows one per core; callers may ask for more, for
// example in tests of determinism. TBB prints to standard error if it does not grant a request, so only those are made
// that it will grant. Its limit is the smallest of all existing controls. Ours is never destroyed, since one for each
// call would lower the limit of other calls.
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
          // Isolated, so that a thread that waits for the last pieces of an inner loop does not begin a piece of an
          // outer one, which would need the memory of both at once. A thread that waits for the outermost loop takes
          // any piece.
          tbb::this_task_arena::isolate([&] {
            for (std::size_t piece = range.begin(); piece != range.end(); ++piece) run(piece);
          });
          FACET_RELEASE(&ended);
        },
        tbb::simple_partitioner());
  };
  // Isolated in an arena of the host's: otherwise a waiting thread might begin one of the host's tasks while it holds a
  // lock that the task needs.
  in_own_arena ? loop() : tbb::this_task_arena::isolate(loop);
  FACET_ACQUIRE(&ended);
}

}  // namespace facet
