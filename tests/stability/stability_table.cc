// Prints the table and the curves of docs/stability.md, measured: stability_table [--csv | --update FILE].
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <functional>
#include <iostream>
#include <sstream>

#include "stability/stability_page.h"

namespace facet::stability {
namespace {

std::string Short(double value, int digits = 2) {
  char text[40];
  std::snprintf(text, sizeof text, "%.*g", digits, value);
  return text;
}

std::string Figure(double value) { return value == 0.0 ? "0" : std::isinf(value) ? "∞" : Short(value); }

// Most memory that the process ever had, in MiB.
double PeakMebibytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return double(usage.ru_maxrss) / 1024.0;
}

double SecondsOf(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::string Markdown() {
  std::ostringstream out;
  const char* family = "";
  std::uint64_t cases = 0, images = 0, sanitised = 0;
  for (const Case& c : AllCases()) {
    if (std::strcmp(family, c.family) != 0) {
      family = c.family;
      out << "\n**" << family
          << "**\n\n| case | what goes wrong in a naive renderer | what facet does | measured worst error "
          << "| of a naive formula | bound | unit |\n|---|---|---|---|---|---|---|\n";
    }
    const Measured m = c.measure();
    ++cases, images += m.images, sanitised += m.sanitised;
    for (const std::string& failure : m.failures) std::cerr << c.name << ": " << failure << "\n";
    out << RowHead(c) << " " << (m.skipped.empty() ? Figure(m.worst) : "not measured") << " | "
        << (m.naive ? Figure(*m.naive) : "") << " | " << Figure(c.bound) << " | " << c.unit << " |\n";
  }
  out << "\n"
      << cases << " cases, " << images << " pictures on each instruction set; " << sanitised
      << " fragments were not finite, became black and were counted, all of them in the\ncase of lights that "
         "overflow.\n";
  out << "\n## Curves\n\nSeconds and memory are those of the machine that wrote this page: all pictures of a point, "
         "each "
      << "on every\ninstruction set. Memory is the most that the program had until then.\n";
  for (const Curve& c : AllCurves()) {
    const bool counts = *c.counted != '\0';
    out << "\n"
        << CurveTitle(c) << "\n\n"
        << c.says << "\n\n| " << c.parameter << " | error, " << c.unit << (counts ? std::string(" | ") + c.counted : "")
        << " | seconds | MiB |\n|---|---|---|---|" << (counts ? "---|" : "") << "\n";
    for (const double parameter : c.parameters) {
      Measured m;
      CurvePoint point;
      const double seconds = SecondsOf([&] { point = c.measure(parameter, m); });
      for (const std::string& failure : m.failures) std::cerr << c.name << ": " << failure << "\n";
      out << "| " << Short(parameter, 6) << " | " << Figure(point.error)
          << (counts ? " | " + Short(point.count, 4) : "") << " | " << Short(seconds) << " | "
          << Short(PeakMebibytes(), 4) << " |\n";
    }
  }
  return out.str();
}

std::string Csv() {
  std::ostringstream out;
  out << "curve,parameter,error,count,seconds\n";
  for (const Curve& c : AllCurves()) {
    for (const double parameter : c.parameters) {
      Measured m;
      CurvePoint point;
      const double seconds = SecondsOf([&] { point = c.measure(parameter, m); });
      out << c.name << "," << Short(parameter, 9) << "," << Short(point.error, 9) << "," << Short(point.count, 9) << ","
          << Short(seconds, 3) << "\n";
    }
  }
  return out.str();
}

int Update(const char* path) {
  std::ifstream in(path);
  std::stringstream text;
  text << in.rdbuf();
  std::string page = text.str();
  const std::size_t begin = page.find(kPageBegin), end = page.find(kPageEnd);
  if (begin == std::string::npos || end == std::string::npos) {
    std::cerr << path << ": the marks of the generated part are missing\n";
    return 1;
  }
  const std::size_t from = begin + std::strlen(kPageBegin) + 1;
  page.replace(from, end - from, Markdown() + "\n");
  std::ofstream(path) << page;
  return 0;
}

}  // namespace
}  // namespace facet::stability

int main(int count, char** arguments) {
  using namespace facet::stability;
  if (count == 3 && std::strcmp(arguments[1], "--update") == 0) return Update(arguments[2]);
  if (count == 2 && std::strcmp(arguments[1], "--csv") == 0) return std::cout << Csv(), 0;
  if (count != 1) return std::cerr << "usage: stability_table [--csv | --update FILE]\n", 2;
  std::cout << Markdown();
}
