// Writing JPEG. libjpeg's own handler of errors ends the process and its own target, a stdio file, ends in that handler
// when the disk is full: both are replaced.
#include <algorithm>
#include <csetjmp>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>

// jpeglib.h needs size_t and FILE to be known.
#include <jpeglib.h>

#include <jerror.h>

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

// Where the file goes. libjpeg's own target in memory loses hold of its memory where there is too little.
struct Target {
  jpeg_destination_mgr manager;  // first: libjpeg hands back a pointer to it
  JOCTET* bytes;                 // by std::malloc
  std::size_t room;
};

void Begin(j_compress_ptr) {}

boolean MakeRoom(j_compress_ptr encoder) {
  auto* target = reinterpret_cast<Target*>(encoder->dest);
  constexpr std::size_t kFirst = std::size_t{1} << 16;
  const std::size_t used = target->room, room = std::max(kFirst, 2 * used);
  void* const bytes = std::realloc(target->bytes, room);
  if (bytes == nullptr) {
    encoder->err->msg_code = JERR_OUT_OF_MEMORY;
    encoder->err->msg_parm.i[0] = 0;
    OnError(reinterpret_cast<j_common_ptr>(encoder));
  }
  target->bytes = static_cast<JOCTET*>(bytes);
  target->room = room;
  target->manager.next_output_byte = target->bytes + used;
  target->manager.free_in_buffer = room - used;
  return TRUE;
}

void End(j_compress_ptr) {}

// Holds plain data only: an error leaves it by longjmp.
bool Encode(jpeg_compress_struct* encoder, ErrorState* errors, const Image* image, Target* target) {
  if (setjmp(errors->jump) != 0) return false;
  jpeg_create_compress(encoder);
  target->manager.init_destination = Begin;
  target->manager.empty_output_buffer = MakeRoom;
  target->manager.term_destination = End;
  encoder->dest = &target->manager;
  MakeRoom(encoder);
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
  Target target{};
  const bool done = Encode(&encoder, &errors, &image, &target);
  jpeg_destroy_compress(&encoder);
  const std::unique_ptr<JOCTET, void (*)(void*)> owner(target.bytes, std::free);
  if (!done) throw Error(ErrorCode::OutOfMemory, std::string("libjpeg: ") + errors.text);
  const auto* begin = reinterpret_cast<const std::byte*>(target.bytes);
  return {begin, begin + (target.room - target.manager.free_in_buffer)};
}

}  // namespace facet
