// Reading JPEG.
#include "image/jpeg.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "base/pages.h"
#include "facet/error.h"
#include "image/jpeg_errors.h"

namespace facet {
namespace {

// A progressive file of a few kilobytes can have thousands of scans, each a pass over the whole image; encoders write
// about ten. Limits the total number of decoded blocks, but allows this number of scans for any image.
constexpr std::uint64_t kMaxBlocks = std::uint64_t{1} << 28;
constexpr std::uint64_t kFewScans = 32, kMaxScans = 500;

// Warnings (level -1) about lost image data are treated as errors, because libjpeg would fill the gap with grey.
void OnMessage(j_common_ptr codec, int level) {
  if (level >= 0) return;
  switch (codec->err->msg_code) {
    case JWRN_JPEG_EOF:  // if a scan needs more bits, JWRN_HIT_MARKER follows
      reinterpret_cast<JpegErrors*>(codec->err)->ended_early = true;
      break;
    case JWRN_HIT_MARKER:
    case JWRN_HUFF_BAD_CODE:
    case JWRN_MUST_RESYNC:
    case JWRN_NOT_SEQUENTIAL: OnJpegError(codec);
    default: break;
  }
}

struct ScanGuard {
  jpeg_progress_mgr manager;  // first, as above
  int most;
};

void OnProgress(j_common_ptr codec) {
  const auto* decoder = reinterpret_cast<j_decompress_ptr>(codec);
  const int most = reinterpret_cast<const ScanGuard*>(codec->progress)->most;
  if (decoder->input_scan_number <= most) return;
  auto* state = reinterpret_cast<JpegErrors*>(codec->err);
  std::snprintf(state->text, sizeof state->text, "more than %d scans", most);
  std::longjmp(state->jump, 1);
}

std::uint64_t BlockCount(const jpeg_decompress_struct& decoder) {
  std::uint64_t count = 0;
  for (int i = 0; i < decoder.num_components; ++i) {
    const jpeg_component_info& component = decoder.comp_info[i];
    const auto blocks = [](JDIMENSION pixels, int factor, int most) {
      const std::uint64_t unit = std::uint64_t(most) * DCTSIZE;  // of the component with the most samples
      return (std::uint64_t(pixels) * std::uint64_t(factor) + unit - 1) / unit + std::uint64_t(factor);
    };
    count += blocks(decoder.image_width, component.h_samp_factor, decoder.max_h_samp_factor) *
             blocks(decoder.image_height, component.v_samp_factor, decoder.max_v_samp_factor);
  }
  return count;
}

// Whether all bits of all coefficients have been read: a progressive image stores them in several scans.
bool IsWhole(const jpeg_decompress_struct& decoder) {
  if (decoder.coef_bits == nullptr) return false;  // not progressive: not tracked
  for (int i = 0; i < decoder.num_components; ++i) {
    for (int k = 0; k < DCTSIZE2; ++k) {
      if (decoder.coef_bits[i][k] != 0) return false;
    }
  }
  return true;
}

// Memory for the coefficients of images with several scans, one array for each component. libjpeg's own arrays are in
// small pages, whose page faults take an eighth of the time of decoding a progressive image.
struct Coefficients {
  void* arrays[MAX_COMPONENTS];
  int count;
};

// The virtual array is just its rows: libjpeg treats the type as opaque.
jvirt_barray_ptr RequestCoefficients(j_common_ptr codec, int pool, boolean, JDIMENSION row_blocks, JDIMENSION row_count,
                                     JDIMENSION) {
  constexpr std::uintptr_t kAlignment = 64;  // libjpeg needs 32
  auto* all = static_cast<Coefficients*>(codec->client_data);
  auto* rows = static_cast<JBLOCKARRAY>(codec->mem->alloc_large(codec, pool, row_count * sizeof(JBLOCKROW)));
  const std::size_t bytes = std::size_t(row_blocks) * row_count * sizeof(JBLOCK) + kAlignment;
  // Zeros. Those of a large image usually take no physical memory until they are touched, which never happens for much
  // of a broken file.
  void* const memory = all->count < MAX_COMPONENTS ? std::calloc(bytes, 1) : nullptr;
  if (memory == nullptr) ERREXIT1(codec, JERR_OUT_OF_MEMORY, 0);
  all->arrays[all->count++] = memory;
  PreferHugePages(memory, bytes);
  const auto first = (reinterpret_cast<std::uintptr_t>(memory) + kAlignment - 1) / kAlignment * kAlignment;
  for (JDIMENSION y = 0; y < row_count; ++y) rows[y] = reinterpret_cast<JBLOCKROW>(first) + std::size_t(y) * row_blocks;
  return reinterpret_cast<jvirt_barray_ptr>(rows);
}

JBLOCKARRAY AccessCoefficients(j_common_ptr, jvirt_barray_ptr array, JDIMENSION first_row, JDIMENSION, boolean) {
  return reinterpret_cast<JBLOCKARRAY>(array) + first_row;
}

bool Create(jpeg_decompress_struct* decoder, JpegErrors* errors) {
  if (setjmp(errors->jump) != 0) return false;
  jpeg_create_decompress(decoder);
  decoder->mem->request_virt_barray = RequestCoefficients;
  decoder->mem->access_virt_barray = AccessCoefficients;
  return true;
}

bool Start(jpeg_decompress_struct* decoder, JpegErrors* errors, const unsigned char* data, std::size_t size) {
  if (setjmp(errors->jump) != 0) return false;
  jpeg_mem_src(decoder, data, size);
  jpeg_read_header(decoder, TRUE);
  switch (decoder->jpeg_color_space) {
    case JCS_GRAYSCALE: decoder->out_color_space = JCS_GRAYSCALE; break;
    case JCS_RGB:
    case JCS_YCbCr: decoder->out_color_space = JCS_RGB; break;
    case JCS_CMYK:
    case JCS_YCCK: decoder->out_color_space = JCS_CMYK; break;
    default: ERREXIT(decoder, JERR_CONVERSION_NOTIMPL);
  }
  decoder->dct_method = JDCT_ISLOW;
  decoder->do_fancy_upsampling = TRUE;
  decoder->do_block_smoothing = FALSE;  // it guesses missing data, and differs between versions
  return true;
}

// Decodes the next `count` rows, of which the first is row `first` of the image.
bool ReadRows(jpeg_decompress_struct* decoder, JpegErrors* errors, JSAMPROW* rows, JDIMENSION first, JDIMENSION count) {
  if (setjmp(errors->jump) != 0) return false;
  if (first == 0) {
    jpeg_start_decompress(decoder);  // reads all scans, if there are several
    if (errors->ended_early && jpeg_has_multiple_scans(decoder) && !IsWhole(*decoder)) {
      std::snprintf(errors->text, sizeof errors->text, "scans are missing at its end");
      return false;
    }
  }
  while (decoder->output_scanline < first + count) {
    const JDIMENSION at = decoder->output_scanline - first;
    jpeg_read_scanlines(decoder, rows + at, count - at);
  }
  if (decoder->output_scanline == decoder->output_height) jpeg_finish_decompress(decoder);
  return true;
}

struct Decoder {
  JpegErrors errors{};
  jpeg_decompress_struct decoder{};
  ScanGuard guard{};
  Coefficients coefficients{};
  Decoder() {
    decoder.err = BeginJpegErrors(errors);
    errors.manager.emit_message = OnMessage;
    if (!Create(&decoder, &errors)) throw Error(ErrorCode::OutOfMemory, std::string("libjpeg: ") + errors.text);
    guard.manager.progress_monitor = OnProgress;
    decoder.client_data = &coefficients;
  }
  ~Decoder() {
    jpeg_destroy_decompress(&decoder);
    for (int i = 0; i < coefficients.count; ++i) std::free(coefficients.arrays[i]);
  }
  Decoder(const Decoder&) = delete;
  Decoder& operator=(const Decoder&) = delete;
};

// Simple CMYK conversion, as browsers do without a colour profile. Adobe's files store 255 - ink.
void CmykToRgb(const std::vector<std::byte>& cmyk, bool inverted, Image& image) {
  const auto* from = reinterpret_cast<const unsigned char*>(cmyk.data());
  auto* to = image.As<unsigned char>();
  const unsigned flip = inverted ? 0u : 255u;
  for (std::size_t pixel = 0; pixel < image.PixelCount(); ++pixel) {
    const unsigned paper = from[4 * pixel + 3] ^ flip;
    for (std::size_t c = 0; c < 3; ++c) {
      to[3 * pixel + c] = static_cast<unsigned char>(((from[4 * pixel + c] ^ flip) * paper + 127u) / 255u);
    }
  }
}

}  // namespace

// Skips segments up to the frame header (SOF).
void ProbeJpeg(const FileStart& file, ImageHeader& header) {
  for (std::size_t at = 2; at < file.Size();) {
    // Like libjpeg, skips stray bytes, and accepts a repeated 0xFF.
    while (at < file.Size() && file.Byte(at) != 0xFF) ++at;
    while (at < file.Size() && file.Byte(at) == 0xFF) ++at;
    const std::uint32_t marker = file.Byte(at++);
    const bool alone = marker == 0x00 || marker == 0x01 || (marker >= 0xD0 && marker <= 0xD8);
    if (alone) continue;
    constexpr std::uint32_t kHuffmanTables = 0xC4, kReserved = 0xC8, kArithmetic = 0xCC, kEnd = 0xD9, kScan = 0xDA;
    if (marker == kEnd || marker == kScan) return;
    const std::uint32_t length = file.Big16(at);
    const bool frame =
        marker >= 0xC0 && marker <= 0xCF && marker != kHuffmanTables && marker != kReserved && marker != kArithmetic;
    if (frame) {
      if (length < 8 || !file.Has(at, 8)) return;
      header.bits = static_cast<int>(file.Byte(at + 2));
      header.height = static_cast<int>(file.Big16(at + 3));
      header.width = static_cast<int>(file.Big16(at + 5));
      const std::uint32_t components = file.Byte(at + 7);
      header.channels = components == 1 ? 1 : components == 3 || components == 4 ? 3 : 0;
      return;
    }
    if (length < 2) return;
    at += length;
  }
}

void DecodeJpeg(std::span<const std::byte> bytes, const std::string& name, int piece_rows,
                const PieceReceiver& receive) {
  Decoder jpeg;
  const auto fail = [&]() -> Error {
    if (jpeg.errors.manager.msg_code == JERR_OUT_OF_MEMORY) {
      return Error(ErrorCode::OutOfMemory, std::string("libjpeg: ") + jpeg.errors.text, name);
    }
    return Error(ErrorCode::InvalidInput, std::string("broken JPEG: ") + jpeg.errors.text, name);
  };
  if (!Start(&jpeg.decoder, &jpeg.errors, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size())) {
    throw fail();
  }
  CheckImageSize(jpeg.decoder.image_width, jpeg.decoder.image_height, name);
  const bool several_scans = jpeg_has_multiple_scans(&jpeg.decoder) != 0;
  const std::uint64_t blocks = BlockCount(jpeg.decoder);
  if (several_scans) {
    jpeg.guard.most =
        static_cast<int>(std::clamp(kMaxBlocks / std::max<std::uint64_t>(blocks, 1), kFewScans, kMaxScans));
    jpeg.decoder.progress = &jpeg.guard.manager;
  }
  const MemoryLease coefficients(several_scans ? blocks : 0, sizeof(JBLOCK), "the coefficients of JPEG images", name,
                                 "scale the image down");

  const bool inks = jpeg.decoder.out_color_space == JCS_CMYK;
  const int height = static_cast<int>(jpeg.decoder.image_height);
  Image image;
  image.width = static_cast<int>(jpeg.decoder.image_width);
  image.channels = jpeg.decoder.out_color_space == JCS_GRAYSCALE ? 1 : 3;
  image.type = ChannelType::U8;
  image.encoding = Encoding::Srgb;
  const std::size_t decoded_channels = inks ? 4 : static_cast<std::size_t>(image.channels);
  const std::size_t row_bytes = std::size_t(image.width) * decoded_channels;
  const int most_rows = std::min(piece_rows, height);
  const MemoryLease lease = LeaseImage(jpeg.decoder.image_width, jpeg.decoder.image_height, std::uint64_t(most_rows),
                                       decoded_channels + (inks ? 3 : 0), name);
  std::vector<std::byte> decoded = AllocatePixels(row_bytes * std::size_t(most_rows), name);
  for (int first = 0; first < height; first += image.height) {
    image.height = std::min(piece_rows, height - first);
    std::vector<JSAMPROW> rows(static_cast<std::size_t>(image.height));
    for (std::size_t y = 0; y < rows.size(); ++y) {
      rows[y] = reinterpret_cast<JSAMPROW>(decoded.data() + y * row_bytes);
    }
    if (!ReadRows(&jpeg.decoder, &jpeg.errors, rows.data(), static_cast<JDIMENSION>(first),
                  static_cast<JDIMENSION>(image.height))) {
      throw fail();
    }
    if (jpeg.errors.ended_early) image.damage = "the JPEG has no end marker";
    if (inks) {
      image.bytes = AllocatePixels(image.PixelCount() * 3, name);
      CmykToRgb(decoded, jpeg.decoder.saw_Adobe_marker != 0, image);
      receive(image, height);
      continue;
    }
    decoded.resize(row_bytes * rows.size());
    image.bytes.swap(decoded);
    receive(image, height);
    image.bytes.swap(decoded);
  }
}

}  // namespace facet
