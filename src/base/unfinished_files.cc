#include "base/unfinished_files.h"

#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <climits>
#include <cstring>
#include <string>
#include <system_error>

namespace facet {
namespace {

// A handler may run at any moment, on any thread, so that names lie in memory that is never freed.
enum class SlotState : int { Free, BeingWritten, Used };
struct Slot {
  std::atomic<SlotState> state{SlotState::Free};
  char path[PATH_MAX];
};
std::array<Slot, 256> slots;
std::atomic<bool> ending = false;
static_assert(std::atomic<SlotState>::is_always_lock_free && std::atomic<bool>::is_always_lock_free);

}  // namespace

UnfinishedFile::UnfinishedFile(const std::filesystem::path& path) {
  std::error_code ignored;
  // Absolute: the process may change its folder meanwhile.
  const std::string name = std::filesystem::absolute(path, ignored).string();
  if (name.size() >= sizeof(Slot::path)) return;
  for (std::size_t i = 0; i < slots.size(); ++i) {
    SlotState free = SlotState::Free;
    if (!slots[i].state.compare_exchange_strong(free, SlotState::BeingWritten)) continue;
    std::memcpy(slots[i].path, name.c_str(), name.size() + 1);
    slots[i].state = SlotState::Used;
    slot_ = static_cast<int>(i);
    break;
  }
  while (ending) ::pause();
}

void UnfinishedFile::WasMade() const {
  if (!ending) return;
  if (slot_ >= 0) ::unlink(slots[static_cast<std::size_t>(slot_)].path);
  for (;;) ::pause();
}

UnfinishedFile::~UnfinishedFile() {
  if (slot_ >= 0) slots[static_cast<std::size_t>(slot_)].state = SlotState::Free;
}

void RemoveUnfinishedFiles() noexcept {
  const int error = errno;
  ending = true;
  for (const Slot& slot : slots) {
    if (slot.state == SlotState::Used) ::unlink(slot.path);
  }
  errno = error;
}

}  // namespace facet
