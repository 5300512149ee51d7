// The floating-point environment that every task of the rendering path runs in.
#pragma once

#include <cfenv>
#include <cstdint>

#include "facet/shader/arithmetic_check.h"

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace facet {

// While alive: round to nearest, subnormals kept, no traps, on the current thread. A host that was compiled with
// -ffast-math, or that changed the rounding mode, gets its own environment back at the end.
class FloatEnvironment {
 public:
#if defined(__x86_64__)
  FloatEnvironment() : saved_(_mm_getcsr()) {
    constexpr unsigned kAllMasked = 0x1F80;  // the states that a process starts with
    constexpr std::uint16_t kX87AllMasked = 0x037F;
    _mm_setcsr(kAllMasked);
    // The C library's strtod asks x87's control word which way to round.
    asm volatile("fnstcw %0" : "=m"(saved_x87_));
    asm volatile("fldcw %0" : : "m"(kX87AllMasked));
  }
  ~FloatEnvironment() {
    _mm_setcsr(saved_);
    asm volatile("fldcw %0" : : "m"(saved_x87_));
  }

 private:
  unsigned saved_;
  std::uint16_t saved_x87_;
#elif defined(__aarch64__)
  FloatEnvironment() {
    asm volatile("mrs %0, fpcr" : "=r"(saved_));
    asm volatile("msr fpcr, %0" : : "r"(std::uint64_t{0}));
  }
  ~FloatEnvironment() { asm volatile("msr fpcr, %0" : : "r"(saved_)); }

 private:
  std::uint64_t saved_;
#else
  FloatEnvironment() {
    std::fegetenv(&saved_);
    std::fesetenv(FE_DFL_ENV);
  }
  ~FloatEnvironment() { std::fesetenv(&saved_); }

 private:
  std::fenv_t saved_;
#endif
 public:
  FloatEnvironment(const FloatEnvironment&) = delete;
  FloatEnvironment& operator=(const FloatEnvironment&) = delete;
};

}  // namespace facet
