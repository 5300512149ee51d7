// Writing JPEG.
#include <algorithm>
#include <cstdlib>
#include <memory>
#include <string>

#include "facet/error.h"
#include "image/jpeg.h"
#include "image/jpeg_errors.h"

namespace facet {
namespace {

// A destination in memory. libjpeg's own leaks its memory when an allocation fails.
struct Target {
  jpeg_destination_mgr manager;  // first: libjpeg hands back a pointer to it
  JOCTET* bytes;                 // allocated by std::malloc
  std::size_t room;
};

void Begin(j_compress_ptr) {}

boolean MakeRoom(j_compress_ptr encoder) {
  auto* target = reinterpret_cast<Target*>(encoder->dest);
  constexpr std::size_t kFirst = std::size_t{1} << 16;
  const std::size_t used = target->room, room = std::max(kFirst, 2 * used);
  void* const bytes = std::realloc(target->bytes, room);
  if (bytes == nullptr) ERREXIT1(encoder, JERR_OUT_OF_MEMORY, 0);
  target->bytes = static_cast<JOCTET*>(bytes);
  target->room = room;
  target->manager.next_output_byte = target->bytes + used;
  target->manager.free_in_buffer = room - used;
  return TRUE;
}

void End(j_compress_ptr) {}

// See jpeg_errors.h.
bool Encode(jpeg_compress_struct* encoder, JpegErrors* errors, const Image* image, Target* target) {
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
    // libjpeg does not write to it, but its interface lacks const.
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
  JpegErrors errors{};
  jpeg_compress_struct encoder{};
  encoder.err = BeginJpegErrors(errors);
  Target target{};
  const bool done = Encode(&encoder, &errors, &image, &target);
  jpeg_destroy_compress(&encoder);
  const std::unique_ptr<JOCTET, void (*)(void*)> owner(target.bytes, std::free);
  if (!done) throw Error(ErrorCode::OutOfMemory, std::string("libjpeg: ") + errors.text);
  const auto* begin = reinterpret_cast<const std::byte*>(target.bytes);
  return {begin, begin + (target.room - target.manager.free_in_buffer)};
}

}  // namespace facet
