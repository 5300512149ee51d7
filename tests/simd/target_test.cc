#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "facet/error.h"
#include "facet/shader/dispatch.h"
#include "hwy/detect_targets.h"

namespace facet {
namespace {

constexpr Target kTargets[] = {Target::Scalar, Target::Sse4, Target::Avx2, Target::Avx3, Target::Neon};

Target Best() {
  Target best = Target::Scalar;
  for (const Target target : kTargets) {
    if (TargetIsAvailable(target)) best = target;
  }
  return best;
}

TEST(Target, Names) {
  const std::vector<std::string> names = {"SCALAR", "SSE4", "AVX2", "AVX3", "NEON"};
  for (std::size_t i = 0; i < names.size(); ++i) EXPECT_EQ(TargetName(kTargets[i]), names[i]);
}

TEST(Target, LargerOnesIncludeSmallerOnes) {
  EXPECT_TRUE(TargetIsAvailable(Target::Scalar));
  // Of those that the build has: FACET_DISABLED_TARGETS may leave out any.
  if ((HWY_TARGETS & HWY_AVX2) != 0) {
    EXPECT_LE(TargetIsAvailable(Target::Avx3), TargetIsAvailable(Target::Avx2));
  }
  if ((HWY_TARGETS & HWY_SSE4) != 0) {
    EXPECT_LE(TargetIsAvailable(Target::Avx2), TargetIsAvailable(Target::Sse4));
  }
  EXPECT_FALSE(TargetIsAvailable(Target::Sse4) && TargetIsAvailable(Target::Neon));
}

TEST(Target, ScopesNestAndEnd) {
  const Target outside = ActiveTarget();
  {
    const ScopedTarget scalar(Target::Scalar);
    EXPECT_EQ(ActiveTarget(), Target::Scalar);
    {
      const ScopedTarget best(Best());
      EXPECT_EQ(ActiveTarget(), Best());
    }
    EXPECT_EQ(ActiveTarget(), Target::Scalar);
  }
  EXPECT_EQ(ActiveTarget(), outside);
}

TEST(Target, KernelsFallBackToTheScalarOne) {
  using Function = int (*)();
  const Function scalar = [] { return 0; }, avx2 = [] { return 2; };
  const auto choose = [&](Target target) {
    return ChooseKernel<Function>(target, scalar, nullptr, avx2, nullptr, nullptr)();
  };
  EXPECT_EQ(choose(Target::Scalar), 0);
  EXPECT_EQ(choose(Target::Sse4), 0);
  EXPECT_EQ(choose(Target::Avx2), 2);
  EXPECT_EQ(choose(Target::Avx3), 0);
  EXPECT_EQ(choose(Target::Neon), 0);
}

// The environment is read once in a process, so each case has one of its own: it prints the target and ends with 0, or
// with the error's exit code. (Death tests, because they start processes; nothing dies.)
[[noreturn]] void PrintActiveTarget(const char* variable) {
  if (variable == nullptr) {
    unsetenv("FACET_TARGET");
  } else {
    setenv("FACET_TARGET", variable, 1);
  }
  try {
    const ScopedTarget forced(Target::Scalar);  // does not read the variable
    if (ActiveTarget() != Target::Scalar) std::exit(100);
  } catch (const Error&) {
    std::exit(101);
  }
  try {
    std::fprintf(stderr, "[%s]", TargetName(ActiveTarget()));
    std::exit(0);
  } catch (const Error& error) {
    std::fprintf(stderr, "[%s]", error.what());
    std::exit(ExitCode(error.code()));
  }
}

TEST(TargetDeathTest, IsNamedByTheEnvironment) {
  ::testing::GTEST_FLAG(death_test_style) = "threadsafe";
  for (const Target target : kTargets) {
    const std::string name = TargetName(target);
    if (TargetIsAvailable(target)) {
      EXPECT_EXIT(PrintActiveTarget(name.c_str()), ::testing::ExitedWithCode(0), "\\[" + name + "\\]");
    } else {
      EXPECT_EXIT(PrintActiveTarget(name.c_str()), ::testing::ExitedWithCode(2), "\\[FACET_TARGET: .*lacks.* " + name);
    }
  }
}

TEST(TargetDeathTest, IsTheBestWithoutTheEnvironment) {
  ::testing::GTEST_FLAG(death_test_style) = "threadsafe";
  const std::string best = std::string("\\[") + TargetName(Best()) + "\\]";
  EXPECT_EXIT(PrintActiveTarget(nullptr), ::testing::ExitedWithCode(0), best);
  EXPECT_EXIT(PrintActiveTarget(""), ::testing::ExitedWithCode(0), best);
}

TEST(TargetDeathTest, UnknownNamesAreRefused) {
  ::testing::GTEST_FLAG(death_test_style) = "threadsafe";
  for (const std::string name : {"avx2", "AVX", "AVX2 ", "MMX"}) {
    EXPECT_EXIT(PrintActiveTarget(name.c_str()), ::testing::ExitedWithCode(2),
                "\\[FACET_TARGET: unknown instruction set '" + name + "'; use SCALAR, SSE4, AVX2, AVX3 or NEON\\]");
  }
}

}  // namespace
}  // namespace facet
