// What a loader has to say about a file that it reads nevertheless.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <unordered_set>
#include <vector>

namespace facet::gltf {

class Warnings {
 public:
  // `place` is "accessors[3].count", or empty. The same mistake in several places is one line, which names the first
  // and counts the others: what an exporter does wrong, it does wrong everywhere.
  void Add(const std::string& place, const std::string& what);

  // In the order in which they came; of more than kMostLines mistakes the last line says how many there are.
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
