// What the first bytes of a picture say.
#include <string_view>

#include "image/codec.h"
#include "image/image_test_util.h"

namespace facet {
namespace {

using namespace std::string_literals;

// A copy of exactly that many bytes on the heap, so that a sanitizer sees a read past their end.
std::optional<ImageHeader> Probe(std::string_view text) {
  const auto* begin = reinterpret_cast<const std::byte*>(text.data());
  const std::vector<std::byte> bytes(begin, begin + text.size());
  return ProbeImage(bytes);
}

std::string Big16(unsigned v) { return {static_cast<char>(v >> 8 & 255), static_cast<char>(v & 255)}; }
std::string Big32(unsigned v) { return Big16(v >> 16) + Big16(v & 0xFFFF); }
std::string Little16(unsigned v) { return {static_cast<char>(v & 255), static_cast<char>(v >> 8 & 255)}; }
std::string Little32(unsigned v) { return Little16(v & 0xFFFF) + Little16(v >> 16); }

void ExpectHeader(const std::string& file, const char* format, int width, int height, int channels, int bits) {
  const auto header = Probe(file);
  ASSERT_TRUE(header);
  EXPECT_EQ(header->format, format);
  EXPECT_EQ(header->width, width);
  EXPECT_EQ(header->height, height);
  EXPECT_EQ(header->channels, channels);
  EXPECT_EQ(header->bits, bits);
  EXPECT_EQ(header->bytes, file.size());
}

std::string Chunk(const std::string& type, const std::string& data) {
  return Big32(static_cast<unsigned>(data.size())) + type + data + "CRC!";
}

std::string Png(unsigned width, unsigned height, char bits, char type, const std::string& chunks) {
  return "\x89PNG\r\n\x1A\n" + Chunk("IHDR", Big32(width) + Big32(height) + bits + type + "\0\0\0"s) + chunks +
         Chunk("IDAT", "pixels");
}

std::string Segment(unsigned marker, const std::string& data) {
  return "\xFF"s + static_cast<char>(marker) + Big16(static_cast<unsigned>(data.size()) + 2) + data;
}

std::string Frame(unsigned marker, unsigned width, unsigned height, char components) {
  return Segment(marker, "\x08"s + Big16(height) + Big16(width) + components +
                             std::string(3 * static_cast<std::size_t>(components), '\x11'));
}

std::string WebP(const std::string& type, const std::string& data) {
  const std::string chunk = type + Little32(static_cast<unsigned>(data.size())) + data;
  return "RIFF" + Little32(static_cast<unsigned>(chunk.size()) + 4) + "WEBP" + chunk;
}

std::string Ktx2(unsigned width, unsigned height, char model, const std::vector<std::string>& samples) {
  std::string block = Little32(0) + Little16(2) + Little16(static_cast<unsigned>(24 + 16 * samples.size())) + model +
                      std::string(15, '\1');
  for (const std::string& sample : samples) block += sample + std::string(12, '\0');
  const auto descriptor_size = static_cast<unsigned>(block.size()) + 4;
  return "\xABKTX 20\xBB\r\n\x1A\n"s + Little32(0) + Little32(1) + Little32(width) + Little32(height) + Little32(0) +
         Little32(0) + Little32(1) + Little32(1) + Little32(0) + Little32(104) + Little32(descriptor_size) +
         std::string(48, '\0') + Little32(descriptor_size) + block;
}

// Bit offset 0, so many bits, a channel.
std::string Sample(unsigned bits, unsigned channel) {
  return Little16(0) + static_cast<char>(bits - 1) + static_cast<char>(channel);
}

const std::string kHdr = "#?RADIANCE\nEXPOSURE=1\nFORMAT=32-bit_rle_rgbe\n\n-Y 512 +X 1024\nrows";

std::vector<std::string> Examples() {
  return {Png(7, 5, 8, 2, Chunk("gAMA", "abcd") + Chunk("tRNS", "rgbrgb")),
          "\xFF\xD8" + Segment(0xE0, "JFIF") + "\xFF\xFF" + Segment(0xDB, "table") + Frame(0xC2, 640, 480, 3),
          WebP("VP8 ", "\x10\0\0\x9D\x01\x2A"s + Little16(300) + Little16(200)),
          WebP("VP8L", "\x2F"s + Little32(299u | 199u << 14 | 1u << 28)),
          WebP("VP8X", "\x10\0\0\0\xFF\x03\0\xFE\x01\0"s),
          Ktx2(64, 32, '\xA6', {Sample(128, 3)}),
          kHdr};
}

TEST(Probe, Png) {
  ExpectHeader(Png(7, 5, 8, 0, ""), "PNG", 7, 5, 1, 8);
  ExpectHeader(Png(7, 5, 16, 2, ""), "PNG", 7, 5, 3, 16);
  ExpectHeader(Png(7, 5, 4, 3, Chunk("PLTE", "rgb")), "PNG", 7, 5, 3, 8);
  ExpectHeader(Png(7, 5, 4, 3, Chunk("PLTE", "rgb") + Chunk("tRNS", "a")), "PNG", 7, 5, 4, 8);
  ExpectHeader(Png(7, 5, 1, 0, Chunk("tRNS", "ab")), "PNG", 7, 5, 2, 8);
  ExpectHeader(Png(7, 5, 8, 4, ""), "PNG", 7, 5, 2, 8);
  ExpectHeader(Png(70000, 0x7FFFFFFF, 16, 6, ""), "PNG", 70000, 0x7FFFFFFF, 4, 16);
  ExpectHeader(Png(0x80000000u, 0xFFFFFFFFu, 8, 6, ""), "PNG", 0, 0, 4, 8);
  // Whether there is alpha is said between the header and the pixels.
  ExpectHeader(Png(7, 5, 8, 2, "").substr(0, 33), "PNG", 7, 5, 0, 8);
  ExpectHeader(Png(7, 5, 8, 6, "").substr(0, 33), "PNG", 7, 5, 4, 8);
  ExpectHeader(Png(7, 5, 8, 2, Big32(0xFFFFFFFFu) + "iCCP"), "PNG", 7, 5, 0, 8);
}

TEST(Probe, PngThatFacetWrites) {
  for (const ChannelType type : {ChannelType::U8, ChannelType::U16}) {
    for (int channels = 1; channels <= 4; ++channels) {
      const auto file = EncodePng(MakePattern(19, 3, channels, type), {{"Title", "x"}});
      const std::string text(reinterpret_cast<const char*>(file.data()), file.size());
      ExpectHeader(text, "PNG", 19, 3, channels, 8 * static_cast<int>(SizeOf(type)));
    }
  }
}

TEST(Probe, Jpeg) {
  const std::string start = "\xFF\xD8";
  for (const unsigned marker : {0xC0u, 0xC1u, 0xC2u, 0xC3u, 0xC9u, 0xCFu}) {
    ExpectHeader(start + Frame(marker, 640, 65535, 3), "JPEG", 640, 65535, 3, 8);
  }
  ExpectHeader(start + Segment(0xE1, "Exif") + Frame(0xC0, 1, 2, 1), "JPEG", 1, 2, 1, 8);
  ExpectHeader(start + Frame(0xC0, 1, 2, 4), "JPEG", 1, 2, 3, 8);
  // Tables, reserved markers and a picture within a segment are no frames; fill bytes and strays are passed over.
  const std::string preview = start + Frame(0xC0, 160, 120, 3);
  ExpectHeader(start + Segment(0xE1, preview) + Segment(0xC4, preview) + "\xFF\xFF\xFF" + Segment(0xCC, "xx") +
                   "stray\xFF\x01" + Frame(0xC2, 900, 800, 3),
               "JPEG", 900, 800, 3, 8);
  // Behind 200 kB of profile.
  const std::string profile = Segment(0xE2, std::string(65533, '\xFF'));
  ExpectHeader(start + profile + profile + profile + Frame(0xC0, 9, 8, 3), "JPEG", 9, 8, 3, 8);
  // The scan begins without a frame; a segment shorter than its own length; the end.
  ExpectHeader(start + Segment(0xDA, "") + Frame(0xC0, 9, 8, 3), "JPEG", 0, 0, 0, 0);
  ExpectHeader(start + "\xFF\xE0\0\1"s + Frame(0xC0, 9, 8, 3), "JPEG", 0, 0, 0, 0);
  ExpectHeader(start + "\xFF\xD9" + Frame(0xC0, 9, 8, 3), "JPEG", 0, 0, 0, 0);
}

TEST(Probe, WebP) {
  const auto lossy = [](char tag, unsigned width, unsigned height) {
    return WebP("VP8 ", tag + "\0\0\x9D\x01\x2A"s + Little16(width) + Little16(height));
  };
  ExpectHeader(lossy('\x10', 300, 200), "WebP", 300, 200, 3, 8);
  ExpectHeader(lossy('\x10', 300 | 0x4000, 200 | 0xC000), "WebP", 300, 200, 3, 8);
  ExpectHeader(lossy('\x11', 300, 200), "WebP", 0, 0, 0, 0);  // no key frame
  const auto lossless = [](unsigned width, unsigned height, unsigned alpha) {
    return WebP("VP8L", "\x2F"s + Little32((width - 1) | (height - 1) << 14 | alpha << 28));
  };
  ExpectHeader(lossless(300, 200, 0), "WebP", 300, 200, 3, 8);
  ExpectHeader(lossless(16384, 1, 1), "WebP", 16384, 1, 4, 8);
  ExpectHeader(WebP("VP8X", "\x10\0\0\0\xFF\x03\0\xFE\x01\0"s), "WebP", 1024, 511, 4, 8);
  ExpectHeader(WebP("VP8X", "\0\0\0\0\0\0\1\xFE\x01\0"s), "WebP", 65537, 511, 3, 8);
  ExpectHeader(WebP("ICCP", "0123456789"), "WebP", 0, 0, 0, 0);
}

TEST(Probe, Ktx2) {
  ExpectHeader(Ktx2(64, 32, '\xA3', {Sample(64, 0)}), "KTX2", 64, 32, 3, 8);
  ExpectHeader(Ktx2(64, 32, '\xA3', {Sample(64, 0), Sample(64, 15)}), "KTX2", 64, 32, 4, 8);
  ExpectHeader(Ktx2(64, 32, '\xA3', {Sample(64, 3), Sample(64, 4)}), "KTX2", 64, 32, 2, 8);
  ExpectHeader(Ktx2(64, 32, '\xA6', {Sample(128, 0)}), "KTX2", 64, 32, 3, 8);
  ExpectHeader(Ktx2(64, 32, '\xA6', {Sample(128, 3)}), "KTX2", 64, 32, 4, 8);
  ExpectHeader(Ktx2(64, 32, '\1', {Sample(16, 0), Sample(16, 1), Sample(16, 2)}), "KTX2", 64, 32, 3, 16);
  ExpectHeader(Ktx2(64, 32, '\x86', {Sample(128, 0)}), "KTX2", 64, 32, 0, 0);  // BC7
  ExpectHeader(Ktx2(0xFFFFFFFFu, 0, '\x86', {Sample(128, 0)}), "KTX2", 0, 0, 0, 0);
  std::string far = Ktx2(64, 32, '\xA3', {Sample(64, 0)});
  far.replace(48, 4, Little32(0xFFFFFFFFu));
  ExpectHeader(far, "KTX2", 64, 32, 0, 0);
}

TEST(Probe, Radiance) {
  ExpectHeader(kHdr, "Radiance HDR", 1024, 512, 3, 32);
  ExpectHeader("#?RGBE\r\n\r\n+X 3 +Y 4\r\n", "Radiance HDR", 3, 4, 3, 32);
  ExpectHeader("#?RADIANCE\n\n-Y 512 +X 1024", "Radiance HDR", 0, 0, 3, 32);  // the number may go on
  ExpectHeader("#?RADIANCE\n\n-Y 512 +Z 1024\n", "Radiance HDR", 0, 0, 3, 32);
  ExpectHeader("#?RADIANCE\n\n-Y 99999999999999999999 +X 1\n", "Radiance HDR", 0, 0, 3, 32);
  ExpectHeader("#?RADIANCE\nno end", "Radiance HDR", 0, 0, 3, 32);
}

TEST(Probe, NothingIsSaidOfWhatIsNoPicture) {
  for (const std::string& text : {""s, "\xFF"s, "glTF"s, "{\"asset\":{}}"s, "RIFF\0\0\0\0WAVEfmt "s, "\x89PNG"s}) {
    EXPECT_FALSE(Probe(text)) << text;
  }
  EXPECT_FALSE(ProbeImage({}));
}

// A shorter piece says less, and never something else.
void ExpectLessFromLess(const std::string& file, std::size_t most) {
  const auto whole = Probe(file);
  ASSERT_TRUE(whole);
  for (std::size_t size = 0; size <= std::min(most, file.size()); ++size) {
    const auto part = Probe(std::string_view(file).substr(0, size));
    if (!part) {
      EXPECT_LT(size, 12u);
      continue;
    }
    EXPECT_EQ(part->format, whole->format);
    EXPECT_EQ(part->bytes, size);
    EXPECT_TRUE(part->width == 0 || part->width == whole->width) << size;
    EXPECT_TRUE(part->height == 0 || part->height == whole->height) << size;
    EXPECT_TRUE(part->channels == 0 || part->channels == whole->channels) << size;
    EXPECT_TRUE(part->bits == 0 || part->bits == whole->bits) << size;
  }
}

TEST(Probe, PiecesOfEveryLength) {
  for (const std::string& file : Examples()) ExpectLessFromLess(file, file.size());
}

TEST(Probe, AnyBytes) {
  std::uint32_t state = 1;
  const auto next = [&state] { return (state = state * 1664525u + 1013904223u) >> 8; };
  for (const std::string& file : Examples()) {
    for (int i = 0; i < 3000; ++i) {
      std::string changed = file;
      for (std::uint32_t k = next() % 6 + 1; k > 0; --k) changed[next() % changed.size()] = static_cast<char>(next());
      const auto header = Probe(changed);
      if (!header) continue;
      EXPECT_GE(header->width, 0);
      EXPECT_GE(header->height, 0);
      EXPECT_GE(header->channels, 0);
      EXPECT_LE(header->channels, 4);
    }
  }
}

TEST(Probe, AgreesWithDecodingOnTheCorpus) {
  FACET_NEEDS_CORPUS();
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(Corpus())) {
    if (entry.path().string().find("/malformed/") != std::string::npos) continue;
    const std::string extension = entry.path().extension().string();
    for (const char* known : {".png", ".jpg", ".jpeg", ".hdr", ".webp", ".ktx2"}) {
      if (extension == known) paths.push_back(entry.path());
    }
  }
  std::sort(paths.begin(), paths.end());
  int probed = 0, decoded = 0;
  std::size_t webp_count = 0;
  for (const auto& path : paths) {
    SCOPED_TRACE(path.string());
    const auto bytes = ReadBytes(path);
    const auto header = ProbeImage(bytes);
    ASSERT_TRUE(header);
    EXPECT_GT(header->width, 0);
    EXPECT_GT(header->height, 0);
    EXPECT_GT(header->channels, 0);
    EXPECT_EQ(header->bytes, bytes.size());
    ++probed;
    if (header->format == "KTX2") continue;  // there is no decoder
    if (header->format == "WebP" && webp_count++ % 16 != 0) continue;
    const Image image = DecodeImage(bytes, path.string());
    EXPECT_EQ(header->width, image.width);
    EXPECT_EQ(header->height, image.height);
    EXPECT_EQ(header->channels, image.channels);
    EXPECT_EQ(header->bits, 8 * static_cast<int>(SizeOf(image.type)));
    const std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (decoded++ % 8 == 0) ExpectLessFromLess(text, 1500);
  }
  EXPECT_GT(probed, 350);
  EXPECT_GT(decoded, 190);
}

}  // namespace
}  // namespace facet
