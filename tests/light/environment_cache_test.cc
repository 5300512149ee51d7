// Prepared environments that are kept in files: the same bits back, or nothing.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <functional>
#include <iterator>
#include <thread>
#include <tuple>

#include "base/sha256.h"
#include "facet/load.h"
#include "image/convert.h"
#include "image/image_test_util.h"
#include "light/environment_source.h"
#include "light/studio.h"

namespace facet {
namespace {

namespace fs = std::filesystem;

constexpr EnvironmentOptions kOptions{.keep_image = true, .max_size = 64, .samples = 6};

std::string Read(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void Write(const fs::path& path, const std::string& bytes) { std::ofstream(path, std::ios::binary) << bytes; }

// Radiance, 16 x 8 pixels, each of them flat; some differ.
std::string SkyFile(char brightest = 100) {
  std::string file = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 8 +X 16\n";
  for (int i = 0; i < 16 * 8; ++i)
    file += {char(10 + i % 50), char(20 + i % 30), i == 40 ? brightest : char(60), char(0x81)};
  return file;
}

template <class T>
bool SameBits(const PageVector<T>& a, const PageVector<T>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

void ExpectSameMap(const EnvironmentMap& a, const EnvironmentMap& b) {
  for (int k = 0; k < EnvironmentMap::kLevels; ++k) {
    EXPECT_EQ(a.levels[k].size, b.levels[k].size);
    EXPECT_EQ(a.levels[k].offset, b.levels[k].offset);
    EXPECT_EQ(a.level_size[k], b.level_size[k]);
    EXPECT_EQ(a.level_offset[k], b.level_offset[k]);
  }
  EXPECT_EQ(a.irradiance.offset, b.irradiance.offset);
  EXPECT_TRUE(SameBits(a.texels, b.texels));
  EXPECT_TRUE(SameBits(a.image, b.image));
  EXPECT_EQ(a.image_width, b.image_width);
  EXPECT_EQ(a.image_height, b.image_height);
  EXPECT_EQ(a.repaired_values, b.repaired_values);
  EXPECT_EQ(a.texel_data, a.texels.data());
  EXPECT_EQ(a.image_data != nullptr, b.image_data != nullptr);
  if (a.image_data != nullptr) {
    EXPECT_EQ(a.image_data, a.image.data());
  }
}

class EnvironmentCache : public testing::Test {
 protected:
  EnvironmentCache() { Write(sky_, SkyFile()); }

  std::shared_ptr<const EnvironmentSource> Open() const { return OpenEnvironment(sky_, cache_); }
  std::shared_ptr<const EnvironmentMap> Find(const EnvironmentOptions& options = kOptions) const {
    return Open()->Find(options, [](std::uint64_t) {});
  }
  std::shared_ptr<const EnvironmentMap> Keep(const EnvironmentOptions& options = kOptions) const {
    const auto source = Open();
    auto map = PrefilterEnvironment(*source->Decode(), options);
    EXPECT_EQ(source->Keep(options, *map), "");
    return map;
  }
  std::vector<fs::path> Entries() const {
    std::vector<fs::path> entries;
    if (!fs::exists(cache_)) return entries;
    for (const auto& entry : fs::directory_iterator(cache_)) entries.push_back(entry.path());
    return entries;
  }

  const TemporaryFolder folder_;
  const fs::path sky_ = folder_ / "sky.hdr", cache_ = folder_.path() / "made" / "when needed";
};

TEST_F(EnvironmentCache, GivesBackTheSameBits) {
  for (const bool keep_image : {false, true}) {
    for (const int max_size : {64, 1024}) {
      const EnvironmentOptions options{.keep_image = keep_image, .max_size = max_size};
      EXPECT_EQ(Find(options), nullptr);
      const auto kept = Keep(options);
      const auto found = Find(options);
      ASSERT_NE(found, nullptr);
      ExpectSameMap(*found, *kept);
    }
  }
  for (const fs::path& entry : Entries()) EXPECT_EQ(entry.extension(), ".environment");  // and nothing half written
}

// A file whose numbers had to be repaired is warned of every time.
TEST_F(EnvironmentCache, RemembersRepairs) {
  const Image bad{2, 1, 3, ChannelType::F32, Encoding::Linear, std::vector<std::byte>(24, std::byte{0xff})};  // NaN
  const auto map = PrefilterEnvironment(bad, kOptions);
  ASSERT_GT(map->repaired_values, 0u);
  ASSERT_EQ(Open()->Keep(kOptions, *map), "");
  EXPECT_EQ(Find()->repaired_values, map->repaired_values);
}

TEST_F(EnvironmentCache, EveryOptionAndEveryByteOfTheFileCounts) {
  Keep();
  for (EnvironmentOptions other : {EnvironmentOptions{.keep_image = false, .max_size = 64, .samples = 6},
                                   EnvironmentOptions{.keep_image = true, .max_size = 128, .samples = 6},
                                   EnvironmentOptions{.keep_image = true, .max_size = 64, .samples = 7},
                                   EnvironmentOptions{true, 64, 6, IrradianceMethod::SphericalHarmonics}}) {
    EXPECT_EQ(Find(other), nullptr);
    const auto kept = Keep(other), found = Find(other);
    ASSERT_NE(found, nullptr);
    ExpectSameMap(*found, *kept);
  }
  EXPECT_EQ(Entries().size(), 5u);
  Write(sky_, SkyFile(101));
  EXPECT_EQ(Find(), nullptr);
  Keep();
  EXPECT_EQ(Entries().size(), 6u);
}

// What was kept for a file that cannot be decoded proves that it is not.
TEST_F(EnvironmentCache, DoesNotDecode) {
  const auto map = Keep();
  Write(sky_, "no picture");
  EXPECT_THROW(Open()->Decode(), Error);
  ASSERT_EQ(Open()->Keep(kOptions, *map), "");
  ExpectSameMap(*Find(), *map);
}

// What it is decoded from is what it was named by.
TEST_F(EnvironmentCache, FilesThatChangeMeanwhileAreRefused) {
  const auto source = Open();
  Write(sky_, SkyFile(101));
  EXPECT_EQ(CodeOf([&] { source->Decode(); }), ErrorCode::InvalidInput);
}

TEST_F(EnvironmentCache, PipesAreReadOnce) {
  const auto map = Keep();
  const fs::path pipe = folder_ / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  std::thread writer([&] { Write(pipe, SkyFile()); });
  const auto source = OpenEnvironment(pipe, cache_);
  writer.join();
  const auto found = source->Find(kOptions, [](std::uint64_t) {});
  ASSERT_NE(found, nullptr);
  ExpectSameMap(*found, *map);
  EXPECT_EQ(source->Decode()->width, 16);
}

TEST_F(EnvironmentCache, DamageIsFoundAndMended) {
  const auto map = Keep();
  const fs::path entry = Entries().at(0);
  const std::string whole = Read(entry);
  const std::size_t header = 112;
  ASSERT_EQ(whole.size(), header + 4 * (map->texels.size() + map->image.size()));
  const auto expect_found_out = [&](const std::string& bytes, const std::string& what) {
    Write(entry, bytes);
    EXPECT_EQ(Find(), nullptr) << what;
  };
  const auto flipped = [&](std::size_t at, int bit) {
    std::string bytes = whole;
    bytes[at] = static_cast<char>(bytes[at] ^ (1 << bit));
    return bytes;
  };
  for (std::size_t at = 0; at < header; ++at) {
    for (int bit = 0; bit < 8; bit += 7) expect_found_out(flipped(at, bit), "header, byte " + std::to_string(at));
  }
  for (std::size_t at = header; at < whole.size(); at += 4099) expect_found_out(flipped(at, 0), std::to_string(at));
  expect_found_out(flipped(header + 4 * map->texels.size() - 1, 7), "last texel");
  expect_found_out(flipped(header + 4 * map->texels.size(), 0), "first of the picture");
  expect_found_out(flipped(whole.size() - 1, 7), "the end");
  for (const std::size_t size :
       {std::size_t{0}, std::size_t{1}, header - 1, header, whole.size() / 2, whole.size() - 1}) {
    expect_found_out(whole.substr(0, size), "cut off at " + std::to_string(size));
  }
  expect_found_out(whole + '\0', "too long");
  expect_found_out(std::string(whole.size(), '\0'), "zeros");  // as after a crash of the machine
  Keep();
  EXPECT_EQ(Read(entry), whole);
  ExpectSameMap(*Find(), *map);
}

// The digest keeps nobody from writing an entry: what no image can become is not taken.
TEST_F(EnvironmentCache, WhatIsNoLightIsNotTaken) {
  const auto find_with = [&](float number, bool in_image, std::size_t at) {
    EnvironmentMap map;
    LayOutLevels(64, map);
    map.image_width = 16, map.image_height = 8;
    map.image.assign(16 * 8 * 4, 1.0f);
    PageVector<float>& floats = in_image ? map.image : map.texels;
    floats[at < floats.size() ? at : floats.size() - 1] = number;
    EXPECT_EQ(Open()->Keep(kOptions, map), "");
    return Find();
  };
  for (const bool in_image : {false, true}) {
    for (const std::size_t at : {std::size_t{0}, std::size_t{5}, ~std::size_t{0}}) {
      for (const float fine : {0.0f, -0.0f, 1.0f, kMaxRadiance}) EXPECT_NE(find_with(fine, in_image, at), nullptr);
      for (const float bad : {NAN, INFINITY, -INFINITY, -1.0f, -1e-45f, 3e38f}) {
        EXPECT_EQ(find_with(bad, in_image, at), nullptr) << bad << " at " << at;
      }
    }
  }
}

TEST_F(EnvironmentCache, AnotherEntryInItsPlaceIsNotTaken) {
  Keep();
  const fs::path first = Entries().at(0);
  const std::string whole = Read(first);
  fs::remove(first);
  const EnvironmentOptions other{.keep_image = true, .max_size = 64, .samples = 7};
  Keep(other);
  Write(Entries().at(0), whole);
  EXPECT_EQ(Find(other), nullptr);
}

TEST_F(EnvironmentCache, WhatIsNoFileIsNotReadOrReplaced) {
  const auto map = Keep();
  const fs::path entry = Entries().at(0);
  fs::remove(entry);
  fs::create_directory(entry);
  EXPECT_EQ(Find(), nullptr);
  EXPECT_NE(Open()->Keep(kOptions, *map).find("cannot be written"), std::string::npos);
  EXPECT_EQ(Entries(), std::vector{entry});
  fs::remove(entry);
  ASSERT_EQ(mkfifo(entry.c_str(), 0600), 0);
  EXPECT_EQ(Find(), nullptr);  // and does not wait for a writer
  EXPECT_NE(Open()->Keep(kOptions, *map).find("it is no plain file"), std::string::npos);  // nor for a reader
  fs::remove(entry);
  const fs::path other = folder_ / "other";
  fs::create_symlink(other, entry);
  EXPECT_NE(Open()->Keep(kOptions, *map).find("it is no plain file"), std::string::npos);
  EXPECT_FALSE(fs::exists(other));
}

TEST_F(EnvironmentCache, FoldersThatCannotBeMadeAreAWarning) {
  const auto map = PrefilterEnvironment(*Open()->Decode(), kOptions);
  const auto source = OpenEnvironment(sky_, sky_);
  EXPECT_EQ(source->Find(kOptions, [](std::uint64_t) {}), nullptr);
  EXPECT_NE(source->Keep(kOptions, *map).find("the prepared environment is not kept: " + sky_.string()),
            std::string::npos);
  EXPECT_EQ(Read(sky_), SkyFile());
  EXPECT_EQ(CodeOf([&] { OpenEnvironment(folder_ / "none.hdr", cache_); }), ErrorCode::NotFound);
}

TEST_F(EnvironmentCache, AsksBeforeItTakesMemory) {
  const auto map = Keep();
  std::uint64_t asked = 0;
  const auto refuse = [&](std::uint64_t bytes) {
    asked = bytes;
    throw Error(ErrorCode::OutOfMemory, "no");
  };
  EXPECT_EQ(CodeOf([&] { Open()->Find(kOptions, refuse); }), ErrorCode::OutOfMemory);
  EXPECT_EQ(asked, 4 * (map->texels.size() + map->image.size()));
}

// Nobody ever sees a part of an entry, however many write it.
TEST_F(EnvironmentCache, WritersAndReadersAtOnce) {
  const auto map = Keep();
  std::vector<std::thread> threads;
  for (int thread = 0; thread < 4; ++thread) {
    threads.emplace_back([&, thread] {
      const auto source = Open();
      for (int i = 0; i < 40; ++i) {
        if ((thread + i) % 2 == 0) {
          EXPECT_EQ(source->Keep(kOptions, *map), "");
        }
        const auto found = source->Find(kOptions, [](std::uint64_t) {});
        ASSERT_NE(found, nullptr);
        ExpectSameMap(*found, *map);
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(Entries().size(), 1u);
}

// Fails when prepared environments are others than those that may be kept somewhere already.
TEST(EnvironmentArithmetic, IsTheOneOfItsNumber) {
  Sha256 hash;
  for (const IrradianceMethod method : {IrradianceMethod::Convolution, IrradianceMethod::SphericalHarmonics}) {
    const auto map = PrefilterEnvironment(StudioImage(1024, 512), {true, 1024, 24, method});
    hash.Add(std::as_bytes(std::span(map->texels)));
    hash.Add(std::as_bytes(std::span(map->image)));
  }
  EXPECT_EQ(std::tuple(kEnvironmentArithmetic, ToHex(hash.Finish())),
            std::tuple(1u, std::string("2328cb95a54adb83d5c859907f8e2d0609cea5b850a9fc1e923b49d7c62a3112")))
      << "raise kEnvironmentArithmetic and write the new digest here";
}

}  // namespace
}  // namespace facet
