#include "facet/error.h"

#include <utility>

namespace facet {
namespace {

std::string Line(const std::string& message, const std::string& where, const std::string& hint) {
  std::string line = where.empty() ? message : where + ": " + message;
  if (!hint.empty()) line += "; " + hint;
  for (char& c : line) {
    if (c == '\n' || c == '\r') c = ' ';
  }
  return line;
}

}  // namespace

Error::Error(ErrorCode code, std::string message, std::string where, std::string hint)
    : std::runtime_error(Line(message, where, hint)),
      code_(code),
      message_(std::move(message)),
      where_(std::move(where)),
      hint_(std::move(hint)) {}

int ExitCode(ErrorCode code) noexcept {
  switch (code) {
    case ErrorCode::Internal: return 1;
    case ErrorCode::InvalidUsage: return 2;
    case ErrorCode::NotFound: return 3;
    case ErrorCode::InvalidInput: return 4;
    case ErrorCode::Unsupported: return 5;
    case ErrorCode::OutputFailed: return 6;
    case ErrorCode::OutOfMemory: return 7;
    case ErrorCode::MissingModule: return 8;
  }
  return 1;
}

}  // namespace facet
