// base/parallel.h without a thread library, for FACET_THREADS=OFF.
#include <algorithm>

#include "base/float_environment.h"
#include "base/parallel.h"

namespace facet {

void RunWithThreads(int threads, const std::function<void()>& body) {
  CheckThreads(threads);
  const FloatEnvironment pinned;
  body();
}

int CurrentThreadCount() { return 1; }

void ParallelFor(std::size_t count, std::size_t grain, const std::function<void(std::size_t, std::size_t)>& body) {
  const FloatEnvironment pinned;
  for (std::size_t begin = 0, end = 0; begin < count; begin = end) {
    end = begin + std::min(grain, count - begin);
    body(begin, end);
  }
}

}  // namespace facet
