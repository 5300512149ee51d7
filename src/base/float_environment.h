// The floating-point environment in which all tasks of the rendering path run.
#pragma once

#include <cfenv>
#include <cstdint>

#include "facet/shader/arithmetic_check.h"

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace facet {

// During its lifetime the current thread rounds to nearest, keeps subnormals and has no traps. Afterwards the host's
// environment is restored, for example the one of a host that was compiled with -ffast-math or changed the rounding
// mode.
class FloatEnvironment {
 public:
#if defined(__x86_64__)
  FloatEnvironment() : saved_(_mm_getcsr()) {
    constexpr unsigned kAllMasked = 0x1F80;  // the state in which a process starts
    constexpr std::uint16_t kX87AllMasked = 0x037F;
    _mm_setcsr(kAllMasked);
    // The C library's strtod rounds as the x87 control word says.
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
