// Formats numbers for messages and reports, independently of the locale.
#pragma once

#include <cstdint>
#include <string>

namespace facet {

// With six significant digits, or another number of them: "0.0312", "1e-07", "inf".
std::string ShortNumber(double value, int digits = 6);

// With three digits and a unit: "41.3 ms", "1.2 GiB"; "not known" for NaN.
std::string TimeWords(double seconds);
std::string BytesWords(double bytes);

// With three digits: "0.0312", "4.2·10⁻⁷"; "not known" for NaN.
std::string ErrorWords(double error);

// "10⁻⁷"
std::string PowerOfTen(int exponent);

// 1234567 as "1,234,567".
std::string Grouped(std::uint64_t value);

}  // namespace facet
