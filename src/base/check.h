// Assertions about facet's own code. What a user or a file can get wrong is an Error instead.
#pragma once

#include <sstream>

#include "facet/error.h"

namespace facet {

template <class A, class B>
[[noreturn]] void CheckFailed(const char* text, const A& a, const B& b, const char* file, int line) {
  std::ostringstream message;
  message << "check failed: " << text << " (" << a << " against " << b << ")";
  throw Error(ErrorCode::Internal, message.str(), std::string(file) + ":" + std::to_string(line),
              "this is a defect of facet, please report it with the input");
}

}  // namespace facet

// Enabled in all builds, at the interfaces between rooms; prints both operands.
#define FACET_CHECK_OP(a, op, b) \
  ((a)op(b) ? void() : ::facet::CheckFailed(#a " " #op " " #b, (a), (b), __FILE__, __LINE__))
#define FACET_CHECK(condition) \
  ((condition) ? void() : ::facet::CheckFailed(#condition, false, true, __FILE__, __LINE__))
