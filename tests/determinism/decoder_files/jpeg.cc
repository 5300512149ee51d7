#include <cstdio>
#include <cstdlib>

// jpeglib.h needs size_t and FILE to be known.
#include <jpeglib.h>

#include "gltf_writer.h"

namespace facet::decoder_files {
namespace {

struct Coding {
  int quality;
  J_DCT_METHOD transform;
  bool progressive, arithmetic;
  unsigned restart;  // in blocks; 0: none
};

// Not by JDCT_IFAST: its vector code overflows at sharp edges, and the blocks that it writes then leave the range of
// pixels by several times. Of those libjpeg-turbo's decoder without vector code makes something else.
constexpr Coding kCodings[] = {{95, JDCT_ISLOW, false, false, 0}, {40, JDCT_ISLOW, false, false, 5},
                               {85, JDCT_FLOAT, false, false, 0}, {90, JDCT_ISLOW, true, false, 0},
                               {15, JDCT_FLOAT, true, false, 7},  {80, JDCT_ISLOW, false, true, 0}};

std::string Encode(J_COLOR_SPACE from, J_COLOR_SPACE to, int horizontal, int vertical, const Coding& coding) {
  jpeg_compress_struct encoder;
  jpeg_error_mgr errors;
  encoder.err = jpeg_std_error(&errors);  // says what is wrong, and exits
  jpeg_create_compress(&encoder);
  unsigned char* memory = nullptr;
  unsigned long size = 0;
  jpeg_mem_dest(&encoder, &memory, &size);
  encoder.image_width = kPatternWidth;
  encoder.image_height = kPatternHeight;
  encoder.input_components = from == JCS_GRAYSCALE ? 1 : from == JCS_CMYK ? 4 : 3;
  encoder.in_color_space = from;
  jpeg_set_defaults(&encoder);
  jpeg_set_colorspace(&encoder, to);
  jpeg_set_quality(&encoder, coding.quality, TRUE);
  encoder.comp_info[0].h_samp_factor = horizontal;
  encoder.comp_info[0].v_samp_factor = vertical;
  encoder.dct_method = coding.transform;
  encoder.arith_code = coding.arithmetic ? TRUE : FALSE;
  encoder.restart_interval = coding.restart;
  if (coding.progressive) jpeg_simple_progression(&encoder);
  jpeg_start_compress(&encoder, TRUE);
  auto samples = Pattern<unsigned char>(encoder.input_components, 255);
  for (std::size_t y = 0; y < kPatternHeight; ++y) {
    JSAMPROW row = samples.data() + y * kPatternWidth * static_cast<std::size_t>(encoder.input_components);
    jpeg_write_scanlines(&encoder, &row, 1);
  }
  jpeg_finish_compress(&encoder);
  std::string bytes(reinterpret_cast<const char*>(memory), size);
  jpeg_destroy_compress(&encoder);
  std::free(memory);
  return bytes;
}

}  // namespace

void WriteJpeg(const Folder& folder) {
  struct Kind {
    const char* name;
    J_COLOR_SPACE from, to;
    int horizontal, vertical;
  };
  for (const Kind& kind : {Kind{"grey", JCS_GRAYSCALE, JCS_GRAYSCALE, 1, 1}, Kind{"444", JCS_RGB, JCS_YCbCr, 1, 1},
                           Kind{"422", JCS_RGB, JCS_YCbCr, 2, 1}, Kind{"420", JCS_RGB, JCS_YCbCr, 2, 2},
                           Kind{"440", JCS_RGB, JCS_YCbCr, 1, 2}, Kind{"411", JCS_RGB, JCS_YCbCr, 4, 1},
                           Kind{"rgb", JCS_RGB, JCS_RGB, 1, 1}, Kind{"cmyk", JCS_CMYK, JCS_CMYK, 1, 1},
                           Kind{"ycck", JCS_CMYK, JCS_YCCK, 2, 2}}) {
    std::vector<std::string> pictures;
    for (const Coding& coding : kCodings) {
      pictures.push_back(Encode(kind.from, kind.to, kind.horizontal, kind.vertical, coding));
    }
    WritePictures(folder / (std::string("jpeg-") + kind.name + ".glb"), "image/jpeg", pictures);
  }
}

}  // namespace facet::decoder_files
