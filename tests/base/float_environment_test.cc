#include "base/float_environment.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cfenv>
#include <limits>

#include "base/parallel.h"
#include "facet/error.h"

namespace facet {
namespace {

// Volatile: the compiler must neither fold nor move the arithmetic.
bool RoundsToNearest() {
  volatile float one = 1.0f, half_ulp = 0x1p-24f, more = 0x1.8p-24f;
  const float tie = one + half_ulp, up = one + more, down = -one - half_ulp;
  return tie == 1.0f && up == 1.0f + 0x1p-23f && down == -1.0f;
}
bool KeepsSubnormals() {
  volatile float smallest_normal = std::numeric_limits<float>::min(), half = 0.5f, two = 2.0f;
  volatile float subnormal = smallest_normal * half;  // flushed by FTZ
  const float back = subnormal * two;                 // lost by DAZ
  return back == smallest_normal;
}
bool IsPinned() { return RoundsToNearest() && KeepsSubnormals(); }

// The whole control word, exception flags left out.
std::uint64_t ControlBits() {
#if defined(__x86_64__)
  return _mm_getcsr() & ~0x3Fu;
#elif defined(__aarch64__)
  std::uint64_t bits = 0;
  asm volatile("mrs %0, fpcr" : "=r"(bits));
  return bits;
#else
  return std::uint64_t(std::fegetround());
#endif
}

// A host compiled with -ffast-math that also rounds upwards, for the lifetime of the object.
class HostileHost {
 public:
  HostileHost() {
    std::fegetenv(&saved_);
    std::fesetround(FE_UPWARD);
#if defined(__x86_64__)
    _mm_setcsr(_mm_getcsr() | 0x8040);  // FTZ, DAZ
#elif defined(__aarch64__)
    asm volatile("msr fpcr, %0" : : "r"(ControlBits() | (std::uint64_t{1} << 24)));  // FZ
#endif
  }
  ~HostileHost() { std::fesetenv(&saved_); }
  HostileHost(const HostileHost&) = delete;
  HostileHost& operator=(const HostileHost&) = delete;

 private:
  std::fenv_t saved_;
};

TEST(FloatEnvironment, PinsAndRestores) {
  const HostileHost host;
  ASSERT_FALSE(RoundsToNearest()) << "else this tests nothing";
#if defined(__x86_64__) || defined(__aarch64__)
  ASSERT_FALSE(KeepsSubnormals());
#endif
  const std::uint64_t before = ControlBits();
  {
    const FloatEnvironment pinned;
    EXPECT_TRUE(IsPinned());
    {
      const FloatEnvironment again;
      EXPECT_TRUE(IsPinned());
    }
    EXPECT_TRUE(IsPinned());
  }
  EXPECT_EQ(ControlBits(), before);
  EXPECT_FALSE(RoundsToNearest());
}

TEST(FloatEnvironment, HoldsInEveryTask) {
  for (const int threads : {1, 2, 8}) {
    const HostileHost host;
    const std::uint64_t before = ControlBits();
    std::atomic<int> loose{0}, tasks{0};
    RunWithThreads(threads, [&] {
      if (!IsPinned()) ++loose;
      ParallelFor(500, 1, [&](std::size_t, std::size_t) {
        ++tasks;
        if (!IsPinned()) ++loose;
        ParallelFor(3, 1, [&](std::size_t, std::size_t) {
          if (!IsPinned()) ++loose;
        });
        std::fesetround(FE_DOWNWARD);  // what a task changes, later ones do not see
      });
      if (!IsPinned()) ++loose;
    });
    EXPECT_EQ(loose, 0) << threads << " threads";
    EXPECT_EQ(tasks, 500);
    EXPECT_EQ(ControlBits(), before) << "the caller has its own environment back";
  }
}

TEST(FloatEnvironment, HoldsOutsideOfAnArena) {
  for (const std::size_t count : {1, 200}) {  // a single piece runs on the caller's thread
    const HostileHost host;
    const std::uint64_t before = ControlBits();
    std::atomic<int> loose{0};
    ParallelFor(count, 1, [&](std::size_t, std::size_t) {
      if (!IsPinned()) ++loose;
    });
    EXPECT_EQ(loose, 0);
    EXPECT_EQ(ControlBits(), before);
  }
}

TEST(FloatEnvironment, IsRestoredAfterAnException) {
  const HostileHost host;
  const std::uint64_t before = ControlBits();
  for (const std::size_t count : {1, 50}) {
    EXPECT_THROW(RunWithThreads(2,
                                [&] {
                                  ParallelFor(count, 1, [&](std::size_t, std::size_t) {
                                    throw Error(ErrorCode::Internal, "on purpose");
                                  });
                                }),
                 Error);
    EXPECT_EQ(ControlBits(), before);
  }
}

}  // namespace
}  // namespace facet
