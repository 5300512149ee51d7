// What libFuzzer calls.
#include "fuzz/fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  facet::fuzz::Run(std::as_bytes(std::span(data, size)));
  return 0;
}
