// Linked into fuzzers whose inputs are JSON.
#include "fuzz/json_mutator.h"

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                               unsigned seed) {
  return facet::fuzz::MutateJsonInput(data, size, max_size, seed);
}

extern "C" std::size_t LLVMFuzzerCustomCrossOver(const std::uint8_t* a, std::size_t a_size, const std::uint8_t* b,
                                                 std::size_t b_size, std::uint8_t* out, std::size_t max_size,
                                                 unsigned seed) {
  return facet::fuzz::CrossJsonInputs({reinterpret_cast<const char*>(a), a_size},
                                      {reinterpret_cast<const char*>(b), b_size}, out, max_size, seed);
}
