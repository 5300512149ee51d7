#include <png.h>

#include <array>
#include <bit>

#include "gltf_writer.h"

namespace facet::decoder_files {
namespace {

std::string Encode(int color_type, int depth, bool interlaced, bool transparent) {
  // An error is printed, and aborts.
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  std::string bytes;
  png_set_write_fn(
      png, &bytes,
      [](png_structp writer, png_bytep data, std::size_t size) {
        static_cast<std::string*>(png_get_io_ptr(writer))->append(reinterpret_cast<const char*>(data), size);
      },
      nullptr);
  png_set_IHDR(png, info, kPatternWidth, kPatternHeight, depth, color_type,
               interlaced ? PNG_INTERLACE_ADAM7 : PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
               PNG_FILTER_TYPE_DEFAULT);
  png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_ALL_FILTERS);
  const unsigned most = (1u << depth) - 1;
  if (color_type == PNG_COLOR_TYPE_PALETTE) {
    std::array<png_color, 256> palette;
    std::array<png_byte, 256> alpha;
    for (unsigned i = 0; i <= most; ++i) {
      palette[i] = {png_byte(i * 97), png_byte(255 - i * 31), png_byte(i * 151 + 40)};
      alpha[i] = png_byte(255 - i * 13);
    }
    png_set_PLTE(png, info, palette.data(), static_cast<int>(most + 1));
    if (transparent) png_set_tRNS(png, info, alpha.data(), static_cast<int>(most + 1), nullptr);
  } else if (transparent) {
    // One colour stands for nothing: that of the pattern's edges.
    const auto value = static_cast<png_uint_16>(most);
    const png_color_16 color{0, value, value, value, value};
    png_set_tRNS(png, info, nullptr, 0, &color);
  }
  png_write_info(png, info);
  png_set_packing(png);  // a byte for each value below 8 bits
  if (std::endian::native == std::endian::little) png_set_swap(png);
  const int channels = png_get_channels(png, info);
  const auto rows_of = [&](auto values) {
    std::array<png_bytep, kPatternHeight> rows;
    for (std::size_t y = 0; y < rows.size(); ++y) {
      rows[y] = reinterpret_cast<png_bytep>(values.data() + y * values.size() / rows.size());
    }
    png_write_image(png, rows.data());
  };
  if (depth == 16) {
    rows_of(Pattern<std::uint16_t>(channels, most));
  } else {
    rows_of(Pattern<std::uint8_t>(channels, most));
  }
  png_write_end(png, nullptr);
  png_destroy_write_struct(&png, &info);
  return bytes;
}

}  // namespace

void WritePng(const Folder& folder) {
  struct Kind {
    const char* name;
    int color_type;
    std::vector<int> depths;
    bool has_transparent_color;
  };
  for (const Kind& kind :
       {Kind{"grey", PNG_COLOR_TYPE_GRAY, {1, 2, 4, 8, 16}, true},
        Kind{"grey-alpha", PNG_COLOR_TYPE_GRAY_ALPHA, {8, 16}, false}, Kind{"rgb", PNG_COLOR_TYPE_RGB, {8, 16}, true},
        Kind{"rgba", PNG_COLOR_TYPE_RGB_ALPHA, {8, 16}, false},
        Kind{"palette", PNG_COLOR_TYPE_PALETTE, {1, 2, 4, 8}, true}}) {
    std::vector<std::string> pictures;
    for (const int depth : kind.depths) {
      for (const bool interlaced : {false, true}) {
        pictures.push_back(Encode(kind.color_type, depth, interlaced, false));
        if (kind.has_transparent_color) pictures.push_back(Encode(kind.color_type, depth, interlaced, true));
      }
    }
    WritePictures(folder / (std::string("png-") + kind.name + ".glb"), "image/png", pictures);
  }
}

}  // namespace facet::decoder_files
