// What the fuzzers share: what counts as a find, a folder for what is read from files, and bytes on end.
#pragma once

#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "facet/error.h"

// libFuzzer's: changes `size` bytes at `data` to at most `max_size`, and returns how many they are then.
extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

namespace facet::fuzz {

// Of all work under a fuzzer. scripts/fuzz.sh lets libFuzzer stop what takes more than a few of it.
inline constexpr std::uint64_t kMemoryLimit = std::uint64_t{64} << 20;

// A find: libFuzzer keeps the input of what aborts.
[[noreturn]] inline void Fail(const std::string& what) {
  std::fprintf(stderr, "FIND: %s\n", what.c_str());
  std::abort();
}

inline void Check(bool good, const std::string& what) {
  if (!good) Fail(what);
}

enum class Outcome { Done, Refused, OutOfMemory };

// An Error is what a broken file gives, unless it says that facet itself is at fault. All else that is thrown is a
// find.
template <class Body>
Outcome Try(const Body& body) {
  try {
    body();
    return Outcome::Done;
  } catch (const Error& error) {
    Check(error.code() != ErrorCode::Internal, error.what());
    Check(std::string_view(error.what()).find('\n') == std::string_view::npos, "an error of several lines");
    return error.code() == ErrorCode::OutOfMemory ? Outcome::OutOfMemory : Outcome::Refused;
  }
}

inline std::span<const std::byte> AsBytes(std::string_view text) { return std::as_bytes(std::span(text)); }

inline std::string_view AsText(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

// A folder of this process's own, within TMPDIR; scripts/fuzz.sh removes what is in there.
class ScratchFolder {
 public:
  ScratchFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "facet-fuzz-XXXXXX").string();
    Check(mkdtemp(pattern.data()) != nullptr, "there is no temporary folder");
    path_ = pattern;
  }

  std::filesystem::path operator/(std::string_view name) const { return path_ / name; }

  std::filesystem::path Write(std::string_view name, std::string_view bytes) const {
    const std::filesystem::path path = path_ / name;
    std::FILE* const file = std::fopen(path.c_str(), "wb");
    Check(file != nullptr && std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size() && std::fclose(file) == 0,
          "the temporary folder cannot be written");
    return path;
  }

 private:
  std::filesystem::path path_;
};

}  // namespace facet::fuzz

namespace facet::fuzz {

// Each fuzzer defines this; it is called with one input after the other.
void Run(std::span<const std::byte> input);

}  // namespace facet::fuzz
