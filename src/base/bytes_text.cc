#include "base/bytes_text.h"

#include <cstdio>

namespace facet {

std::string BytesText(double bytes) {
  constexpr double kKi = 1024.0;
  const char* const units[] = {"KiB", "MiB", "GiB"};
  int unit = 0;
  for (bytes /= kKi; bytes >= kKi && unit < 2; bytes /= kKi) ++unit;
  char text[64];
  std::snprintf(text, sizeof text, "%.1f %s", bytes, units[unit]);
  return text;
}

}  // namespace facet
