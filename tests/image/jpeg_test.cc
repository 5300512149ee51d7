#include <cstdio>
#include <cstdlib>
#include <vector>

// jpeglib.h needs size_t and FILE to be known.
#include <jpeglib.h>

#include "base/memory_budget.h"
#include "facet/load.h"
#include "image/codec.h"
#include "image/image_test_util.h"

namespace facet {
namespace {

struct Settings {
  J_COLOR_SPACE space = JCS_RGB;
  int channels = 3;
  int width = 61, height = 45;
  bool progressive = false;
  int horizontal = 2, vertical = 2;  // chroma subsampling
  int quality = 90;
  bool adobe = true;
};

// Encodes smooth content of our own, so that a correct decoder comes close to it.
std::vector<std::byte> MakeJpeg(const Settings& settings, Image* source = nullptr) {
  Image image = MakePattern(settings.width, settings.height, settings.channels, ChannelType::U8);
  for (int y = 0; y < settings.height; ++y) {
    for (int x = 0; x < settings.width; ++x) {
      for (int c = 0; c < settings.channels; ++c) {
        image.As<unsigned char>()[(y * settings.width + x) * settings.channels + c] =
            static_cast<unsigned char>(40 + 2 * x + (c == 1 ? y : -y / 2) + 10 * c);
      }
    }
  }
  jpeg_compress_struct encoder;
  jpeg_error_mgr errors;
  encoder.err = jpeg_std_error(&errors);
  jpeg_create_compress(&encoder);
  unsigned char* memory = nullptr;
  unsigned long size = 0;
  jpeg_mem_dest(&encoder, &memory, &size);
  encoder.image_width = static_cast<JDIMENSION>(settings.width);
  encoder.image_height = static_cast<JDIMENSION>(settings.height);
  encoder.input_components = settings.channels;
  encoder.in_color_space = settings.space;
  jpeg_set_defaults(&encoder);
  jpeg_set_quality(&encoder, settings.quality, TRUE);
  if (settings.space == JCS_RGB) {
    encoder.comp_info[0].h_samp_factor = settings.horizontal;
    encoder.comp_info[0].v_samp_factor = settings.vertical;
  }
  if (!settings.adobe) encoder.write_Adobe_marker = FALSE;
  if (settings.progressive) jpeg_simple_progression(&encoder);
  jpeg_start_compress(&encoder, TRUE);
  for (int y = 0; y < settings.height; ++y) {
    JSAMPROW row = image.As<unsigned char>() + y * settings.width * settings.channels;
    jpeg_write_scanlines(&encoder, &row, 1);
  }
  jpeg_finish_compress(&encoder);
  std::vector<std::byte> out(reinterpret_cast<std::byte*>(memory), reinterpret_cast<std::byte*>(memory) + size);
  jpeg_destroy_compress(&encoder);
  std::free(memory);
  if (source) *source = image;
  return out;
}

int LargestDifference(const Image& a, const Image& b) {
  int largest = 0;
  for (std::size_t i = 0; i < a.bytes.size(); ++i) {
    largest = std::max(largest, std::abs(static_cast<int>(a.bytes[i]) - static_cast<int>(b.bytes[i])));
  }
  return largest;
}

TEST(Jpeg, ComesCloseToWhatWasEncoded) {
  for (const bool progressive : {false, true}) {
    for (const int subsampling : {1, 2}) {
      Settings settings;
      settings.progressive = progressive;
      settings.horizontal = settings.vertical = subsampling;
      Image source;
      const Image decoded = DecodeImage(MakeJpeg(settings, &source), "picture");
      ASSERT_EQ(decoded.bytes.size(), source.bytes.size());
      EXPECT_EQ(decoded.channels, 3);
      EXPECT_EQ(decoded.encoding, Encoding::Srgb);
      EXPECT_LE(LargestDifference(decoded, source), 12);
    }
  }
}

TEST(Jpeg, ProgressiveAndBaselineOfTheSameCoefficientsAreEqual) {
  Settings settings;
  const Image baseline = DecodeImage(MakeJpeg(settings), "baseline");
  settings.progressive = true;
  ExpectSame(DecodeImage(MakeJpeg(settings), "progressive"), baseline);
}

TEST(Jpeg, PiecesMakeTheWhole) {
  for (const bool progressive : {false, true}) {
    Settings settings;
    settings.progressive = progressive;
    settings.width = 75;
    settings.height = 201;
    const auto file = MakeJpeg(settings);
    int pieces = 0;
    ExpectSame(Joined(file, &pieces), DecodeImage(file, "whole"));
    EXPECT_EQ(pieces, 4);
  }
}

TEST(Jpeg, GreyStaysGrey) {
  Settings settings;
  settings.space = JCS_GRAYSCALE;
  settings.channels = 1;
  Image source;
  const Image decoded = DecodeImage(MakeJpeg(settings, &source), "grey");
  EXPECT_EQ(decoded.channels, 1);
  ASSERT_EQ(decoded.bytes.size(), source.bytes.size());
  EXPECT_LE(LargestDifference(decoded, source), 6);
}

// With Adobe's marker inks are stored inverted: colour = stored ink * stored black. Without it: (1 - ink)(1 - black).
TEST(Jpeg, InksBecomeRgb) {
  for (const bool adobe : {true, false}) {
    Settings settings;
    settings.space = JCS_CMYK;
    settings.channels = 4;
    settings.quality = 100;
    settings.adobe = adobe;
    Image source;
    const Image decoded = DecodeImage(MakeJpeg(settings, &source), "inks");
    ASSERT_EQ(decoded.channels, 3);
    double worst = 0.0;
    for (std::size_t i = 0; i < decoded.PixelCount(); ++i) {
      const auto value = [&](std::size_t c) {
        const double stored = source.As<unsigned char>()[4 * i + c] / 255.0;
        return adobe ? stored : 1.0 - stored;
      };
      for (std::size_t c = 0; c < 3; ++c) {
        worst = std::max(worst, std::abs(decoded.As<unsigned char>()[3 * i + c] - 255.0 * value(c) * value(3)));
      }
    }
    EXPECT_LE(worst, 4.0) << "adobe " << adobe;
  }
}

// Only the end marker may be missing: then all pixels are there, and it is told.
TEST(Jpeg, EveryTruncationIsAnErrorOrHarmless) {
  for (const bool progressive : {false, true}) {
    Settings settings;
    settings.progressive = progressive;
    const auto bytes = MakeJpeg(settings);
    const Image whole = DecodeImage(bytes, "whole");
    EXPECT_EQ(whole.damage, "");
    for (std::size_t length = 0; length < bytes.size(); ++length) {
      try {
        const Image cut = DecodeImage(std::span(bytes).first(length), "cut");
        EXPECT_TRUE(cut.bytes == whole.bytes) << length;
        EXPECT_EQ(cut.damage, "the JPEG has no end marker") << length;
      } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::InvalidInput) << length;
        EXPECT_LT(length, bytes.size() - 2) << error.what();
      }
    }
  }
}

// A scan of nothing costs a file some ten bytes, and a decoder a pass over the whole picture.
TEST(Jpeg, TooManyScansAreRefused) {
  Settings settings;
  settings.progressive = true;
  auto bytes = MakeJpeg(settings);
  // The second scan, the first of higher frequencies: another one sets the same coefficients to the same values.
  const std::string_view file(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const std::size_t begin = file.find("\xFF\xDA", file.find("\xFF\xDA") + 2), end = file.find("\xFF\xC4", begin);
  ASSERT_NE(end, std::string_view::npos);
  const std::vector<std::byte> scan(bytes.begin() + std::ptrdiff_t(begin), bytes.begin() + std::ptrdiff_t(end));
  std::vector<std::byte> scans;
  for (int i = 0; i < 400; ++i) scans.insert(scans.end(), scan.begin(), scan.end());
  bytes.insert(bytes.begin() + std::ptrdiff_t(end), scans.begin(), scans.end());
  EXPECT_TRUE(DecodeImage(bytes, "scans").bytes == DecodeImage(MakeJpeg(settings), "whole").bytes);
  bytes.insert(bytes.begin() + std::ptrdiff_t(end), scans.begin(), scans.end());
  std::string what;
  EXPECT_EQ(CodeOf([&] { DecodeImage(bytes, "scans"); }, &what), ErrorCode::InvalidInput);
  EXPECT_EQ(what, "scans: broken JPEG: more than 500 scans");
}

// All coefficients of a progressive picture are in memory at once.
TEST(Jpeg, TheMemoryLimitHoldsForCoefficients) {
  Settings settings;
  settings.progressive = true;
  settings.width = settings.height = 1024;
  const auto bytes = MakeJpeg(settings);
  MemoryBudget budget(std::uint64_t{2} << 20);
  const MemoryBudget::Scope scope(budget);
  std::string what;
  EXPECT_EQ(CodeOf([&] { DecodeImageRows(bytes, "large.jpg", [](const Image&, int) {}); }, &what),
            ErrorCode::OutOfMemory);
  EXPECT_NE(what.find("for the coefficients of JPEG images"), std::string::npos) << what;
  settings.progressive = false;
  DecodeImageRows(MakeJpeg(settings), "large.jpg", [](const Image&, int) {});
}

TEST(Jpeg, FlippedBytesNeverCrash) {
  Settings settings;
  settings.progressive = true;
  const auto bytes = MakeJpeg(settings);
  for (std::size_t at = 2; at < bytes.size(); ++at) {
    auto broken = bytes;
    broken[at] ^= std::byte{0xFF};
    try {
      DecodeImage(broken, "flipped");
    } catch (const Error&) {
    }
  }
}

TEST(Jpeg, RefusesBombs) {
  auto bytes = MakeJpeg({});
  for (std::size_t at = 2; at + 9 < bytes.size(); ++at) {
    if (bytes[at] == std::byte{0xFF} && bytes[at + 1] == std::byte{0xC0}) {
      for (std::size_t i = 5; i < 9; ++i) bytes[at + i] = std::byte{0xFE};  // 65278 x 65278
      break;
    }
  }
  std::string what;
  EXPECT_EQ(CodeOf([&] { DecodeImage(bytes, "bomb"); }, &what), ErrorCode::OutOfMemory);
  EXPECT_NE(what.find("65278 x 65278"), std::string::npos) << what;
}

// Prints the hash of everything that this file decodes; run by the next test in processes of their own.
TEST(JpegHash, Print) {
  std::vector<std::byte> all;
  for (const bool progressive : {false, true}) {
    for (int h = 1; h <= 2; ++h) {
      for (int v = 1; v <= 2; ++v) {
        Settings settings;
        settings.progressive = progressive;
        settings.horizontal = h;
        settings.vertical = v;
        settings.width = 133;
        settings.height = 77;
        const Image image = DecodeImage(MakeJpeg(settings), "picture");
        all.insert(all.end(), image.bytes.begin(), image.bytes.end());
      }
    }
  }
  // The encoder has SIMD too: its files are part of the answer only through what is decoded from the corpus.
  const auto folder = Corpus() / "asset-generator" / "SampleImages";
  std::vector<std::filesystem::path> files;
  if (std::filesystem::exists(folder)) {
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      if (entry.path().extension() == ".jpg") files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  if (files.size() > 20) files.resize(20);
  for (const auto& path : files) {
    const Image image = LoadImage(path);
    all.insert(all.end(), image.bytes.begin(), image.bytes.end());
  }
  std::printf("hash %016llx\n", static_cast<unsigned long long>(HashOf(all)));
}

std::string HashLine(const char* environment) {
  const std::string program = std::filesystem::read_symlink("/proc/self/exe").string();
  const std::string command = std::string(environment) + " '" + program + "' --gtest_filter=JpegHash.Print";
  FILE* pipe = popen(command.c_str(), "r");
  if (!pipe) return "popen failed";
  std::string found;
  char line[512];
  while (std::fgets(line, sizeof line, pipe)) {
    if (std::string(line).starts_with("hash ")) found = line;
  }
  pclose(pipe);
  return found;
}

TEST(Jpeg, TheSameBitsWithAndWithoutSimd) {
  const std::string with = HashLine("JSIMD_FORCENONE=0");
  EXPECT_FALSE(with.empty());
  EXPECT_EQ(HashLine("JSIMD_FORCENONE=1"), with);
}

}  // namespace
}  // namespace facet
