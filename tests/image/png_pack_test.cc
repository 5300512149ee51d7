// When libdeflate fails, no PNG is made. A program of its own: the function below takes the place of the library's.
#include <gtest/gtest.h>
#include <libdeflate.h>

#include "image/image_test_util.h"

extern "C" std::size_t libdeflate_zlib_compress(libdeflate_compressor*, const void*, std::size_t, void*, std::size_t) {
  return 0;  // "it did not fit", which the buffer's size should rule out
}

namespace facet {
namespace {

TEST(Png, WhatLibdeflateDoesNotPackIsAnError) {
  const Image image{4, 4, 4, ChannelType::U8, Encoding::Srgb, std::vector<std::byte>(64, std::byte{7})};
  EXPECT_EQ(CodeOf([&] { EncodePng(image); }), ErrorCode::Internal);
}

}  // namespace
}  // namespace facet
