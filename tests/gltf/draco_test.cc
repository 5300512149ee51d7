// KHR_draco_mesh_compression: quantised attributes are the specification's formulas, each operation rounded by itself,
// whatever the library gives on this processor.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "draco_pack.h"
#include "gltf_files.h"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wpedantic"
#pragma GCC diagnostic ignored "-Wunused-parameter"
#include <draco/compression/decode.h>
#pragma GCC diagnostic pop

namespace facet {
namespace {

using testing::FileMaker;
using testing::LoadBytes;
using testing::PackDraco;

constexpr std::size_t kSide = 24, kCount = kSide * kSide;

// A bent sheet, with numbers that no step of quantisation divides.
struct Sheet {
  std::vector<glm::vec3> positions, normals;
  std::vector<glm::vec2> uvs;
  std::vector<glm::vec4> tangents, colors, weights;
  std::vector<std::uint8_t> joints;  // four a vertex
  std::vector<std::uint32_t> indices;
  Sheet() {
    for (std::size_t i = 0; i < kCount; ++i) {
      const float x = float(i % kSide) * 0.37f, y = float(i / kSide) * 0.41f;
      positions.emplace_back(x - 3.1f, y + 0.7f, std::sin(x) * std::cos(y) * 1.3f);
      normals.push_back(glm::normalize(glm::vec3(std::sin(x * 3.0f), std::cos(y * 2.0f), std::sin(x + y) + 0.1f)));
      uvs.emplace_back(x * 0.13f - 0.2f, y * 0.17f);
      const glm::vec3 across = glm::normalize(glm::cross(normals.back(), glm::vec3(0.3f, 0.8f, -0.5f)));
      tangents.emplace_back(across, i % 3 == 0 ? -1.0f : 1.0f);
      // Well inside of [0, 1], so that a reader has nothing to clamp.
      const float u = 0.5f + 0.4f * std::sin(x * 1.7f), v = 0.5f + 0.35f * std::cos(y * 1.1f);
      colors.emplace_back(u, v, 0.9f - 0.7f * u, 0.8f - 0.3f * v);
      weights.emplace_back(0.4f * u, 0.4f - 0.4f * u + 0.1f, 0.3f * v, 0.5f - 0.3f * v);
      for (std::size_t c = 0; c < 4; ++c) joints.push_back(static_cast<std::uint8_t>(i * 5 + c * 60));
    }
    constexpr std::uint32_t side = kSide;
    for (std::uint32_t i = 0; i + side < kCount; ++i) {
      if (i % side == side - 1) continue;
      for (const std::uint32_t k : {i, i + 1, i + side, i + 1, i + 1 + side, i + side}) indices.push_back(k);
    }
  }
};

struct Semantic {
  std::string name, type;
  int component_type = 5126;
};

// A file of one primitive whose attribute i is Draco's attribute i.
LoadedScene Load(const std::string& packed, const std::vector<Semantic>& semantics, std::size_t index_count) {
  FileMaker file;
  const int view = file.View(packed);
  std::string ids;
  for (std::size_t i = 0; i < semantics.size(); ++i) {
    const auto& [name, type, component_type] = semantics[i];
    file.Attribute(
        name, file.Accessor(-1, component_type, kCount, type, component_type == 5126 ? "" : ",\"normalized\":true"));
    ids += (i ? ",\"" : "\"") + name + "\":" + std::to_string(i);
  }
  file.PrimitiveMore() = ",\"indices\":" + std::to_string(file.Accessor(-1, 5125, index_count, "SCALAR")) +
                         ",\"extensions\":{\"KHR_draco_mesh_compression\":{\"bufferView\":" + std::to_string(view) +
                         ",\"attributes\":{" + ids + "}}}";
  file.RootMore() =
      ",\"extensionsUsed\":[\"KHR_draco_mesh_compression\"],\"extensionsRequired\":[\"KHR_draco_mesh_compression\"]";
  return LoadBytes(file.AsGlb());
}

const Primitive& First(const LoadedScene& loaded) { return loaded.scene.meshes.at(0).primitives.at(0); }

// One operation on floats is exact in double before it is rounded: no compiler can fuse two of them here.
float Rounded(double exact) { return static_cast<float>(exact); }

// The least value and the range that the encoder quantises by: of all components together.
template <int N>
struct Grid {
  glm::vec<N, float> least{INFINITY};
  float step = 0.0f;
  Grid(const std::vector<glm::vec<N, float>>& values, int bits) {
    glm::vec<N, float> most(-INFINITY);
    for (const auto& value : values) {
      least = glm::min(least, value);
      most = glm::max(most, value);
    }
    float range = 0.0f;
    for (int c = 0; c < N; ++c) range = std::max(range, most[c] - least[c]);
    step = range / static_cast<float>((1 << bits) - 1);
  }
  // The point of the grid that `value` is.
  float At(int c, float value) const {
    const double q = std::nearbyint((double(value) - double(least[c])) / double(step));
    return Rounded(double(Rounded(q * double(step))) + double(least[c]));
  }
};

template <int N>
void ExpectOnGrid(const std::vector<glm::vec<N, float>>& got, const std::vector<glm::vec<N, float>>& packed, int bits) {
  const Grid<N> grid(packed, bits);
  ASSERT_EQ(got.size(), packed.size());
  for (const auto& value : got) {
    for (int c = 0; c < N; ++c) ASSERT_EQ(value[c], grid.At(c, value[c])) << bits << " bits";
  }
}

// What the octahedral coordinates s and t of `bits` stand for.
glm::vec3 Octahedral(int bits, int s, int t) {
  const float step = 2.0f / static_cast<float>((1 << bits) - 2);
  const auto coordinate = [&](int i) { return Rounded(double(Rounded(double(i) * double(step))) - 1.0); };
  float y = coordinate(s), z = coordinate(t);
  const float x = Rounded(double(Rounded(1.0 - std::fabs(double(y)))) - std::fabs(double(z)));
  const auto fold = [&](float v) { return x < 0.0f ? Rounded(double(v) + (v < 0.0f ? -double(x) : double(x))) : v; };
  y = fold(y);
  z = fold(z);
  const auto square = [](float v) { return double(Rounded(double(v) * double(v))); };
  const float length = std::sqrt(Rounded(double(Rounded(square(x) + square(y))) + square(z)));
  const float scale = Rounded(1.0 / double(length));
  return {Rounded(double(x) * scale), Rounded(double(y) * scale), Rounded(double(z) * scale)};
}

TEST(Draco, QuantisedAttributesAreTheFormula) {
  const Sheet sheet;
  for (const auto method : {draco::MESH_EDGEBREAKER_ENCODING, draco::MESH_SEQUENTIAL_ENCODING}) {
    for (const int speed : {0, 5, 10}) {
      for (const int bits : {5, 8, 11, 14, 20}) {
        SCOPED_TRACE(std::to_string(method) + ", speed " + std::to_string(speed));
        const std::string packed =
            PackDraco(kCount, sheet.indices,
                      {{draco::GeometryAttribute::POSITION, draco::DT_FLOAT32, 3, sheet.positions.data(), bits},
                       {draco::GeometryAttribute::TEX_COORD, draco::DT_FLOAT32, 2, sheet.uvs.data(), bits}},
                      {method, speed});
        const LoadedScene loaded = Load(packed, {{"POSITION", "VEC3"}, {"TEXCOORD_0", "VEC2"}}, sheet.indices.size());
        const Primitive& primitive = First(loaded);
        ExpectOnGrid(primitive.positions, sheet.positions, bits);
        ExpectOnGrid(primitive.tex_coords.at(0), sheet.uvs, bits);
      }
    }
  }
}

TEST(Draco, QuantisedNormalsAreTheFormula) {
  const Sheet sheet;
  for (const int speed : {0, 10}) {
    for (const int bits : {4, 6, 8}) {
      const std::string packed =
          PackDraco(kCount, sheet.indices,
                    {{draco::GeometryAttribute::POSITION, draco::DT_FLOAT32, 3, sheet.positions.data(), 14},
                     {draco::GeometryAttribute::NORMAL, draco::DT_FLOAT32, 3, sheet.normals.data(), bits}},
                    {draco::MESH_EDGEBREAKER_ENCODING, speed});
      const LoadedScene loaded = Load(packed, {{"POSITION", "VEC3"}, {"NORMAL", "VEC3"}}, sheet.indices.size());
      std::vector<glm::vec3> possible;
      for (int s = 0; s <= (1 << bits) - 2; ++s) {
        for (int t = 0; t <= (1 << bits) - 2; ++t) possible.push_back(Octahedral(bits, s, t));
      }
      const auto less = [](const glm::vec3& a, const glm::vec3& b) {
        return std::lexicographical_compare(&a.x, &a.x + 3, &b.x, &b.x + 3);
      };
      std::sort(possible.begin(), possible.end(), less);
      const auto& normals = First(loaded).normals;
      ASSERT_EQ(normals.size(), kCount);
      for (const glm::vec3& normal : normals) {
        ASSERT_TRUE(std::binary_search(possible.begin(), possible.end(), normal, less)) << speed << ", " << bits;
      }
    }
  }
}

// Every kind of attribute that glTF has: that of a file, and how it is packed.
struct Kind {
  Semantic semantic;
  testing::DracoAttribute packed;
};

std::vector<Kind> KindsOf(const Sheet& sheet, int bits) {
  using Type = draco::GeometryAttribute;
  const auto floats = [bits](const char* name, const char* type, Type::Type packed, const auto& values) {
    return Kind{{name, type}, {packed, draco::DT_FLOAT32, static_cast<int>(values[0].length()), values.data(), bits}};
  };
  return {floats("POSITION", "VEC3", Type::POSITION, sheet.positions),
          floats("NORMAL", "VEC3", Type::NORMAL, sheet.normals),
          floats("TANGENT", "VEC4", Type::GENERIC, sheet.tangents),
          floats("TEXCOORD_0", "VEC2", Type::TEX_COORD, sheet.uvs),
          floats("TEXCOORD_1", "VEC2", Type::GENERIC, sheet.uvs),
          floats("COLOR_0", "VEC4", Type::COLOR, sheet.colors),
          {{"JOINTS_0", "VEC4", 5121}, {Type::GENERIC, draco::DT_UINT8, 4, sheet.joints.data()}},
          floats("WEIGHTS_0", "VEC4", Type::GENERIC, sheet.weights)};
}

struct Packed {
  std::string bytes;
  std::vector<Semantic> semantics;
};

Packed PackAll(const Sheet& sheet, int bits, const testing::DracoPacking& packing) {
  Packed packed;
  std::vector<testing::DracoAttribute> attributes;
  for (const Kind& kind : KindsOf(sheet, bits)) {
    packed.semantics.push_back(kind.semantic);
    attributes.push_back(kind.packed);
  }
  packed.bytes = PackDraco(kCount, sheet.indices, attributes, packing);
  return packed;
}

constexpr testing::DracoPacking kPackings[] = {
    {draco::MESH_EDGEBREAKER_ENCODING, 0},  {draco::MESH_EDGEBREAKER_ENCODING, 5},
    {draco::MESH_EDGEBREAKER_ENCODING, 10}, {draco::MESH_SEQUENTIAL_ENCODING, 0},
    {draco::MESH_SEQUENTIAL_ENCODING, 5},   {draco::MESH_SEQUENTIAL_ENCODING, 10}};

// Those of four numbers. Directions are left as they are where the grid is fine enough for them to stay unit.
TEST(Draco, QuantisedTangentsColorsAndWeightsAreTheFormula) {
  const Sheet sheet;
  for (const testing::DracoPacking& packing : kPackings) {
    for (const int bits : {14, 20}) {
      SCOPED_TRACE(std::to_string(packing.method) + ", speed " + std::to_string(packing.speed));
      const Packed packed = PackAll(sheet, bits, packing);
      const LoadedScene loaded = Load(packed.bytes, packed.semantics, sheet.indices.size());
      const Primitive& primitive = First(loaded);
      ExpectOnGrid(primitive.colors, sheet.colors, bits);
      ExpectOnGrid(primitive.weights.at(0), sheet.weights, bits);
      ExpectOnGrid(primitive.tex_coords.at(1), sheet.uvs, bits);
      const Grid<4> grid(sheet.tangents, bits);
      ASSERT_EQ(primitive.tangents.size(), kCount);
      for (const glm::vec4& tangent : primitive.tangents) {
        for (int c = 0; c < 3; ++c) ASSERT_EQ(tangent[c], grid.At(c, tangent[c])) << bits << " bits";
        ASSERT_EQ(std::fabs(tangent.w), 1.0f);
      }
    }
  }
}

#if defined(__x86_64__)
// What the library itself gives for an attribute: `Value` by point.
template <class Value>
std::vector<Value> ByTheLibrary(const draco::Mesh& mesh, std::uint32_t id) {
  const draco::PointAttribute* const attribute = mesh.GetAttributeByUniqueId(id);
  EXPECT_NE(attribute, nullptr) << id;
  EXPECT_EQ(attribute->byte_stride(), std::int64_t(sizeof(Value))) << id;
  std::vector<Value> values(mesh.num_points());
  for (std::uint32_t i = 0; i < mesh.num_points(); ++i) attribute->GetMappedValue(draco::PointIndex(i), &values[i]);
  return values;
}

// Without fused operations the library's own floats are the same, so that what was said of pictures before still holds.
TEST(Draco, AsTheLibraryWhereNothingIsFused) {
  const Sheet sheet;
  for (const testing::DracoPacking& packing : kPackings) {
    for (const int bits : {0, 14, 16}) {
      SCOPED_TRACE(std::to_string(packing.method) + ", speed " + std::to_string(packing.speed) + ", bits " +
                   std::to_string(bits));
      const Packed packed = PackAll(sheet, bits, packing);
      const LoadedScene loaded = Load(packed.bytes, packed.semantics, sheet.indices.size());
      const Primitive& primitive = First(loaded);
      draco::DecoderBuffer buffer;
      buffer.Init(packed.bytes.data(), packed.bytes.size());
      draco::Decoder decoder;
      const auto mesh = decoder.DecodeMeshFromBuffer(&buffer).value();
      ASSERT_EQ(mesh->num_points(), primitive.positions.size());
      EXPECT_EQ(primitive.positions, ByTheLibrary<glm::vec3>(*mesh, 0));
      EXPECT_EQ(primitive.normals, ByTheLibrary<glm::vec3>(*mesh, 1));
      auto tangents = ByTheLibrary<glm::vec4>(*mesh, 2);
      for (glm::vec4& tangent : tangents) tangent.w = tangent.w < 0.0f ? -1.0f : 1.0f;
      EXPECT_EQ(primitive.tangents, tangents);
      EXPECT_EQ(primitive.tex_coords.at(0), ByTheLibrary<glm::vec2>(*mesh, 3));
      EXPECT_EQ(primitive.tex_coords.at(1), ByTheLibrary<glm::vec2>(*mesh, 4));
      EXPECT_EQ(primitive.colors, ByTheLibrary<glm::vec4>(*mesh, 5));
      const auto joints = ByTheLibrary<glm::u8vec4>(*mesh, 6);
      EXPECT_EQ(primitive.joints.at(0), std::vector<glm::u16vec4>(joints.begin(), joints.end()));
      EXPECT_EQ(primitive.weights.at(0), ByTheLibrary<glm::vec4>(*mesh, 7));
      ASSERT_EQ(mesh->num_faces() * 3, primitive.indices.size());
      for (std::uint32_t f = 0; f < mesh->num_faces(); ++f) {
        for (std::size_t c = 0; c < 3; ++c) {
          ASSERT_EQ(primitive.indices[f * 3 + c], mesh->face(draco::FaceIndex(f))[c].value());
        }
      }
    }
  }
}
#endif

// Attributes that are not quantised come back as they were, of whatever type.
TEST(Draco, OtherAttributesStayAsTheyAre) {
  const Sheet sheet;
  std::vector<std::uint8_t> colors;
  for (std::size_t i = 0; i < kCount * 4; ++i) colors.push_back(static_cast<std::uint8_t>(i * 7));
  for (const auto method : {draco::MESH_EDGEBREAKER_ENCODING, draco::MESH_SEQUENTIAL_ENCODING}) {
    const std::string packed =
        PackDraco(kCount, sheet.indices,
                  {{draco::GeometryAttribute::POSITION, draco::DT_FLOAT32, 3, sheet.positions.data()},
                   {draco::GeometryAttribute::NORMAL, draco::DT_FLOAT32, 3, sheet.normals.data()},
                   {draco::GeometryAttribute::COLOR, draco::DT_UINT8, 4, colors.data()}},
                  {method, 5});
    const LoadedScene loaded =
        Load(packed, {{"POSITION", "VEC3"}, {"NORMAL", "VEC3"}, {"COLOR_0", "VEC4", 5121}}, sheet.indices.size());
    const Primitive& primitive = First(loaded);
    ASSERT_EQ(primitive.positions.size(), kCount);
    // The encoder may change the order of the points.
    for (std::size_t i = 0; i < kCount; ++i) {
      const auto found = std::find(sheet.positions.begin(), sheet.positions.end(), primitive.positions[i]);
      ASSERT_NE(found, sheet.positions.end());
      const auto at = static_cast<std::size_t>(found - sheet.positions.begin());
      ASSERT_EQ(primitive.normals[i], sheet.normals[at]);
      for (int c = 0; c < 4; ++c) {
        ASSERT_EQ(primitive.colors[i][c], float(colors[at * 4 + static_cast<std::size_t>(c)]) / 255.0f);
      }
    }
  }
}

}  // namespace
}  // namespace facet
