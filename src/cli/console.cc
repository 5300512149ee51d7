#include "cli/console.h"

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "facet/error.h"

namespace facet::cli {
namespace {

void PrintLine(std::string_view prefix, std::string_view text) {
  std::string line(prefix);
  line += Printable(text);
  line += '\n';
  std::fwrite(line.data(), 1, line.size(), stderr);  // one call: lines of several processes do not mix
}

}  // namespace

std::string Printable(std::string_view text) {
  static constexpr char kHex[] = "0123456789abcdef";
  std::string out;
  out.reserve(text.size());
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x20 && byte != 0x7f) {
      out += c;
    } else {
      out += "\\x";
      out += kHex[byte >> 4];
      out += kHex[byte & 15];
    }
  }
  return out;
}

std::string Quoted(std::string_view text) {
  std::string quoted(1, '\'');
  quoted += Printable(text);
  quoted += '\'';
  return quoted;
}

void PrintError(std::string_view text) { PrintLine("facet: ", text); }

void PrintWarning(std::string_view text) { PrintLine("facet: warning: ", text); }

void PrintOutput(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0) {
    throw Error(ErrorCode::OutputFailed, std::strerror(errno), "standard output");
  }
}

}  // namespace facet::cli
