#include "base/sha256.h"

#include <gtest/gtest.h>

#include <string>

namespace facet {
namespace {

std::string Hex(std::string_view text) {
  Sha256 hash;
  hash.Add(text);
  return ToHex(hash.Finish());
}

class Sha256Test : public testing::TestWithParam<bool> {
 protected:
  Sha256Test() { Sha256::ForcePortable(GetParam()); }
  ~Sha256Test() override { Sha256::ForcePortable(false); }
};

// NIST, Cryptographic Standards and Guidelines, example values and test vectors of SHA-256.
TEST_P(Sha256Test, GivesThePublishedDigests) {
  EXPECT_EQ(Hex(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(Hex("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(Hex("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(Hex("abcdefghbcdefghicdefghijdefghijkefghijklfghijklmghijklmnhijklmnoijklmnopjklmnopqklmnopqrlmnopqrsmnopqrs"
                "tnopqrstu"),
            "cf5b16a778af8380036ce59e7b0492370b249b11e8f07a51afac45037afee9d1");
  EXPECT_EQ(Hex(std::string(1000000, 'a')), "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST_P(Sha256Test, DoesNotDependOnThePiecesThatAreAdded) {
  std::string text;
  for (int i = 0; i < 300; ++i) text += static_cast<char>(i * 37 + i / 7);
  for (std::size_t length = 0; length <= text.size(); length += 13) {
    const std::string whole = Hex(text.substr(0, length));
    for (const std::size_t piece : {1u, 3u, 55u, 63u, 64u, 65u, 130u}) {
      Sha256 hash;
      for (std::size_t at = 0; at < length; at += piece) hash.Add(text.substr(at, std::min(piece, length - at)));
      EXPECT_EQ(ToHex(hash.Finish()), whole) << length << " bytes in pieces of " << piece;
    }
  }
}

TEST(Sha256Instructions, GiveWhatPortableCodeGives) {
  std::string text;
  for (int i = 0; i < 1000; ++i) {
    text += static_cast<char>(i * i + i / 3);
    Sha256::ForcePortable(true);
    const std::string portable = Hex(text);
    Sha256::ForcePortable(false);
    ASSERT_EQ(Hex(text), portable) << text.size() << " bytes";
  }
}

INSTANTIATE_TEST_SUITE_P(Code, Sha256Test, testing::Bool(),
                         [](const auto& code) { return code.param ? "Portable" : "OfThisProcessor"; });

TEST(DigestText, GoesThereAndBack) {
  const std::string hex = Hex("abc");
  const std::optional<Digest> digest = ParseDigest(hex);
  ASSERT_TRUE(digest);
  EXPECT_EQ(ToHex(*digest), hex);
  EXPECT_EQ(digest->bytes[0], 0xba);
  EXPECT_FALSE(ParseDigest(hex.substr(1)));
  EXPECT_FALSE(ParseDigest(hex + "0"));
  EXPECT_FALSE(ParseDigest(hex.substr(1) + "g"));
  EXPECT_FALSE(ParseDigest(hex.substr(2) + "BA"));
}

}  // namespace
}  // namespace facet
