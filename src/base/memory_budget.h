// What a piece of work may take in memory. Whatever grows with the input is charged here before it is allocated, so
// that a file of a few bytes cannot ask for more than the limit: it is refused with the amount that it asks for.
#pragma once

#include <cstdint>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace facet {

// Three quarters of what this process may have: of the machine's memory, or of the least limit that its control groups
// and its resource limits set.
std::uint64_t DefaultMemoryLimit();

// Thread-safe.
class MemoryBudget {
 public:
  // `limit`: bytes; 0: DefaultMemoryLimit().
  explicit MemoryBudget(std::uint64_t limit);
  MemoryBudget(const MemoryBudget&) = delete;
  MemoryBudget& operator=(const MemoryBudget&) = delete;

  // Counts `count` times `size_each` bytes for `what`, such as "textures". Throws Error(OutOfMemory) where all that is
  // counted would be beyond the limit, and counts nothing then; the message lists it, the latest first. `where`: what
  // asks for them. `remedy`: what takes less; may be empty.
  void Charge(std::uint64_t count, std::uint64_t size_each, std::string_view what, const std::string& where = {},
              const std::string& remedy = {});

  // Takes back as much of what was charged for `what`.
  void Release(std::uint64_t bytes, std::string_view what) noexcept;

  std::uint64_t limit() const { return limit_; }
  std::uint64_t Left() const;

  // What the current thread works under; ParallelFor passes it on to its threads. Outside of all scopes nothing is
  // added up: each request by itself must be within DefaultMemoryLimit().
  static MemoryBudget& Current();

  // Makes a budget that of the current thread for as long as the scope lives.
  class Scope {
   public:
    explicit Scope(MemoryBudget& budget);
    ~Scope();
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;

   private:
    MemoryBudget* const before_;
  };

 private:
  const std::uint64_t limit_;
  bool adds_up_ = true;
  mutable std::mutex mutex_;
  std::uint64_t sum_ = 0;
  std::vector<std::pair<std::string, std::uint64_t>> parts_;  // what for, and how much, in the order of first charges
};

// Charges the current budget, which must outlive it, for as long as it lives: for what is needed for a time.
class MemoryLease {
 public:
  MemoryLease() = default;
  MemoryLease(std::uint64_t count, std::uint64_t size_each, std::string_view what, const std::string& where = {},
              const std::string& remedy = {});
  ~MemoryLease();
  // Takes over what has been charged for `what`.
  static MemoryLease Adopt(std::uint64_t bytes, std::string_view what);
  MemoryLease(MemoryLease&& other) noexcept;
  MemoryLease& operator=(MemoryLease&& other) noexcept;

 private:
  MemoryBudget* budget_ = nullptr;
  std::uint64_t bytes_ = 0;
  std::string what_;
};

}  // namespace facet
