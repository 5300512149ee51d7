// DefaultMemoryLimit(): the memory of the machine, or of the container in which this process runs.
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>

#include "base/memory_budget.h"

namespace facet {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kNone = std::numeric_limits<std::uint64_t>::max();

std::uint64_t OfMachine() {
  const long pages = ::sysconf(_SC_PHYS_PAGES), page_size = ::sysconf(_SC_PAGESIZE);
  return pages > 0 && page_size > 0 ? std::uint64_t(pages) * std::uint64_t(page_size) : kNone;
}

// Reads a limit. "max" and missing files mean that there is none.
std::uint64_t NumberIn(const fs::path& path) {
  std::ifstream file(path);
  std::uint64_t number = 0;
  return file >> number ? number : kNone;
}

// The smallest limit of a control group and its ancestors. In a container whose group appears as the root, the group's
// own folder is not visible; therefore folders on the way may be missing.
std::uint64_t OfGroup(const fs::path& root, const std::string& group, const char* file) {
  std::uint64_t least = NumberIn(root / file);
  fs::path folder = root;
  for (const fs::path& part : fs::path(group).relative_path()) {
    folder /= part;
    least = std::min(least, NumberIn(folder / file));
  }
  return least;
}

// /proc/self/cgroup has lines "0::/GROUP" for version 2 and "NUMBER:CONTROLLERS:/GROUP" for version 1; see cgroups(7).
std::uint64_t OfControlGroups() {
  std::uint64_t least = kNone;
  std::ifstream groups("/proc/self/cgroup");
  for (std::string line; std::getline(groups, line);) {
    const std::size_t first = line.find(':'), second = line.find(':', first + 1);
    if (second == std::string::npos) continue;
    std::string controllers = line.substr(first, second + 1 - first);  // ":cpu,memory:"
    std::replace(controllers.begin(), controllers.end(), ':', ',');
    const std::string group = line.substr(second + 1);
    if (controllers == ",,") {
      least = std::min(least, OfGroup("/sys/fs/cgroup", group, "memory.max"));
    } else if (controllers.find(",memory,") != std::string::npos) {
      least = std::min(least, OfGroup("/sys/fs/cgroup/memory", group, "memory.limit_in_bytes"));
    }
  }
  return least;
}

std::uint64_t OfProcess() {
  std::uint64_t least = kNone;
  for (const auto resource : {RLIMIT_AS, RLIMIT_DATA}) {
    rlimit limit{};
    if (::getrlimit(resource, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY) {
      least = std::min<std::uint64_t>(least, limit.rlim_cur);
    }
  }
  return least;
}

}  // namespace

std::uint64_t DefaultMemoryLimit() {
  static const std::uint64_t limit = [] {
    const std::uint64_t all = std::min({OfMachine(), OfControlGroups(), OfProcess()});
    return all / 4 * 3;
  }();
  return limit;
}

}  // namespace facet
