#include "gltf/warnings.h"

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
  if (!said_.insert(line).second) return;
  const std::string kind = place.empty() ? line : WithoutIndices(place) + ": " + what;
  const auto [known, is_new] = mistake_of_kind_.try_emplace(kind, mistakes_.size());
  if (is_new) {
    mistakes_.push_back({line});
  } else {
    ++mistakes_[known->second].more;
  }
}

std::vector<std::string> Warnings::Lines() const {
  std::vector<std::string> lines;
  for (const Mistake& mistake : mistakes_) {
    const std::string more = std::to_string(mistake.more) + (mistake.more == 1 ? " more place" : " more places");
    lines.push_back(mistake.more == 0 ? mistake.line : mistake.line + " (and in " + more + ")");
  }
  return lines;
}

}  // namespace facet::gltf
