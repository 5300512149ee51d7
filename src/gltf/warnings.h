// The warnings of a loader about a file that it can read nevertheless.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <unordered_set>
#include <vector>

namespace facet::gltf {

class Warnings {
 public:
  // Adds a warning. `place` is like "accessors[3].count", or empty. The same mistake in several places, whatever the
  // numbers that the warning states, becomes one line that has the first and counts the others, because exporters
  // repeat their mistakes.
  void Add(const std::string& place, const std::string& what);

  // All lines, in the order of the first warnings. If there are more than kMostLines, the last line states the number
  // of the others.
  std::vector<std::string> Lines() const;

 private:
  static constexpr std::size_t kMostLines = 200, kMostSaid = 100000;

  struct Mistake {
    std::string line;
    std::size_t more = 0;
  };
  std::vector<Mistake> mistakes_;
  std::map<std::string, std::size_t> mistake_of_kind_;
  std::unordered_set<std::size_t> said_;  // hashes of the first lines
  std::size_t beyond_ = 0;                // mistakes that have no line
};

}  // namespace facet::gltf
