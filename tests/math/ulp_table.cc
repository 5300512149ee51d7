// Prints the largest error of each float function over all floats of its domain (minutes), and a search for Pow, Atan2
// and the double functions. `ulp_table 257` takes every 257th float.
#include <bit>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <random>

#include "math/elementary.h"
#include "math/float_functions.h"
#include "math/ulp.h"

using namespace facet::testing;

namespace {

void Row(const char* name, double worst, double at, double at2 = 0.0) {
  std::printf("%-14s %8.4f ULP at %a %a\n", name, worst, at, at2);
}

template <class Function, class Exact>
void SearchDouble(const char* name, Function function, Exact exact, double low, double high) {
  std::mt19937_64 random(1);
  double worst = 0.0, at = 0.0;
  for (int i = 0; i < 2000000; ++i) {
    // Half of them uniform, half uniform in their bits.
    const double unit = static_cast<double>(random() >> 11) * 0x1p-53;
    double x = low + (high - low) * unit;
    if (i % 2 != 0) {
      x = std::bit_cast<double>(random());
      if (!(x >= low && x <= high)) continue;
    }
    const double error = UlpError(function(x), exact(static_cast<long double>(x)));
    if (error > worst) worst = error, at = x;
  }
  Row(name, worst, at);
}

}  // namespace

int main(int argc, char** argv) {
  const std::uint64_t stride = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 1;
  for (const FloatFunction& f : FloatFunctions()) {
    double worst = 0.0, at = 0.0;
    for (std::uint64_t bits = 0; bits < (std::uint64_t{1} << 32); bits += stride) {
      const float x = std::bit_cast<float>(static_cast<std::uint32_t>(bits));
      if (std::fabs(x) > f.domain) continue;
      const double error = UlpError(f.function(x), f.exact(x));
      if (error > worst) worst = error, at = x;
    }
    Row(f.name, worst, at);
  }
  std::mt19937_64 random(1);
  double worst_pow = 0.0, pow_x = 0.0, pow_y = 0.0, worst_atan2 = 0.0, atan2_y = 0.0, atan2_x = 0.0;
  for (std::uint64_t i = 0; i < 200000000u / stride + 1000000u; ++i) {
    const std::uint64_t bits = random();
    const float x = std::bit_cast<float>(static_cast<std::uint32_t>(bits) & 0x7FFFFFFFu);
    // y for a result within the range of float, three times out of four.
    float y = std::bit_cast<float>(static_cast<std::uint32_t>(bits >> 32));
    if (i % 4 != 0)
      y = static_cast<float>(static_cast<double>(y >= 0 ? 1 : -1) * static_cast<double>(bits >> 33) * 0x1p-31 * 150.0 /
                             std::log2(x));
    double error = UlpError(FloatPow(x, y), std::pow(static_cast<double>(x), static_cast<double>(y)));
    if (error > worst_pow) worst_pow = error, pow_x = x, pow_y = y;
    const float b = i % 2 == 0 ? y : x * static_cast<float>(1.0 + static_cast<double>(bits >> 40) * 0x1p-24);
    error = UlpError(FloatAtan2(b, x), std::atan2(static_cast<double>(b), static_cast<double>(x)));
    if (error > worst_atan2) worst_atan2 = error, atan2_y = b, atan2_x = x;
    error = UlpError(FloatAtan2(x, -b), std::atan2(static_cast<double>(x), static_cast<double>(-b)));
    if (error > worst_atan2) worst_atan2 = error, atan2_y = x, atan2_x = -b;
  }
  Row("Pow", worst_pow, pow_x, pow_y);
  Row("Atan2", worst_atan2, atan2_y, atan2_x);

  const double kMax = std::numeric_limits<double>::max();
  using Extended = long double;
  SearchDouble(
      "double Exp2", facet::Exp2, [](Extended x) { return std::exp2(x); }, -1080.0, 1030.0);
  SearchDouble(
      "double Exp", facet::Exp, [](Extended x) { return std::exp(x); }, -750.0, 720.0);
  SearchDouble(
      "double Log2", facet::Log2, [](Extended x) { return std::log2(x); }, 0.0, 4.0);
  SearchDouble(
      "double Log2", facet::Log2, [](Extended x) { return std::log2(x); }, 0.0, kMax);
  SearchDouble(
      "double Log", facet::Log, [](Extended x) { return std::log(x); }, 0.0, 4.0);
  SearchDouble(
      "double Log", facet::Log, [](Extended x) { return std::log(x); }, 0.0, kMax);
  SearchDouble(
      "double Cbrt", facet::Cbrt, [](Extended x) { return std::cbrt(x); }, -kMax / 2, kMax / 2);
  SearchDouble(
      "double Sin", facet::Sin, [](Extended x) { return std::sin(x); }, -10.0, 10.0);
  SearchDouble(
      "double Sin", facet::Sin, [](Extended x) { return std::sin(x); }, -1e18, 1e18);
  SearchDouble(
      "double Cos", facet::Cos, [](Extended x) { return std::cos(x); }, -10.0, 10.0);
  SearchDouble(
      "double Cos", facet::Cos, [](Extended x) { return std::cos(x); }, -kMax / 2, kMax / 2);
  SearchDouble(
      "double Tan", facet::Tan, [](Extended x) { return std::tan(x); }, -10.0, 10.0);
  SearchDouble(
      "double Tan", facet::Tan, [](Extended x) { return std::tan(x); }, -1e300, 1e300);
  SearchDouble(
      "double Asin", facet::Asin, [](Extended x) { return std::asin(x); }, -1.0, 1.0);
  SearchDouble(
      "double Acos", facet::Acos, [](Extended x) { return std::acos(x); }, -1.0, 1.0);
  const auto atan = [](Extended x) { return std::atan(x); };
  SearchDouble(
      "double Atan2", [](double x) { return facet::Atan2(x, 1.0); }, atan, -5.0, 5.0);
  SearchDouble(
      "double Atan2", [](double x) { return facet::Atan2(x, 1.0); }, atan, -kMax / 2, kMax / 2);
  for (const double y : {0.3, 2.4, 7.0, -11.3, 100.5, 1.0 / 3.0}) {
    SearchDouble(
        "double Pow", [y](double x) { return facet::Pow(x, y); },
        [y](Extended x) { return std::pow(x, static_cast<Extended>(y)); }, 0.0, 1000.0);
  }
}
