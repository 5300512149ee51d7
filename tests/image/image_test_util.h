// Shared by the tests of pictures.
#pragma once

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "base/input_file.h"
#include "base/temporary_folder.h"
#include "facet/error.h"
#include "facet/image.h"
#include "image/codec.h"

namespace facet {

inline std::filesystem::path Corpus() {
  const char* variable = std::getenv("FACET_CORPUS");
  return variable ? std::filesystem::path(variable)
                  : std::filesystem::path(FACET_SOURCE_DIR).parent_path() / "shared" / "corpus";
}

#define FACET_NEEDS_CORPUS() \
  if (!std::filesystem::exists(Corpus())) GTEST_SKIP() << "no corpus at " << Corpus()

inline std::vector<std::byte> ReadBytes(const std::filesystem::path& path) {
  const Bytes bytes = ReadFile(path);
  return {bytes.data, bytes.data + bytes.size};
}

using TemporaryFolder = test::ScratchFolder;

// The code of the Error that `body` throws; fails the test when it throws none.
template <class Body>
ErrorCode CodeOf(Body&& body, std::string* what = nullptr) {
  try {
    body();
  } catch (const Error& error) {
    if (what) *what = error.what();
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    return error.code();
  }
  ADD_FAILURE() << "no error was thrown";
  return ErrorCode::Internal;
}

// Calls `body`, which gets no more than `bytes` from the system. (The sanitizers have taken theirs already.)
template <class Body>
void WithLittleMemory(std::size_t bytes, const Body& body) {
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_AS, &before), 0);
  std::size_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  rlimit little = before;
  little.rlim_cur = pages * static_cast<std::size_t>(getpagesize()) + bytes;
  ASSERT_EQ(setrlimit(RLIMIT_AS, &little), 0);
  body();
  EXPECT_EQ(setrlimit(RLIMIT_AS, &before), 0);
}

// Every byte differs from its neighbours, and every value occurs.
inline Image MakePattern(int width, int height, int channels, ChannelType type, Encoding encoding = Encoding::Srgb) {
  Image image;
  image.width = width;
  image.height = height;
  image.channels = channels;
  image.type = type;
  image.encoding = encoding;
  image.bytes.resize(image.PixelCount() * static_cast<std::size_t>(channels) * SizeOf(type));
  std::uint32_t state = 12345;
  const std::size_t count = image.PixelCount() * static_cast<std::size_t>(channels);
  for (std::size_t i = 0; i < count; ++i) {
    state = state * 1664525u + 1013904223u;
    if (type == ChannelType::U8) image.As<std::uint8_t>()[i] = static_cast<std::uint8_t>(state >> 24);
    if (type == ChannelType::U16) image.As<std::uint16_t>()[i] = static_cast<std::uint16_t>(state >> 16);
    if (type == ChannelType::F32) image.As<float>()[i] = static_cast<float>(state >> 8) * 0x1p-20f;
  }
  return image;
}

inline void ExpectSame(const Image& a, const Image& b) {
  EXPECT_EQ(a.width, b.width);
  EXPECT_EQ(a.height, b.height);
  EXPECT_EQ(a.channels, b.channels);
  EXPECT_EQ(a.type, b.type);
  EXPECT_EQ(a.encoding, b.encoding);
  EXPECT_TRUE(a.bytes == b.bytes) << "the pixels differ";
}

// The picture that DecodeImageRows gives in pieces.
inline Image Joined(const std::vector<std::byte>& file, int* pieces = nullptr) {
  Image whole;
  int count = 0;
  DecodeImageRows(file, "picture", [&](const Image& rows, int height) {
    if (count++ == 0) {
      whole = rows;
    } else {
      EXPECT_TRUE(rows.width == whole.width && rows.channels == whole.channels && rows.type == whole.type &&
                  rows.encoding == whole.encoding);
      whole.bytes.insert(whole.bytes.end(), rows.bytes.begin(), rows.bytes.end());
      whole.height += rows.height;
    }
    EXPECT_LE(whole.height, height);
  });
  if (pieces != nullptr) *pieces = count;
  return whole;
}

// FNV-1a.
inline std::uint64_t HashOf(const std::vector<std::byte>& bytes) {
  std::uint64_t hash = 14695981039346656037ull;
  for (const std::byte b : bytes) hash = (hash ^ static_cast<std::uint64_t>(b)) * 1099511628211ull;
  return hash;
}

}  // namespace facet
