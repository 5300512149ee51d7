// The OpenImageIO module: formats that facet itself does not read, agreement with facet's decoders, and its absence.
#include <chrono>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "base/output_file.h"
#include "facet/film.h"
#include "facet/load.h"
#include "image/codec.h"
#include "image/convert.h"
#include "image/image_test_util.h"
#include "image/oiio_loader.h"

namespace facet {
namespace {

#define FACET_NEEDS_MODULE()                                             \
  try {                                                                  \
    EncodeWithOiio("ppm", MakePattern(1, 1, 3, ChannelType::U8), false); \
  } catch (const Error& error) {                                         \
    GTEST_SKIP() << error.what();                                        \
  }

std::vector<std::filesystem::path> Files(const std::filesystem::path& folder, const char* extension) {
  std::vector<std::filesystem::path> out;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.path().extension() == extension) out.push_back(entry.path());
  }
  std::sort(out.begin(), out.end());
  return out;
}

TEST(Module, FilesAreAFunctionOfThePictureAlone) {
  TemporaryFolder folder;
  const Image image = MakePattern(16, 16, 3, ChannelType::F32);
  for (const char* name : {"a.exr", "a.tif"}) {
    WriteImage(folder / name, image);
    const std::vector<std::byte> first = ReadBytes(folder / name);
    std::this_thread::sleep_for(std::chrono::milliseconds(1100));  // clocks in files count seconds
    WriteImage(folder / name, image);
    EXPECT_EQ(ReadBytes(folder / name), first) << name;
  }
}

TEST(Module, AgreesWithOursOnEveryPngOfTheCorpus) {
  FACET_NEEDS_CORPUS();
  FACET_NEEDS_MODULE();
  int compared = 0;
  for (const auto& path : Files(Corpus() / "models", ".png")) {
    const auto bytes = ReadBytes(path);
    Image ours;
    try {
      ours = DecodeImage(bytes, path.string());
    } catch (const Error& error) {
      ADD_FAILURE() << error.what();
      continue;
    }
    const Image theirs = DecodeWithOiio(bytes, "png", "picture");
    SCOPED_TRACE(path.string());
    EXPECT_EQ(ours.width, theirs.width);
    // OpenImageIO leaves small depths and tRNS to itself in ways of its own: compare what has the same form.
    if (ours.channels != theirs.channels || ours.type != theirs.type) continue;
    EXPECT_TRUE(ours.bytes == theirs.bytes);
    ++compared;
  }
  EXPECT_GT(compared, 30);
}

TEST(Module, AgreesWithOursOnJpegsOfTheCorpus) {
  FACET_NEEDS_CORPUS();
  FACET_NEEDS_MODULE();
  int compared = 0;
  for (const auto& path : Files(Corpus(), ".jpg")) {
    if (compared >= 60) break;
    SCOPED_TRACE(path.string());
    const auto bytes = ReadBytes(path);
    ExpectSame(DecodeImage(bytes, path.string()), DecodeWithOiio(bytes, "jpg", "picture"));
    ++compared;
  }
  EXPECT_GT(compared, 0);
}

TEST(Module, OpenExrKeepsLinearFloatsAndHidesAssociatedAlpha) {
  FACET_NEEDS_MODULE();
  TemporaryFolder folder;
  for (const int channels : {1, 3}) {
    const Image image = MakePattern(37, 21, channels, ChannelType::F32, Encoding::Linear);
    WriteImage(folder / "opaque.exr", image);
    ExpectSame(LoadImage(folder / "opaque.exr"), image);
  }
  // Alpha of powers of two makes multiplication and division exact.
  Image image = MakePattern(37, 21, 4, ChannelType::F32, Encoding::Linear);
  for (std::size_t i = 0; i < image.PixelCount(); ++i) image.As<float>()[4 * i + 3] = std::ldexp(1.0f, -int(i % 5));
  WriteImage(folder / "alpha.exr", image);
  ExpectSame(LoadImage(folder / "alpha.exr"), image);
}

TEST(Module, EightBitsInExrAreLinearLight) {
  FACET_NEEDS_MODULE();
  TemporaryFolder folder;
  Image image = MakePattern(1, 1, 4, ChannelType::U8);
  const std::uint8_t pixel[4] = {188, 0, 255, 51};
  std::copy(pixel, pixel + 4, image.As<std::uint8_t>());
  WriteImage(folder / "a.exr", image);
  const Image back = LoadImage(folder / "a.exr");
  ASSERT_EQ(back.channels, 4);
  EXPECT_EQ(back.encoding, Encoding::Linear);
  EXPECT_NEAR(back.As<float>()[0], 0.5029, 1e-4);  // ((188/255 + 0.055) / 1.055)^2.4
  EXPECT_EQ(back.As<float>()[1], 0.0f);
  EXPECT_NEAR(back.As<float>()[2], 1.0f, 1e-6);
  EXPECT_FLOAT_EQ(back.As<float>()[3], 0.2f);
}

TEST(Module, RadianceRoundTripIsWithinItsMantissa) {
  FACET_NEEDS_MODULE();
  TemporaryFolder folder;
  const Image image = MakePattern(64, 9, 3, ChannelType::F32, Encoding::Linear);
  WriteImage(folder / "a.hdr", image);
  const Image back = LoadImage(folder / "a.hdr");
  ASSERT_EQ(back.bytes.size(), image.bytes.size());
  for (std::size_t i = 0; i < image.PixelCount(); ++i) {
    const float* a = image.As<float>() + 3 * i;
    const float* b = back.As<float>() + 3 * i;
    const float largest = std::max({a[0], a[1], a[2]});
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], largest / 128.0f);
  }
}

TEST(Module, OtherFormatsRoundTrip) {
  FACET_NEEDS_MODULE();
  TemporaryFolder folder;
  for (const ChannelType type : {ChannelType::U8, ChannelType::U16}) {
    for (const int channels : {1, 3, 4}) {
      const Image image = MakePattern(31, 17, channels, type);
      WriteImage(folder / "a.tif", image);
      ExpectSame(LoadImage(folder / "a.tif"), image);
    }
  }
  Image opaque = MakePattern(31, 17, 3, ChannelType::U8);
  for (const char* name : {"a.bmp", "a.tga", "a.ppm"}) {
    SCOPED_TRACE(name);
    WriteImage(folder / name, opaque);
    const Image back = LoadImage(folder / name);
    EXPECT_TRUE(WithChannels(back, 3).bytes == opaque.bytes);
  }
  const Image clear = MakePattern(31, 17, 4, ChannelType::U8);
  WriteImage(folder / "clear.tga", clear);
  ExpectSame(LoadImage(folder / "clear.tga"), clear);
  for (const char* name : {"a.jpg", "a.bmp"}) {
    EXPECT_EQ(CodeOf([&] { WriteImage(folder / name, clear); }), ErrorCode::InvalidUsage) << name;
  }
}

TEST(Module, ItsAbsenceIsOneClearLine) {
  const std::vector<std::filesystem::path> nowhere = {"/nonexistent"};
  OverrideOiioSearch(&nowhere);
  std::string what;
  std::vector<std::byte> exr(64);
  exr[0] = std::byte{0x76}, exr[1] = std::byte{0x2F}, exr[2] = std::byte{0x31}, exr[3] = std::byte{0x01};
  EXPECT_EQ(CodeOf([&] { DecodeImage(exr, "sky.exr"); }, &what), ErrorCode::MissingModule);
  EXPECT_NE(what.find("sky.exr"), std::string::npos) << what;
  EXPECT_NE(what.find("facet_oiio.so"), std::string::npos) << what;
  EXPECT_NE(what.find("FACET_MODULE_PATH"), std::string::npos) << what;
  TemporaryFolder folder;
  EXPECT_EQ(CodeOf([&] { WriteImage(folder / "a.exr", MakePattern(2, 2, 3, ChannelType::F32, Encoding::Linear)); }),
            ErrorCode::MissingModule);
  EXPECT_TRUE(folder.Names().empty());
  // A file of that name that is no module: its own trouble is reported.
  const std::vector<std::filesystem::path> broken = {folder.path()};
  WriteFile(folder / "facet_oiio.so", exr);
  OverrideOiioSearch(&broken);
  EXPECT_EQ(CodeOf([&] { DecodeImage(exr, "sky.exr"); }, &what), ErrorCode::MissingModule);
  EXPECT_NE(what.find("does not open"), std::string::npos) << what;
  OverrideOiioSearch(nullptr);
}

TEST(Module, TheEnvironmentVariableComesFirst) {
  const char* before = std::getenv("FACET_MODULE_PATH");
  const std::string saved = before ? before : "";
  setenv("FACET_MODULE_PATH", "/first::/second", 1);
  const auto candidates = OiioModuleCandidates();
  ASSERT_GT(candidates.size(), 3u);
  EXPECT_EQ(candidates[0], "/first/facet_oiio.so");
  EXPECT_EQ(candidates[1], "/second/facet_oiio.so");
  EXPECT_EQ(candidates.back(), "facet_oiio.so");
  if (before) {
    setenv("FACET_MODULE_PATH", saved.c_str(), 1);
  } else {
    unsetenv("FACET_MODULE_PATH");
  }
}

TEST(Module, UnknownContentIsAnError) {
  FACET_NEEDS_MODULE();
  const std::vector<std::byte> noise(1000, std::byte{0x5A});
  EXPECT_EQ(CodeOf([&] { DecodeImage(noise, "noise.png"); }), ErrorCode::InvalidInput);
  EXPECT_EQ(CodeOf([&] { DecodeImage({}, "empty.png"); }), ErrorCode::InvalidInput);
  std::vector<std::byte> exr = noise;
  exr[0] = std::byte{0x76}, exr[1] = std::byte{0x2F}, exr[2] = std::byte{0x31}, exr[3] = std::byte{0x01};
  EXPECT_EQ(CodeOf([&] { DecodeImage(exr, "noise.exr"); }), ErrorCode::InvalidInput);
}

std::string Word(std::uint32_t number) { return {reinterpret_cast<const char*>(&number), sizeof number}; }

std::string Attribute(const std::string& name, const std::string& type, const std::string& value) {
  return name + '\0' + type + '\0' + Word(static_cast<std::uint32_t>(value.size())) + value;
}

// OpenEXR, which would take memory for what these headers say, never sees them: each is refused with or without the
// module.
TEST(Module, ExrHeadersAreCheckedBeforeOpenExrReadsThem) {
  const auto refusal = [](const std::string& attributes, std::uint32_t flags, ErrorCode code) {
    const std::string file = Word(20000630) + Word(2 | flags) + attributes + '\0';
    std::string what;
    EXPECT_EQ(CodeOf([&] { DecodeImage(std::as_bytes(std::span(file)), "a.exr"); }, &what), code) << what;
    return what;
  };
  const std::string cut_off = "a.exr: broken EXR: its header is cut off";
  const std::string beyond = std::string("secret\0opaque\0", 14) + Word(0x70000000);
  const std::string preview = Attribute("preview", "preview", Word(20000) + Word(20000) + std::string(16, 'a'));
  const std::string texts = Attribute("views", "stringvector", Word(4) + "left" + Word(0x70000000) + "right");
  const std::string chunks = Attribute("chunkCount", "int", Word(0x10000000));
  // Values of another length than their type has.
  const std::string channels =
      Attribute("channels", "chlist", "R" + std::string(17, '\0') + "G" + std::string(17, '\0'));
  const std::string number = Attribute("number", "int", Word(1) + Word(2));
  for (const std::string& attribute : {beyond, preview, texts, chunks, channels, number}) {
    EXPECT_EQ(refusal(attribute, 0, ErrorCode::InvalidInput), cut_off);
  }
  const std::string wide = Attribute("dataWindow", "box2i", Word(0x80000000) + Word(0) + Word(0x7FFFFFFF) + Word(0));
  EXPECT_NE(refusal(wide, 0, ErrorCode::OutOfMemory).find("4294967296 x 1"), std::string::npos);
  const std::string empty = Attribute("dataWindow", "box2i", Word(5) + Word(0) + Word(4) + Word(0));
  EXPECT_NE(refusal(empty, 0, ErrorCode::InvalidInput).find("empty"), std::string::npos);
  const std::string tiles = Attribute("tiles", "tiledesc", Word(100000) + Word(100000) + '\0');
  EXPECT_NE(refusal(tiles, 0, ErrorCode::OutOfMemory).find("100000 x 100000"), std::string::npos);
  // The second part of several counts as well.
  constexpr std::uint32_t kSeveralParts = 0x1000;
  const std::string first = Attribute("owner", "string", "nobody") + '\0';
  EXPECT_EQ(refusal(first + preview, kSeveralParts, ErrorCode::InvalidInput), cut_off);
}

}  // namespace
}  // namespace facet
