#include "gltf/warnings.h"

#include <functional>

namespace facet::gltf {
namespace {

// "accessors[3].count" to "accessors[].count".
std::string WithoutIndices(const std::string& place) {
  std::string kind;
  bool in_index = false;
  for (const char c : place) {
    in_index = c == '[' || (in_index && c != ']');
    if (!in_index || c == '[') kind += c;
  }
  return kind;
}

}  // namespace

void Warnings::Add(const std::string& place, const std::string& what) {
  const std::string line = place.empty() ? what : place + ": " + what;
  const std::size_t hash = std::hash<std::string>()(line);
  if (said_.size() < kMostSaid ? !said_.insert(hash).second : said_.count(hash) != 0) return;
  const std::string kind = place.empty() ? line : WithoutIndices(place) + ": " + what;
  const auto known = mistake_of_kind_.find(kind);
  if (known != mistake_of_kind_.end()) {
    ++mistakes_[known->second].more;
  } else if (mistakes_.size() == kMostLines) {
    ++beyond_;
  } else {
    mistake_of_kind_.emplace(kind, mistakes_.size());
    mistakes_.push_back({line});
  }
}

std::vector<std::string> Warnings::Lines() const {
  std::vector<std::string> lines;
  for (const Mistake& mistake : mistakes_) {
    const std::string more = std::to_string(mistake.more) + (mistake.more == 1 ? " more place" : " more places");
    lines.push_back(mistake.more == 0 ? mistake.line : mistake.line + " (and in " + more + ")");
  }
  if (beyond_ != 0) lines.push_back(std::to_string(beyond_) + " more warnings");
  return lines;
}

}  // namespace facet::gltf
