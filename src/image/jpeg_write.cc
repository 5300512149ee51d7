// Writing JPEG. libjpeg's own handler of errors ends the process and its own target, a stdio file, ends in that handler
// when the disk is full: both are replaced.
#include <csetjmp>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>

// jpeglib.h needs size_t and FILE to be known.
#include <jpeglib.h>

#include "facet/error.h"
#include "image/jpeg.h"

namespace facet {
namespace {

struct ErrorState {
  jpeg_error_mgr manager;  // first: libjpeg hands back a pointer to it
  std::jmp_buf jump;
  char text[JMSG_LENGTH_MAX];
};

[[noreturn]] void OnError(j_common_ptr codec) {
  auto* state = reinterpret_cast<ErrorState*>(codec->err);
  codec->err->format_message(codec, state->text);
  std::longjmp(state->jump, 1);
}

void OnOutput(j_common_ptr) {}

// Holds plain data only: an error leaves it by longjmp.
bool Encode(jpeg_compress_struct* encoder, ErrorState* errors, const Image* image, unsigned char** bytes,
            unsigned long* size) {
  if (setjmp(errors->jump) != 0) return false;
  jpeg_create_compress(encoder);
  jpeg_mem_dest(encoder, bytes, size);
  encoder->image_width = static_cast<JDIMENSION>(image->width);
  encoder->image_height = static_cast<JDIMENSION>(image->height);
  encoder->input_components = image->channels;
  encoder->in_color_space = image->channels == 1 ? JCS_GRAYSCALE : JCS_RGB;
  jpeg_set_defaults(encoder);
  constexpr int kQuality = 95;
  jpeg_set_quality(encoder, kQuality, TRUE);
  jpeg_start_compress(encoder, TRUE);
  const std::size_t row_bytes = static_cast<std::size_t>(image->width) * static_cast<std::size_t>(image->channels);
  while (encoder->next_scanline < encoder->image_height) {
    // libjpeg does not write to it; its interface knows no const.
    auto* row = const_cast<JSAMPLE*>(image->As<JSAMPLE>()) + encoder->next_scanline * row_bytes;
    jpeg_write_scanlines(encoder, &row, 1);
  }
  jpeg_finish_compress(encoder);
  return true;
}

}  // namespace

std::vector<std::byte> EncodeJpeg(const Image& image) {
  if (image.width > JPEG_MAX_DIMENSION || image.height > JPEG_MAX_DIMENSION) {
    throw Error(ErrorCode::InvalidUsage, "a JPEG file has at most 65500 pixels a side");
  }
  ErrorState errors{};
  jpeg_compress_struct encoder{};
  encoder.err = jpeg_std_error(&errors.manager);
  errors.manager.error_exit = OnError;
  errors.manager.output_message = OnOutput;
  unsigned char* bytes = nullptr;
  unsigned long size = 0;
  const bool done = Encode(&encoder, &errors, &image, &bytes, &size);
  jpeg_destroy_compress(&encoder);
  const std::unique_ptr<unsigned char, void (*)(void*)> owner(bytes, std::free);
  if (!done) throw Error(ErrorCode::OutOfMemory, std::string("libjpeg: ") + errors.text);
  const auto* begin = reinterpret_cast<const std::byte*>(bytes);
  return {begin, begin + size};
}

}  // namespace facet
