#include "base/memory_budget.h"

#include <gtest/gtest.h>

#include <atomic>
#include <string>

#include "base/bytes_text.h"
#include "base/json_bounds.h"
#include "base/parallel.h"
#include "facet/error.h"

namespace facet {
namespace {

std::string Refusal(const auto& body) {
  try {
    body();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::OutOfMemory) << error.what();
    return error.what();
  }
  return {};
}

TEST(BytesText, HasOneDigitAfterThePoint) {
  EXPECT_EQ(BytesText(1536), "1.5 KiB");
  EXPECT_EQ(BytesText(512.0 * 1048576), "512.0 MiB");
  EXPECT_EQ(BytesText(16e12), "14901.2 GiB");
}

TEST(MemoryBudget, CountsTogetherAndNamesAll) {
  MemoryBudget budget(1 << 20);
  budget.Charge(1 << 19, 1, "a film", {}, "smaller");
  budget.Charge(1 << 9, 1 << 10, "geometry");
  EXPECT_EQ(budget.Left(), 0u);
  EXPECT_EQ(
      Refusal([&] { budget.Charge(2048, 1, "textures", "a.glb", "scale them down"); }),
      "a.glb: this needs 2.0 KiB for textures, 512.0 KiB for geometry, 512.0 KiB for a film, and the memory limit is "
      "1.0 MiB; scale them down, or raise the limit");
  budget.Release(1 << 19, "a film");
  budget.Charge(2048, 1, "textures");
  EXPECT_EQ(budget.Left(), (1u << 19) - 2048);
}

TEST(MemoryBudget, OneMoreByteIsTooMuch) {
  MemoryBudget budget(1000);
  budget.Charge(1000, 1, "a");
  EXPECT_NE(Refusal([&] { budget.Charge(1, 1, "a"); }), "");
  budget.Charge(0, 1, "b");
}

TEST(MemoryBudget, ProductsThatOverflowAreTooMuch) {
  MemoryBudget budget(~std::uint64_t{0} / 2);
  EXPECT_NE(Refusal([&] { budget.Charge(std::uint64_t{1} << 40, std::uint64_t{1} << 40, "a"); }), "");
  EXPECT_NE(Refusal([&] { budget.Charge(~std::uint64_t{0}, 2, "a"); }), "");
  EXPECT_EQ(budget.Left(), budget.limit());
}

TEST(MemoryBudget, FollowsTheMachineWhereNoneIsGiven) {
  const std::uint64_t limit = MemoryBudget(0).limit();
  EXPECT_EQ(limit, DefaultMemoryLimit());
  EXPECT_GT(limit, std::uint64_t{1} << 26);
  EXPECT_LT(limit, std::uint64_t{1} << 50);
}

TEST(MemoryBudget, IsTheCurrentOneOfItsScopeAndOfTheThreadsOfItsLoops) {
  MemoryBudget outer(1000), inner(100);
  {
    const MemoryBudget::Scope scope(outer);
    EXPECT_EQ(&MemoryBudget::Current(), &outer);
    {
      const MemoryBudget::Scope nested(inner);
      EXPECT_EQ(&MemoryBudget::Current(), &inner);
    }
    std::atomic<int> others = 0;
    RunWithThreads(4, [&] {
      ParallelFor(64, 1, [&](std::size_t, std::size_t) {
        others += &MemoryBudget::Current() != &outer;
        ParallelFor(8, 1, [&](std::size_t, std::size_t) { others += &MemoryBudget::Current() != &outer; });
      });
    });
    EXPECT_EQ(others, 0);
  }
  EXPECT_NE(&MemoryBudget::Current(), &outer);
}

// What is charged there belongs to nobody who would give it back.
TEST(MemoryBudget, NothingAddsUpOutsideOfScopes) {
  const std::uint64_t most = DefaultMemoryLimit();
  for (int i = 0; i < 10; ++i) MemoryBudget::Current().Charge(most, 1, "a");
  EXPECT_NE(Refusal([&] { MemoryBudget::Current().Charge(most + 1, 1, "a"); }), "");
}

TEST(MemoryLease, GivesBack) {
  MemoryBudget budget(100);
  const MemoryBudget::Scope scope(budget);
  {
    MemoryLease a(60, 1, "a");
    EXPECT_EQ(budget.Left(), 40u);
    EXPECT_NE(Refusal([] { MemoryLease(41, 1, "b"); }), "");
    MemoryLease moved = std::move(a);
    a = MemoryLease(10, 4, "b");
    EXPECT_EQ(budget.Left(), 0u);
    a = {};
    EXPECT_EQ(budget.Left(), 40u);
  }
  EXPECT_EQ(budget.Left(), 100u);
}

TEST(JsonDepth, CountsBracketsOutsideOfStrings) {
  EXPECT_FALSE(IsJsonDeeperThan("", 0));
  EXPECT_TRUE(IsJsonDeeperThan("[", 0));
  EXPECT_FALSE(IsJsonDeeperThan(R"({"a": [1, {"b": "]]}}[[[[{{{{"}]})", 3));
  EXPECT_TRUE(IsJsonDeeperThan(R"({"a": [1, {"b": []}]})", 3));
  EXPECT_FALSE(IsJsonDeeperThan(R"({"a\"[[[": "\\"})", 1));
  EXPECT_FALSE(IsJsonDeeperThan("[][][][][]", 1));
  EXPECT_TRUE(IsJsonDeeperThan(std::string(20000, '['), kMaxJsonDepth));
}

}  // namespace
}  // namespace facet
