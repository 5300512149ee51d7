// A limit on the memory of a piece of work. All memory that grows with the input is charged to a budget before it is
// allocated, so that a small file cannot cause allocations beyond the limit: it is refused, and the message says how
// much it would take.
#pragma once

#include <cstdint>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace facet {

// Three quarters of the memory that this process may use: of the machine's memory, or of the smallest limit of its
// control groups and resource limits.
std::uint64_t DefaultMemoryLimit();

// Thread-safe.
class MemoryBudget {
 public:
  // `limit`: bytes; 0: DefaultMemoryLimit().
  explicit MemoryBudget(std::uint64_t limit);
  MemoryBudget(const MemoryBudget&) = delete;
  MemoryBudget& operator=(const MemoryBudget&) = delete;

  // Charges `count` times `size_each` bytes for `what`, such as "textures". If the sum would exceed the limit, charges
  // nothing and throws Error(OutOfMemory) with a message that lists all charges, the latest first. `where`: the file or
  // object that needs the memory. `remedy`: what would take less memory; may be empty.
  void Charge(std::uint64_t count, std::uint64_t size_each, std::string_view what, const std::string& where = {},
              const std::string& remedy = {});

  // Releases bytes that were charged for `what`.
  void Release(std::uint64_t bytes, std::string_view what) noexcept;

  std::uint64_t limit() const { return limit_; }
  std::uint64_t Left() const;

  // The budget of the current thread; ParallelFor() passes it on to its threads. Outside of all scopes charges are not
  // summed: each must be within DefaultMemoryLimit() by itself.
  static MemoryBudget& Current();

  // Makes `budget` the current one of this thread during the lifetime of the scope.
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
  std::vector<std::pair<std::string, std::uint64_t>> parts_;  // purpose and bytes, in the order of the first charges
};

// Charges the current budget, which must outlive it, during its lifetime. For memory that is needed temporarily.
class MemoryLease {
 public:
  MemoryLease() = default;
  MemoryLease(std::uint64_t count, std::uint64_t size_each, std::string_view what, const std::string& where = {},
              const std::string& remedy = {});
  ~MemoryLease();
  // A lease of bytes that have been charged for `what` before.
  static MemoryLease Adopt(std::uint64_t bytes, std::string_view what);
  MemoryLease(MemoryLease&& other) noexcept;
  MemoryLease& operator=(MemoryLease&& other) noexcept;

 private:
  MemoryBudget* budget_ = nullptr;
  std::uint64_t bytes_ = 0;
  std::string what_;
};

}  // namespace facet
