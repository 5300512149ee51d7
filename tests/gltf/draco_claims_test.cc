// Draco data that claims more than it holds, or more than the memory limit, is refused before it is unpacked.
#include <gtest/gtest.h>

#include "base/least_limit.h"
#include "draco_pack.h"
#include "gltf_files.h"

namespace facet {
namespace {

using testing::FileMaker;
using testing::LoadBytes;
using testing::LoadError;
using testing::PackDraco;
using testing::WithinMemory;

enum Method : char { kSequential = 0, kEdgebreaker = 1 };
constexpr std::uint64_t kMiB = 1 << 20;

std::string Varint(std::uint64_t number) {
  std::string bytes;
  for (; number >= 0x80; number >>= 7) bytes += static_cast<char>(0x80 | (number & 0x7F));
  return bytes + static_cast<char>(number);
}

// Version 2.2, a mesh. Source: Google, "Draco bitstream specification", section "Header".
std::string Header(Method method, bool metadata = false) {
  return std::string("DRACO\2\2\1", 8) + std::string(1, method) + std::string(1, '\0') +
         std::string(1, metadata ? '\x80' : '\0');
}

// What the connectivity of a sequential mesh begins with.
std::string Sequential(std::uint64_t faces, std::uint64_t points) { return Varint(faces) + Varint(points); }

// That of an edgebreaker mesh: the kind of traversal, vertices, faces, decoders of attributes.
std::string Edgebreaker(std::uint64_t faces, int decoders) {
  return std::string(1, '\0') + Varint(faces / 2 + 2) + Varint(faces) + static_cast<char>(decoders);
}

std::string Padding(std::size_t bytes) { return std::string(bytes, '\0'); }

std::string FileOf(const std::string& packed, std::size_t vertices = 3, std::size_t corners = 3) {
  FileMaker file;
  const int view = file.View(packed);
  file.Attribute("POSITION", file.Accessor(-1, 5126, vertices, "VEC3"));
  file.PrimitiveMore() = ",\"indices\":" + std::to_string(file.Accessor(-1, 5125, corners, "SCALAR")) +
                         ",\"extensions\":{\"KHR_draco_mesh_compression\":{\"bufferView\":" + std::to_string(view) +
                         ",\"attributes\":{\"POSITION\":0}}}";
  file.RootMore() =
      ",\"extensionsUsed\":[\"KHR_draco_mesh_compression\"],\"extensionsRequired\":[\"KHR_draco_mesh_compression\"]";
  return file.AsGlb();
}

std::string Refusal(const std::string& packed, std::uint64_t limit) {
  return LoadError(FileOf(packed), ErrorCode::OutOfMemory, WithinMemory(limit));
}

// Within the limit, what is wrong with the data is what is said of it.
void ExpectDamaged(const std::string& packed, std::uint64_t limit, const std::string& what = "Draco data is damaged") {
  const std::string error = LoadError(FileOf(packed), ErrorCode::InvalidInput, WithinMemory(limit));
  EXPECT_NE(error.find(what), std::string::npos) << error;
}

void ExpectIn(const std::string& part, const std::string& text) {
  EXPECT_NE(text.find(part), std::string::npos) << text;
}

TEST(DracoClaims, FacesThatNoDataOfThatSizeHoldsAreRefused) {
  for (const std::string& packed : {Header(kSequential) + Sequential(1'000'000'000, 3) + Padding(100),
                                    Header(kEdgebreaker) + Edgebreaker(1'000'000'000, 1) + Padding(100)}) {
    ExpectDamaged(packed, 64 * kMiB, "bytes of Draco data claim 1000000000 triangles");
  }
}

TEST(DracoClaims, FacesAreCharged) {
  for (const std::string& claims :
       {Header(kSequential) + Sequential(100'000, 3), Header(kEdgebreaker) + Edgebreaker(100'000, 0)}) {
    const std::string packed = claims + Padding(1000);
    ExpectIn("this needs 12.2 MiB for Draco data", Refusal(packed, 8 * kMiB));
    ExpectDamaged(packed, 64 * kMiB);
  }
}

// Each has connectivity of its own.
TEST(DracoClaims, DecodersOfAttributesAreCharged) {
  const auto packed = [](int decoders) { return Header(kEdgebreaker) + Edgebreaker(10'000, decoders) + Padding(1000); };
  ExpectIn("this needs 92.8 MiB for Draco data", Refusal(packed(200), 64 * kMiB));
  ExpectDamaged(packed(200), 256 * kMiB);
  ExpectDamaged(packed(1), 64 * kMiB);
}

// Metadata stands before the connectivity: what follows it is seen all the same, and it is not believed either.
TEST(DracoClaims, MetadataHidesNothing) {
  const std::string none = Padding(3);  // of no attributes; no entries, nothing below
  const std::string entry = Varint(0) + Varint(1) + Varint(1) + "k" + Varint(2) + "vv" + Varint(0);
  for (const std::string& metadata : {none, entry}) {
    const std::string start = Header(kEdgebreaker, true) + metadata;
    ExpectIn("this needs 12.2 MiB for Draco data", Refusal(start + Edgebreaker(100'000, 0) + Padding(1000), 8 * kMiB));
    ExpectDamaged(start + Edgebreaker(1'000'000'000, 0) + Padding(100), 64 * kMiB, "claim 1000000000 triangles");
  }
  constexpr std::uint64_t kHuge = 0xFFFFFFFF;
  for (const std::string& metadata :
       {Varint(kHuge), Varint(0) + Varint(kHuge), Varint(0) + Varint(1) + Varint(1) + "k" + Varint(kHuge),
        Varint(0) + Varint(0) + Varint(kHuge), Varint(0) + Varint(1) + Varint(200) + "k"}) {
    ExpectDamaged(Header(kEdgebreaker, true) + metadata, 64 * kMiB, "Draco data is cut short");
  }
}

TEST(DracoClaims, DataThatEndsInItsClaimsIsCutShort) {
  for (const std::string& packed : {Header(kSequential), Header(kEdgebreaker), Header(kEdgebreaker) + Padding(1),
                                    Header(kEdgebreaker) + Padding(1) + Varint(4) + Varint(2)}) {
    ExpectDamaged(packed, 64 * kMiB, "Draco data is cut short");
  }
}

constexpr std::size_t kFaces = 100'000;

// A real mesh: a triangle again and again, with as many attributes as are wanted. Its indices are a byte each.
std::string Triangles(int attributes) {
  const std::vector<float> values = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  std::vector<testing::DracoAttribute> list = {
      {draco::GeometryAttribute::POSITION, draco::DT_FLOAT32, 3, values.data()}};
  for (int i = 1; i < attributes; ++i) {
    list.push_back({draco::GeometryAttribute::GENERIC, draco::DT_FLOAT32, 3, values.data()});
  }
  std::vector<std::uint32_t> indices;
  for (std::size_t i = 0; i < 3 * kFaces; ++i) indices.push_back(std::uint32_t(i % 3));
  return PackDraco(3, indices, list, {draco::MESH_SEQUENTIAL_ENCODING, 5});
}

// The same data, said to be of as many points as its faces may have: 11.4 MiB for each attribute, of 24 bytes of
// numbers and integers and 16 of order a point. The faces take 12.2.
std::string WithMorePoints(const std::string& packed) {
  const std::string start = Header(kSequential) + Sequential(kFaces, 3);
  EXPECT_EQ(packed.substr(0, start.size()), start);
  return Header(kSequential) + Sequential(kFaces, 3 * kFaces) + packed.substr(start.size());
}

TEST(DracoClaims, PointsAreCharged) {
  const std::string packed = Triangles(1);
  const LoadedScene loaded = LoadBytes(FileOf(packed), WithinMemory(20 * kMiB));
  EXPECT_EQ(loaded.scene.meshes.at(0).primitives.at(0).positions.size(), 3u);
  ExpectIn("this needs 23.7 MiB for Draco data", Refusal(WithMorePoints(packed), 20 * kMiB));
  ExpectDamaged(WithMorePoints(packed), 64 * kMiB);
}

// All are announced before the first is read.
TEST(DracoClaims, EveryAttributeIsCharged) {
  const std::string packed = Triangles(10);
  EXPECT_EQ(LoadBytes(FileOf(packed), WithinMemory(20 * kMiB)).scene.meshes.at(0).primitives.size(), 1u);
  ExpectIn("for Draco data", Refusal(WithMorePoints(packed), 100 * kMiB));
  ExpectDamaged(WithMorePoints(packed), 256 * kMiB);
}

}  // namespace
}  // namespace facet
