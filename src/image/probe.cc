#include "image/probe.h"

#include <charconv>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string_view>

#include "image/jpeg.h"
#include "image/png.h"
#include "image/radiance.h"

namespace facet {
namespace {

using namespace std::string_view_literals;

// Bytes that may be cut off anywhere: what lies beyond the end reads as 0, so whoever must know asks Has().
class Reader {
 public:
  explicit Reader(std::span<const std::byte> bytes)
      : text_(bytes.empty() ? std::string_view()
                            : std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size())) {}

  std::size_t Size() const { return text_.size(); }
  bool Has(std::size_t at, std::size_t count) const { return at <= text_.size() && count <= text_.size() - at; }
  bool Is(std::size_t at, std::string_view what) const {
    return Has(at, what.size()) && text_.substr(at, what.size()) == what;
  }
  std::uint32_t Byte(std::size_t at) const { return at < text_.size() ? static_cast<unsigned char>(text_[at]) : 0u; }
  std::uint32_t Big16(std::size_t at) const { return Byte(at) << 8 | Byte(at + 1); }
  std::uint32_t Big32(std::size_t at) const { return Big16(at) << 16 | Big16(at + 2); }
  std::uint32_t Little16(std::size_t at) const { return Byte(at) | Byte(at + 1) << 8; }
  std::uint32_t Little24(std::size_t at) const { return Little16(at) | Byte(at + 2) << 16; }
  std::uint32_t Little32(std::size_t at) const { return Little16(at) | Little16(at + 2) << 16; }

  // From `at` up to the line break, which it passes. False: there is none.
  bool Line(std::size_t& at, std::string_view& line) const {
    const std::size_t end = text_.find('\n', at);
    if (end == std::string_view::npos) return false;
    line = text_.substr(at, end - at);
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    at = end + 1;
    return true;
  }

 private:
  std::string_view text_;
};

// A size that no int holds is as good as none.
int Side(std::uint64_t value) {
  return value <= static_cast<std::uint64_t>(std::numeric_limits<int>::max()) ? static_cast<int>(value) : 0;
}

// A transparent colour (tRNS) makes an alpha channel; it comes before the pixels (IDAT).
// True when the chunks up to there are in `file`; false leaves the question open.
bool FindPngTransparency(const Reader& file, bool& found) {
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

void ProbePng(const Reader& file, ImageHeader& header) {
  header.format = "PNG";
  if (!file.Has(8, 21) || file.Big32(8) != 13 || !file.Is(12, "IHDR")) return;
  header.width = Side(file.Big32(16));
  header.height = Side(file.Big32(20));
  header.bits = file.Byte(24) == 16 ? 16 : 8;
  constexpr int kGrey = 0, kColor = 2, kPalette = 3, kGreyAlpha = 4, kColorAlpha = 6;
  const int type = static_cast<int>(file.Byte(25));
  if (type == kGreyAlpha) header.channels = 2;
  if (type == kColorAlpha) header.channels = 4;
  if (type != kGrey && type != kColor && type != kPalette) return;
  bool transparent = false;
  if (FindPngTransparency(file, transparent)) header.channels = (type == kGrey ? 1 : 3) + (transparent ? 1 : 0);
}

// From segment to segment up to the frame header (SOF).
void ProbeJpeg(const Reader& file, ImageHeader& header) {
  header.format = "JPEG";
  for (std::size_t at = 2; at < file.Size();) {
    // As libjpeg does: bytes that belong to nothing are passed over, and 0xFF may be repeated.
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

bool LooksLikeWebP(const Reader& file) { return file.Is(0, "RIFF") && file.Is(8, "WEBP"); }

void ProbeWebP(const Reader& file, ImageHeader& header) {
  header.format = "WebP";
  constexpr std::size_t kData = 20;  // of the first chunk
  if (file.Is(12, "VP8 ") && file.Has(kData, 10)) {
    const bool key_frame = (file.Byte(kData) & 1) == 0;
    if (!key_frame || !file.Is(kData + 3, "\x9D\x01\x2A")) return;
    header.width = static_cast<int>(file.Little16(kData + 6) & 0x3FFF);  // above: scaling, which nobody applies
    header.height = static_cast<int>(file.Little16(kData + 8) & 0x3FFF);
    header.channels = 3;
  } else if (file.Is(12, "VP8L") && file.Has(kData, 5)) {
    if (file.Byte(kData) != 0x2F) return;
    const std::uint32_t packed = file.Little32(kData + 1);
    header.width = static_cast<int>(packed & 0x3FFF) + 1;
    header.height = static_cast<int>(packed >> 14 & 0x3FFF) + 1;
    header.channels = (packed >> 28 & 1) != 0 ? 4 : 3;
  } else if (file.Is(12, "VP8X") && file.Has(kData, 10)) {
    header.width = static_cast<int>(file.Little24(kData + 4)) + 1;
    header.height = static_cast<int>(file.Little24(kData + 7)) + 1;
    header.channels = (file.Byte(kData) & 0x10) != 0 ? 4 : 3;
  } else {
    return;
  }
  header.bits = 8;
}

bool LooksLikeKtx2(const Reader& file) { return file.Is(0, "\xABKTX 20\xBB\r\n\x1A\n"sv); }

// The basic block of the data format descriptor, 24 bytes and 16 for each sample.
void ProbeKtx2Descriptor(const Reader& file, std::size_t block, ImageHeader& header) {
  if (!file.Has(block, 24)) return;
  const std::size_t size = file.Little16(block + 6);
  if (file.Little32(block) != 0 || size < 40 || !file.Has(block, size)) return;  // vendor and type: Khronos, basic
  const std::size_t samples = (size - 24) / 16;
  const auto channel = [&](std::size_t sample) { return file.Byte(block + 24 + 16 * sample + 3) & 0xF; };
  constexpr std::uint32_t kPlain = 1, kEtc1s = 163, kUastc = 166;  // the color model
  switch (file.Byte(block + 8)) {
    case kPlain:
      if (samples > 4) return;
      header.channels = static_cast<int>(samples);
      header.bits = static_cast<int>(file.Byte(block + 24 + 2)) + 1;
      return;
    case kEtc1s: {  // a slice of RGB (0) or of one channel (3), perhaps with a slice of another (GGG 4, AAA 15)
      const int colors = channel(0) == 0 ? 3 : 1;
      header.channels = colors + (samples > 1 ? 1 : 0);
      header.bits = 8;
      return;
    }
    case kUastc: {  // RGB 0, RGBA 3, RRR 4, RRRG 5, RG 6
      const std::uint32_t id = channel(0);
      header.channels = id == 0 ? 3 : id == 3 ? 4 : id == 4 ? 1 : id == 5 || id == 6 ? 2 : 0;
      header.bits = 8;
      return;
    }
    default: return;  // blocks of other kinds do not say
  }
}

void ProbeKtx2(const Reader& file, ImageHeader& header) {
  header.format = "KTX2";
  if (!file.Has(0, 56)) return;
  header.width = Side(file.Little32(20));
  header.height = Side(file.Little32(24));
  const std::size_t descriptor = file.Little32(48);
  if (file.Little32(52) >= 4 + 40) ProbeKtx2Descriptor(file, descriptor + 4, header);  // after its total size
}

// "-Y 512 +X 1024", in either order and with any signs.
void ReadRadianceSize(std::string_view line, ImageHeader& header) {
  int width = 0, height = 0;
  for (int axis = 0; axis < 2; ++axis) {
    while (line.starts_with(' ')) line.remove_prefix(1);
    if (line.size() < 4 || (line[0] != '+' && line[0] != '-') || (line[1] != 'X' && line[1] != 'Y') || line[2] != ' ') {
      return;
    }
    int& side = line[1] == 'X' ? width : height;
    const char* const end = line.data() + line.size();
    std::uint64_t number = 0;
    const auto [after, bad] = std::from_chars(line.data() + 3, end, number);
    if (bad != std::errc()) return;
    side = Side(number);
    line = std::string_view(after, static_cast<std::size_t>(end - after));
  }
  header.width = width;
  header.height = height;
}

void ProbeRadiance(const Reader& file, ImageHeader& header) {
  header.format = "Radiance HDR";
  header.channels = 3;
  header.bits = 32;
  std::size_t at = 0;
  std::string_view line;
  do {
    if (!file.Line(at, line)) return;
  } while (!line.empty());
  if (file.Line(at, line)) ReadRadianceSize(line, header);
}

}  // namespace

std::optional<ImageHeader> ProbeImage(std::span<const std::byte> bytes) {
  const Reader file(bytes);
  ImageHeader header;
  header.bytes = bytes.size();
  if (LooksLikePng(bytes)) {
    ProbePng(file, header);
  } else if (LooksLikeJpeg(bytes)) {
    ProbeJpeg(file, header);
  } else if (LooksLikeWebP(file)) {
    ProbeWebP(file, header);
  } else if (LooksLikeKtx2(file)) {
    ProbeKtx2(file, header);
  } else if (LooksLikeRadiance(bytes)) {
    ProbeRadiance(file, header);
  } else {
    return std::nullopt;
  }
  return header;
}

}  // namespace facet
