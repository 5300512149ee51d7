// The table of the model "enterprise" is that of the specification: names, types, ranges, defaults, subtypes. Read from
// the specification's own tables, where the corpus has them.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "material/model_parameters.h"

namespace facet {
namespace {

using Json = nlohmann::ordered_json;

std::filesystem::path Folder() {
  const char* corpus = std::getenv("FACET_CORPUS");
  return std::filesystem::path(corpus != nullptr ? corpus : FACET_SOURCE_DIR "/../shared/corpus") / "enterprise-pbr";
}

#define NEED_TABLES()                                                              \
  if (!std::filesystem::exists(Folder() / "params-2025x.json")) {                  \
    GTEST_SKIP() << "the specification's tables are not at " << Folder().string(); \
  }

Json ReadTable(const char* version) {
  std::ifstream file(Folder() / (std::string("params-") + version + ".json"));
  return Json::parse(file)["materials"];
}

// --- Values as JSON, rounded as the table's numbers are
// ---------------------------------------------------------------

Json Number(float value) {
  if (std::isinf(value)) return {{"infinity", true}};
  return std::round(double(value) * 1e7) / 1e7;
}
Json ToJson(const RowOptions&, float value) { return Number(value); }
Json ToJson(const RowOptions&, const glm::vec3& v) { return Json::array({Number(v.x), Number(v.y), Number(v.z)}); }
Json ToJson(const RowOptions&, bool value) { return value; }
template <class Value>
requires std::is_enum_v<Value> Json ToJson(const RowOptions& row, Value value) { return row.words[std::size_t(value)]; }
template <class Value>
requires kHasTexture<Value> Json ToJson(const RowOptions& row, const Value& value) { return ToJson(row, value.value); }

template <class Value>
std::string TypeOf(const std::string& name) {
  if constexpr (std::is_same_v<Value, bool>) return "boolean";
  if constexpr (std::is_enum_v<Value>) return "enum";
  if constexpr (std::is_same_v<Value, float> || std::is_same_v<Value, Textured<float>>) return "float";
  if constexpr (std::is_same_v<Value, TangentSpaceNormal>) return "normal";
  return name == "displacement" ? "vector" : "color";
}

// Calls visit(row, value of the block, whether it may be textured, type) for each row of the specification.
template <class Visit>
void ForEachSpecified(const EnterpriseParameters& p, const Visit& visit) {
  std::size_t row = 0;
  ForEachParameterOf(p, [&]<class Value>(const auto& parameter, const Value& value) {
    if (row++ >= kEnterpriseSpecifiedRows) return;
    visit(parameter, value, kHasTexture<Value>, TypeOf<Value>(parameter.name));
  });
}

// The ends of a range, as the table has them for a type.
Json Bound(const Json& entry, const char* key, const std::string& type, double by_default) {
  const Json bound = entry.contains(key) ? entry[key] : Json(by_default);
  return type == "color" && bound.is_array() ? bound[0] : bound;
}

void ExpectTable(const char* version, std::size_t count) {
  const Json generic = ReadTable(version)["generic"]["parameters"];
  EXPECT_EQ(generic.size(), count);
  std::size_t found = 0;
  std::string last;
  int last_order = -1;
  ForEachSpecified(
      EnterpriseParameters(), [&](const auto& row, const auto& value, bool textured, const std::string& type) {
        if (!generic.contains(row.name)) {
          EXPECT_STREQ(version, "2022x") << row.name;
          return;
        }
        ++found;
        const Json& entry = generic[row.name];
        EXPECT_EQ(entry["type"], type) << row.name;
        EXPECT_EQ(ToJson(row, value), entry["default"]) << row.name;
        const int order = entry["uiOrder"].get<int>();
        EXPECT_GT(order, last_order) << row.name << " after " << last;
        last_order = order, last = row.name;
        // Displacement is not drawn, so it has no texture.
        EXPECT_TRUE(type == "vector" || textured == !entry.value("uniform", false)) << row.name;
        const Json words(std::vector<std::string>(row.words.begin(), row.words.end()));
        EXPECT_EQ(entry.value("enum", Json(std::vector<std::string>())), words);
        if (type == "float" || type == "color") {
          const double infinity = std::numeric_limits<double>::infinity();
          EXPECT_EQ(double(row.range.low), Bound(entry, "min", type, type == "color" ? 0.0 : -infinity)) << row.name;
          EXPECT_EQ(double(row.range.high), Bound(entry, "max", type, infinity)) << row.name;
        }
      });
  EXPECT_EQ(found, count);
}

TEST(EnterpriseTable, IsThatOf2025x) {
  NEED_TABLES();
  ExpectTable("2025x", 38);
}
TEST(EnterpriseTable, IsThatOf2022x) {
  NEED_TABLES();
  ExpectTable("2022x", 34);
}

void ExpectPresets(const char* version) {
  const Json materials = ReadTable(version);
  EXPECT_EQ(materials.size(), kEnterprisePresets.size() + 1);
  for (const std::string_view name : kEnterprisePresets) {
    ASSERT_TRUE(materials.contains(name)) << name;
    const Json& preset = materials[std::string(name)]["parameters"];
    ForEachSpecified(EnterprisePreset(name), [&](const auto& row, const auto& value, bool, const std::string&) {
      if (!materials["generic"]["parameters"].contains(row.name)) return;
      Json expected = materials["generic"]["parameters"][row.name]["default"];
      if (preset.contains(row.name) && preset[row.name].contains("default")) expected = preset[row.name]["default"];
      if (expected.is_object() && expected.contains("$ref")) {
        expected = Json{{"materials", materials}}.at(Json::json_pointer(expected["$ref"].get<std::string>().substr(1)));
      }
      EXPECT_EQ(ToJson(row, value), expected) << name << " " << row.name;
    });
  }
}

TEST(EnterpriseTable, PresetsAreThoseOf2025x) {
  NEED_TABLES();
  ExpectPresets("2025x");
}
TEST(EnterpriseTable, PresetsAreThoseOf2022x) {
  NEED_TABLES();
  ExpectPresets("2022x");
}

TEST(EnterpriseTable, UnknownPresetsAreRefused) { EXPECT_ANY_THROW(EnterprisePreset("chrome")); }

TEST(EnterpriseTable, FitsTheSlots) {
  std::size_t textures = 0;
  std::size_t row = 0;
  ForEachParameterOf(EnterpriseParameters(), [&]<class Value>(const auto&, const Value&) {
    const std::size_t slot = SlotNumber<EnterpriseParameters>(row++);
    if (!kHasTexture<Value>) return;
    ++textures;
    EXPECT_LT(slot, kMaxSlots);
  });
  EXPECT_EQ(textures, 26u);
}

}  // namespace
}  // namespace facet
