// SHA-256: what pictures and scenes are told apart by.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <type_traits>
#include <vector>

#include "facet/digest.h"

namespace facet {

// Source: NIST, 2015, FIPS 180-4, Secure Hash Standard, section 6.2. Uses the processor's SHA instructions where it has
// them. Not thread-safe.
class Sha256 {
 public:
  void Add(std::span<const std::byte> bytes);
  void Add(std::string_view text) { Add(std::as_bytes(std::span(text))); }

  // The bytes of a number as it lies in memory (little-endian on every supported machine).
  template <class T>
    requires std::is_arithmetic_v<T> || std::is_enum_v<T>
  void Add(T value) {
    Add(std::as_bytes(std::span(&value, 1)));
  }

  // The length, then the bytes of every element. `T` must have no padding.
  template <class T>
  void AddArray(const std::vector<T>& values) {
    static_assert(std::is_trivially_copyable_v<T>);
    Add(std::uint64_t(values.size()));
    Add(std::as_bytes(std::span(values)));
  }

  // The digest of all that was added. Nothing may be added afterwards.
  Digest Finish();

  // For tests: without the processor's SHA instructions.
  static void ForcePortable(bool portable);

 private:
  std::array<std::uint32_t, 8> state_ = {0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a,
                                         0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
  std::array<std::byte, 64> block_;  // its first `length_ % 64` bytes await the rest of their block
  std::uint64_t length_ = 0;         // bytes
};

}  // namespace facet
