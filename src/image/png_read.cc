// Reading PNG.
#include <png.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <vector>

#include "facet/error.h"
#include "image/png.h"
#include "image/png_state.h"

namespace facet {
namespace {

struct Cursor {
  const std::byte* at;
  std::size_t left;
};

void ReadBytes(png_structp png, png_bytep to, std::size_t count) {
  auto* cursor = static_cast<Cursor*>(png_get_io_ptr(png));
  if (cursor->left < count) png_error(png, "the file is cut off");
  std::memcpy(to, cursor->at, count);
  cursor->at += count;
  cursor->left -= count;
}

struct Header {
  png_uint_32 width, height;
  int channels, bit_depth, passes;
  png_uint_32 file_row_bytes;  // of the widest pass
};

// Reads everything before the pixels. False: the recorded error says why.
bool ReadHeader(png_structp png, png_infop info, Header* header) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  // The caller checks the limits, so that its message can state the size.
  png_set_user_limits(png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
  png_set_crc_action(png, PNG_CRC_ERROR_QUIT, PNG_CRC_WARN_DISCARD);  // for critical chunks, and for the others
  // Profiles, gamma, text: not parsed at all (tRNS is kept).
  png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_NEVER, nullptr, -1);
  png_read_info(png, info);
  header->file_row_bytes = static_cast<png_uint_32>(png_get_rowbytes(png, info));
  header->width = png_get_image_width(png, info);
  header->height = png_get_image_height(png, info);
  return true;
}

// Sets all transformations. libpng allocates its rows here, so their length must have been checked before.
bool Prepare(png_structp png, png_infop info, Header* header) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  png_set_expand(png);  // palettes, grey below 8 bits, tRNS
  if (std::endian::native == std::endian::little) png_set_swap(png);
  header->passes = png_set_interlace_handling(png);
  png_read_update_info(png, info);
  header->channels = png_get_channels(png, info);
  header->bit_depth = png_get_bit_depth(png, info);
  return true;
}

// Decodes the next `count` rows; those of an interlaced image all at once.
bool ReadRows(png_structp png, int passes, png_bytepp rows, png_uint_32 count) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  for (int pass = 0; pass < passes; ++pass) png_read_rows(png, rows, nullptr, count);
  return true;
}

// Reads what follows the pixels.
bool ReadEnd(png_structp png) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  png_read_end(png, nullptr);
  return true;
}

// Checks the lengths of chunks, because libpng allocates a text of the stated length before it reads it.
bool HoldsChunksBeforePixels(std::span<const std::byte> bytes) {
  for (std::size_t at = 8; at + 12 <= bytes.size();) {  // 12: length, type and checksum
    std::size_t length = 0;
    for (std::size_t i = 0; i < 4; ++i) length = length << 8 | std::to_integer<std::size_t>(bytes[at + i]);
    if (std::memcmp(bytes.data() + at + 4, "IDAT", 4) == 0) return true;
    if (length > bytes.size() - at - 12) return false;
    at += 12 + length;
  }
  return true;  // libpng will report missing pixels
}

// Reads all chunks before the pixels, and decompresses their texts.
bool ReadInfo(png_structp png, png_infop info) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  png_set_user_limits(png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
  constexpr png_alloc_size_t kMostText = 1 << 20;
  constexpr png_uint_32 kMostChunks = 64;
  png_set_chunk_malloc_max(png, kMostText);
  png_set_chunk_cache_max(png, kMostChunks);
  png_set_crc_action(png, PNG_CRC_ERROR_QUIT, PNG_CRC_ERROR_QUIT);
  png_read_info(png, info);
  return true;
}

// Looks for a transparent colour (tRNS), which adds an alpha channel, among the chunks before the pixels (IDAT). False:
// the chunks up to there are not all in `file`, so that it is not known.
bool FindPngTransparency(const FileStart& file, bool& found) {
  found = false;
  std::size_t at = 8;
  while (file.Has(at, 8)) {
    const std::size_t length = file.Big32(at);
    if (file.Is(at + 4, "IDAT") || file.Is(at + 4, "IEND")) return true;
    if (file.Is(at + 4, "tRNS") && length > 0) {
      found = true;
      return true;
    }
    if (length > file.Size()) return false;
    at += 12 + length;
  }
  return false;
}

}  // namespace

void ProbePng(const FileStart& file, ImageHeader& header) {
  if (!file.Has(8, 21) || file.Big32(8) != 13 || !file.Is(12, "IHDR")) return;
  header.width = SideOf(file.Big32(16));
  header.height = SideOf(file.Big32(20));
  header.bits = file.Byte(24) == 16 ? 16 : 8;
  constexpr int kGrey = 0, kColor = 2, kPalette = 3, kGreyAlpha = 4, kColorAlpha = 6;
  const int type = static_cast<int>(file.Byte(25));
  if (type == kGreyAlpha) header.channels = 2;
  if (type == kColorAlpha) header.channels = 4;
  if (type != kGrey && type != kColor && type != kPalette) return;
  bool transparent = false;
  if (FindPngTransparency(file, transparent)) header.channels = (type == kGrey ? 1 : 3) + (transparent ? 1 : 0);
}

void DecodePng(std::span<const std::byte> bytes, const std::string& name, int piece_rows,
               const PieceReceiver& receive) {
  PngState reader(PngState::For::Reading);
  Cursor cursor{bytes.data(), bytes.size()};
  png_set_read_fn(reader.png, &cursor, ReadBytes);
  const auto fail = [&]() -> Error {
    return Error(ErrorCode::InvalidInput, std::string("broken PNG: ") + reader.complaint.text, name);
  };
  Header header{};
  if (!ReadHeader(reader.png, reader.info, &header)) throw fail();
  CheckImageSize(header.width, header.height, name);
  // Deflate's best ratio: a file that states more pixels cannot contain them, so no memory is allocated for it.
  constexpr std::uint64_t kMostUnpacked = 1032;
  if (std::uint64_t(header.file_row_bytes) * header.height / kMostUnpacked > bytes.size()) {
    throw Error(ErrorCode::InvalidInput, "broken PNG: the file is cut off", name);
  }
  if (!Prepare(reader.png, reader.info, &header)) throw fail();

  Image image;
  image.width = static_cast<int>(header.width);
  image.channels = header.channels;
  image.type = header.bit_depth == 16 ? ChannelType::U16 : ChannelType::U8;
  image.encoding = Encoding::Srgb;
  const std::size_t pixel_bytes = std::size_t(header.channels) * SizeOf(image.type);
  const std::size_t row_bytes = std::size_t(header.width) * pixel_bytes;
  if (png_get_rowbytes(reader.png, reader.info) != row_bytes) {
    throw Error(ErrorCode::Internal, "libpng's rows have an unexpected length", name);
  }
  const int height = static_cast<int>(header.height);
  const int most = header.passes > 1 ? height : std::min(piece_rows, height);
  const MemoryLease lease = LeaseImage(header.width, header.height, std::uint64_t(most), pixel_bytes, name);
  image.bytes = AllocatePixels(row_bytes * std::size_t(most), name);
  for (int first = 0; first < height; first += most) {
    image.height = std::min(most, height - first);
    image.bytes.resize(row_bytes * std::size_t(image.height));
    std::vector<png_bytep> rows(static_cast<std::size_t>(image.height));
    for (std::size_t y = 0; y < rows.size(); ++y) {
      rows[y] = reinterpret_cast<png_bytep>(image.bytes.data() + y * row_bytes);
    }
    if (!ReadRows(reader.png, header.passes, rows.data(), static_cast<png_uint_32>(image.height))) throw fail();
    if (first + image.height == height) {
      const char* const what = ReadEnd(reader.png) ? reader.complaint.warning : reader.complaint.text;
      if (what[0] != '\0') image.damage = std::string("damaged PNG: ") + what;
    }
    receive(image, height);
  }
}

std::map<std::string, std::string> ReadPngText(std::span<const std::byte> bytes, const std::string& name) {
  if (!HoldsChunksBeforePixels(bytes)) throw Error(ErrorCode::InvalidInput, "broken PNG: the file is cut off", name);
  PngState reader(PngState::For::Reading);
  Cursor cursor{bytes.data(), bytes.size()};
  png_set_read_fn(reader.png, &cursor, ReadBytes);
  if (!ReadInfo(reader.png, reader.info)) {
    throw Error(ErrorCode::InvalidInput, std::string("broken PNG: ") + reader.complaint.text, name);
  }
  png_textp chunks = nullptr;
  const int count = png_get_text(reader.png, reader.info, &chunks, nullptr);
  std::map<std::string, std::string> text;
  for (int i = 0; i < count; ++i) text.emplace(chunks[i].key, chunks[i].text);
  return text;
}

}  // namespace facet
