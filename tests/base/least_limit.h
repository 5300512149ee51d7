// What a piece of work is charged, seen from outside: the least memory limit under which it is done.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <string>

#include "base/memory_budget.h"
#include "facet/error.h"

namespace facet {

// What `work` says where it is refused for want of memory; empty where it is done.
template <class Work>
std::string MemoryRefusal(const Work& work) {
  try {
    work();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::OutOfMemory) << error.what();
    return error.what();
  }
  return {};
}

// The same of work that charges the current budget.
template <class Work>
std::string MemoryRefusalUnder(std::uint64_t limit, const Work& work) {
  MemoryBudget budget(limit);
  const MemoryBudget::Scope scope(budget);
  return MemoryRefusal(work);
}

// The least limit that `work`, called with a limit, accepts.
template <class Work>
std::uint64_t LeastLimit(const Work& work) {
  std::uint64_t refused = 1, accepted = std::uint64_t{1} << 31;
  EXPECT_EQ(MemoryRefusal([&] { work(accepted); }), "");
  while (accepted - refused > 1) {
    const std::uint64_t middle = refused + (accepted - refused) / 2;
    (MemoryRefusal([&] { work(middle); }).empty() ? accepted : refused) = middle;
  }
  return accepted;
}

}  // namespace facet
