#include <atomic>
#include <cstdlib>
#include <string_view>

#include "facet/error.h"
#include "facet/shader/dispatch.h"
#include "hwy/detect_targets.h"

namespace facet {
namespace {

constexpr int kUnset = -1;
std::atomic<int> g_forced{kUnset};

Target BestTarget() {
  for (Target target : {Target::Avx3, Target::Avx2, Target::Sse4, Target::Neon}) {
    if (TargetIsAvailable(target)) return target;
  }
  return Target::Scalar;
}

Target ReadEnvironment() {
  const char* name = std::getenv("FACET_TARGET");
  if (name == nullptr || *name == '\0') return BestTarget();
  for (Target target : {Target::Scalar, Target::Sse4, Target::Avx2, Target::Avx3, Target::Neon}) {
    if (std::string_view(name) != TargetName(target)) continue;
    if (TargetIsAvailable(target)) return target;
    throw Error(ErrorCode::InvalidUsage, std::string("this processor or build lacks the instruction set ") + name,
                "FACET_TARGET", std::string("use ") + TargetName(BestTarget()) + " or SCALAR");
  }
  throw Error(ErrorCode::InvalidUsage, std::string("unknown instruction set '") + name + "'", "FACET_TARGET",
              "use SCALAR, SSE4, AVX2, AVX3 or NEON");
}

}  // namespace

const char* TargetName(Target target) {
  switch (target) {
    case Target::Sse4: return "SSE4";
    case Target::Avx2: return "AVX2";
    case Target::Avx3: return "AVX3";
    case Target::Neon: return "NEON";
    case Target::Scalar: break;
  }
  return "SCALAR";
}

bool TargetIsAvailable(Target target) {
  if (target == Target::Scalar) return true;
#if defined(FACET_SCALAR_ONLY)
  return false;
#elif defined(__x86_64__)
  const bool sse4 = __builtin_cpu_supports("sse4.2") && __builtin_cpu_supports("pclmul") &&
                    __builtin_cpu_supports("aes");
  const bool avx2 = sse4 && __builtin_cpu_supports("avx2") && __builtin_cpu_supports("bmi2") &&
                    __builtin_cpu_supports("fma");
  const bool avx3 = avx2 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
                    __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl") &&
                    __builtin_cpu_supports("avx512cd");
  switch (target) {  // what the processor has, of what the build has
    case Target::Sse4: return sse4 && (HWY_TARGETS & HWY_SSE4) != 0;
    case Target::Avx2: return avx2 && (HWY_TARGETS & HWY_AVX2) != 0;
    case Target::Avx3: return avx3 && (HWY_TARGETS & HWY_AVX3) != 0;
    default: return false;
  }
#elif defined(__aarch64__)
  return target == Target::Neon;
#else
  return false;
#endif
}

Target ActiveTarget() {
  const int forced = g_forced.load(std::memory_order_relaxed);
  if (forced != kUnset) return static_cast<Target>(forced);
  static const Target from_environment = ReadEnvironment();
  return from_environment;
}

ScopedTarget::ScopedTarget(Target target) : previous_(g_forced.exchange(static_cast<int>(target))) {}
ScopedTarget::~ScopedTarget() { g_forced.store(previous_); }

}  // namespace facet
