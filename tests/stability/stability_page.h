// The generated part of docs/stability.md: how a case and a curve are shown.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "stability/stability_case.h"

namespace facet::stability {

inline constexpr char kPageBegin[] = "<!-- stability_table: begin -->";
inline constexpr char kPageEnd[] = "<!-- stability_table: end -->";

// A row without its figure: "| case | naive | facet |".
inline std::string RowHead(const Case& c) {
  return std::string("| ") + c.name + " | " + c.naive + " | " + c.facet + " |";
}

inline std::string CurveTitle(const Curve& c) { return std::string("### ") + c.name; }

// The lines between the marks.
inline std::vector<std::string> GeneratedLines(const std::string& page) {
  std::vector<std::string> lines;
  std::size_t at = page.find(kPageBegin);
  const std::size_t end = page.find(kPageEnd);
  if (at == std::string::npos || end == std::string::npos) return lines;
  while (at < end) {
    const std::size_t next = std::min(page.find('\n', at), end);
    lines.push_back(page.substr(at, next - at));
    at = next + 1;
  }
  return lines;
}

}  // namespace facet::stability
