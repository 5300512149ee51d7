#include "base/memory_budget.h"

#include <algorithm>
#include <limits>

#include "base/bytes_text.h"
#include "facet/error.h"

namespace facet {
namespace {

thread_local MemoryBudget* current = nullptr;

constexpr std::uint64_t kMost = std::numeric_limits<std::uint64_t>::max();

std::uint64_t Product(std::uint64_t a, std::uint64_t b) { return b != 0 && a > kMost / b ? kMost : a * b; }

}  // namespace

MemoryBudget::MemoryBudget(std::uint64_t limit) : limit_(limit > 0 ? limit : DefaultMemoryLimit()) {}

void MemoryBudget::Charge(std::uint64_t count, std::uint64_t size_each, std::string_view what, const std::string& where,
                          const std::string& remedy) {
  const std::uint64_t bytes = Product(count, size_each);
  const std::lock_guard lock(mutex_);
  auto part = std::find_if(parts_.begin(), parts_.end(), [&](const auto& known) { return known.first == what; });
  if (bytes <= limit_ - sum_ && bytes != kMost) {
    if (!adds_up_) return;
    if (part == parts_.end()) part = parts_.emplace(part, what, 0);
    part->second += bytes;
    sum_ += bytes;
    return;
  }
  const std::uint64_t before = part == parts_.end() ? 0 : part->second;
  const auto text = [](std::uint64_t amount, std::string_view use) {
    return BytesText(double(amount)) + " for " + std::string(use);
  };
  // The current request comes first, since the remedy refers to it.
  std::string list = text(bytes > kMost - before ? kMost : before + bytes, what);
  for (auto other = parts_.rbegin(); other != parts_.rend(); ++other) {
    if (other->first != what) list += ", " + text(other->second, other->first);
  }
  throw Error(ErrorCode::OutOfMemory, "this needs " + list + ", and the memory limit is " + BytesText(double(limit_)),
              where, (remedy.empty() ? "" : remedy + ", or ") + std::string("raise the limit"));
}

void MemoryBudget::Release(std::uint64_t bytes, std::string_view what) noexcept {
  const std::lock_guard lock(mutex_);
  const auto part = std::find_if(parts_.begin(), parts_.end(), [&](const auto& known) { return known.first == what; });
  if (part == parts_.end()) return;
  const std::uint64_t taken = std::min(bytes, part->second);
  part->second -= taken;
  sum_ -= taken;
  if (part->second == 0) parts_.erase(part);
}

std::uint64_t MemoryBudget::Left() const {
  const std::lock_guard lock(mutex_);
  return limit_ - sum_;
}

MemoryBudget& MemoryBudget::Current() {
  static MemoryBudget& of_process = [&]() -> MemoryBudget& {
    static MemoryBudget budget(0);
    budget.adds_up_ = false;
    return budget;
  }();
  return current != nullptr ? *current : of_process;
}

MemoryBudget::Scope::Scope(MemoryBudget& budget) : before_(current) { current = &budget; }

MemoryBudget::Scope::~Scope() { current = before_; }

MemoryLease::MemoryLease(std::uint64_t count, std::uint64_t size_each, std::string_view what, const std::string& where,
                         const std::string& remedy)
    : what_(what) {
  MemoryBudget& budget = MemoryBudget::Current();
  budget.Charge(count, size_each, what, where, remedy);
  budget_ = &budget;
  bytes_ = count * size_each;
}

MemoryLease MemoryLease::Adopt(std::uint64_t bytes, std::string_view what) {
  MemoryLease lease;
  lease.budget_ = &MemoryBudget::Current();
  lease.bytes_ = bytes;
  lease.what_ = what;
  return lease;
}

MemoryLease::~MemoryLease() {
  if (budget_ != nullptr) budget_->Release(bytes_, what_);
}

MemoryLease::MemoryLease(MemoryLease&& other) noexcept
    : budget_(std::exchange(other.budget_, nullptr)), bytes_(other.bytes_), what_(std::move(other.what_)) {}

MemoryLease& MemoryLease::operator=(MemoryLease&& other) noexcept {
  std::swap(budget_, other.budget_);
  std::swap(bytes_, other.bytes_);
  std::swap(what_, other.what_);
  return *this;
}

}  // namespace facet
