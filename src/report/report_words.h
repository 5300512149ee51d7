// The numbers of an error report in words.
#pragma once

#include <cstdint>
#include <string>

#include "facet/report.h"

namespace facet {

// "max-anisotropy=1 samples=2"; "the settings asked for" where nothing is changed.
std::string SettingsWords(const SettingsText& changed);

// Three digits and a unit: "41.3 ms", "1.2 GiB"; "not known" for what is no number.
std::string TimeWords(double seconds);
std::string BytesWords(double bytes);

// Three digits: "0.0312", "4.2·10⁻⁷"; "not known" for what is no number.
std::string ErrorWords(double error);

// "10⁻⁷"
std::string PowerOfTen(int exponent);

// 1234567 as "1,234,567".
std::string Grouped(std::uint64_t value);

}  // namespace facet
