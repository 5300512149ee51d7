// libjpeg-turbo has versions of its decoder for several instruction sets and reads from its environment which to use.
// facet asks for the transform and the upsampling that are the same in all. Each level runs in a process of its own: the
// library looks once. A program apart from the other image tests, so that nothing has made it look before.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <string>
#include <vector>

// jpeglib.h needs size_t and FILE to be known.
#include <jpeglib.h>

#include "image/codec.h"

namespace facet {
namespace {

using Bytes = std::vector<std::byte>;

// What `make` returns in a child process that has the environment variable `variable` set to 1.
Bytes InChild(const char* variable, const std::function<Bytes()>& make) {
  int ends[2];
  EXPECT_EQ(pipe(ends), 0);
  const pid_t child = fork();
  if (child == 0) {
    setenv(variable, "1", 1);
    int code = 1;
    try {
      const Bytes bytes = make();
      std::size_t written = 0;
      while (written < bytes.size()) {
        const ssize_t step = write(ends[1], bytes.data() + written, bytes.size() - written);
        if (step <= 0) break;
        written += static_cast<std::size_t>(step);
      }
      code = written == bytes.size() ? 0 : 1;
    } catch (...) {
    }
    _exit(code);
  }
  close(ends[1]);
  Bytes bytes, block(1 << 16);
  for (ssize_t step = 0; (step = read(ends[0], block.data(), block.size())) > 0;) {
    bytes.insert(bytes.end(), block.begin(), block.begin() + step);
  }
  close(ends[0]);
  int status = 0;
  EXPECT_EQ(waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << variable;
  return bytes;
}

struct Kind {
  int channels, width, height, horizontal, vertical, quality;
  bool progressive;
};

// Full of sharp edges and saturated colours, so that rounding and clamping are at work everywhere.
Bytes Encode(const Kind& kind) {
  jpeg_compress_struct encoder;
  jpeg_error_mgr errors;
  encoder.err = jpeg_std_error(&errors);
  jpeg_create_compress(&encoder);
  unsigned char* memory = nullptr;
  unsigned long size = 0;
  jpeg_mem_dest(&encoder, &memory, &size);
  encoder.image_width = static_cast<JDIMENSION>(kind.width);
  encoder.image_height = static_cast<JDIMENSION>(kind.height);
  encoder.input_components = kind.channels;
  encoder.in_color_space = kind.channels == 1 ? JCS_GRAYSCALE : JCS_RGB;
  jpeg_set_defaults(&encoder);
  jpeg_set_quality(&encoder, kind.quality, TRUE);
  encoder.comp_info[0].h_samp_factor = kind.horizontal;
  encoder.comp_info[0].v_samp_factor = kind.vertical;
  if (kind.progressive) jpeg_simple_progression(&encoder);
  jpeg_start_compress(&encoder, TRUE);
  std::vector<unsigned char> row(static_cast<std::size_t>(kind.width * kind.channels));
  unsigned noise = 1;
  for (int y = 0; y < kind.height; ++y) {
    for (unsigned char& value : row) {
      noise = noise * 1664525u + 1013904223u;
      value = static_cast<unsigned char>((noise >> 30) * 85u);
    }
    JSAMPROW rows = row.data();
    jpeg_write_scanlines(&encoder, &rows, 1);
  }
  jpeg_finish_compress(&encoder);
  Bytes out(size);
  std::memcpy(out.data(), memory, size);
  jpeg_destroy_compress(&encoder);
  std::free(memory);
  return out;
}

TEST(JpegSimd, EveryLevelDecodesToTheSameBytes) {
  std::vector<Kind> kinds;
  for (const bool progressive : {false, true}) {
    for (const int quality : {25, 95}) {
      for (const auto& [horizontal, vertical] : {std::pair{1, 1}, {2, 1}, {1, 2}, {2, 2}, {4, 1}}) {
        kinds.push_back({3, 123, 77, horizontal, vertical, quality, progressive});
        kinds.push_back({3, 64, 48, horizontal, vertical, quality, progressive});
      }
      kinds.push_back({1, 123, 77, 1, 1, quality, progressive});
    }
  }
  for (const Kind& kind : kinds) {
    SCOPED_TRACE(std::to_string(kind.channels) + " channels, " + std::to_string(kind.width) + " wide, " +
                 std::to_string(kind.horizontal) + "x" + std::to_string(kind.vertical) + ", quality " +
                 std::to_string(kind.quality) + (kind.progressive ? ", progressive" : ""));
    const Bytes file = InChild("JSIMD_FORCENONE", [&] { return Encode(kind); });
    ASSERT_GT(file.size(), 100u);
    const auto decode = [&] { return DecodeImage(file, "a picture").bytes; };
    const Bytes expected = InChild("JSIMD_FORCENONE", decode);
    ASSERT_EQ(expected.size(), static_cast<std::size_t>(kind.width * kind.height * kind.channels));
    for (const char* level : {"JSIMD_FORCESSE2", "JSIMD_FORCEAVX2", "JSIMD_FORCENEON", "FACET_NOT_FORCED"}) {
      EXPECT_EQ(InChild(level, decode), expected) << level;
    }
  }
}

}  // namespace
}  // namespace facet
