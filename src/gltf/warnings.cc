#include "gltf/warnings.h"

#include <cctype>
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

// "factor 1.5 is out of range" to "factor # is out of range": the same mistake may have many values. Digits of names,
// such as TEXCOORD_1, stay.
std::string WithoutNumbers(const std::string& what) {
  const auto is = [&](auto matches, std::size_t i) { return i < what.size() && matches(what[i]); };
  const auto digit = [](unsigned char c) { return std::isdigit(c) != 0; };
  const auto of_name = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; };
  const auto sign = [](unsigned char c) { return c == '-' || c == '+'; };
  std::string kind;
  for (std::size_t i = 0; i < what.size();) {
    const bool begins = !(i > 0 && of_name(static_cast<unsigned char>(what[i - 1])));
    if (!begins || !is(digit, i + (is(sign, i) ? 1 : 0))) {
      kind += what[i++];
      continue;
    }
    kind += '#';
    if (is(sign, i)) ++i;
    while (is(digit, i)) ++i;
    if (is([](char c) { return c == '.'; }, i) && is(digit, i + 1)) {
      for (++i; is(digit, i);) ++i;
    }
    if (is([](char c) { return c == 'e'; }, i) && is(digit, i + (is(sign, i + 1) ? 2 : 1))) {
      for (i += is(sign, i + 1) ? 2 : 1; is(digit, i);) ++i;
    }
  }
  return kind;
}

}  // namespace

void Warnings::Add(const std::string& place, const std::string& what) {
  const std::string line = place.empty() ? what : place + ": " + what;
  const std::size_t hash = std::hash<std::string>()(line);
  if (said_.size() < kMostSaid ? !said_.insert(hash).second : said_.count(hash) != 0) return;
  const std::string kind = WithoutIndices(place) + ": " + WithoutNumbers(what);
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
