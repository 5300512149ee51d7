// RenderSettings::memory_limit: what is known to be needed is added up before any of it is allocated.
#pragma once

#include <cstdint>
#include <string>

namespace facet {

class MemoryBudget {
 public:
  // `limit`: bytes; 0: none.
  explicit MemoryBudget(std::uint64_t limit) : limit_(limit) {}

  // Counts `bytes` for `what`, such as "textures". Throws Error(OutOfMemory) where all that was counted is beyond the
  // limit; the message lists it, and `remedy` says what takes less.
  void Add(std::uint64_t bytes, const std::string& what, const std::string& remedy);

 private:
  std::uint64_t limit_, sum_ = 0;
  std::string list_;
};

}  // namespace facet
