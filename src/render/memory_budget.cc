#include "render/memory_budget.h"

#include "base/bytes_text.h"
#include "facet/error.h"

namespace facet {

void MemoryBudget::Add(std::uint64_t bytes, const std::string& what, const std::string& remedy) {
  sum_ += bytes;
  // The latest first: it is what the remedy is about.
  list_ = BytesText(double(bytes)) + " for " + what + (list_.empty() ? "" : ", ") + list_;
  if (limit_ == 0 || sum_ <= limit_) return;
  throw Error(ErrorCode::OutOfMemory, "this needs " + list_ + ", and the memory limit is " + BytesText(double(limit_)),
              {}, remedy + ", or raise the limit");
}

}  // namespace facet
