// Prints a checksum of each function of one argument over all floats (minutes for each instruction set), on every
// instruction set that this machine has, and fails where two differ. `float_checksums 257` takes every 257th float.
#include <cinttypes>
#include <cstdio>
#include <cstdlib>

#include "facet/shader/dispatch.h"
#include "math/all_floats.h"
#include "math/elementary_lanes.h"

using namespace facet;

int main(int argc, char** argv) {
  const std::uint64_t stride = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 1;
  bool equal = true;
  for (int function = 0; function < testing::kOneArgumentFunctionCount; ++function) {
    std::uint64_t first = 0;
    std::printf("%-5s", testing::kLaneFunctionNames[static_cast<std::size_t>(function)]);
    for (Target target : {Target::Neon, Target::Avx3, Target::Avx2, Target::Sse4, Target::Scalar}) {
      if (!TargetIsAvailable(target)) continue;
      const ScopedTarget scoped(target);
      const std::uint64_t sum = testing::ChecksumOverFloats(function, stride);
      if (first == 0) first = sum;
      equal = equal && sum == first;
      std::printf("  %s %016" PRIx64, TargetName(target), sum);
      std::fflush(stdout);
    }
    std::printf("\n");
  }
  std::printf("%s\n", equal ? "equal on every instruction set" : "NOT EQUAL");
  return equal ? 0 : 1;
}
