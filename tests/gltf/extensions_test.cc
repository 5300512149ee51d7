// Which extensions are supported, and that the page about them says the same.
#include "gltf/extensions.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <regex>
#include <set>

#include "material/models/models.h"
#include "material/parameters.h"

namespace facet {
namespace {

// The names between "Extensions of materials:" and the next section.
std::set<std::string> NamedByReadme() {
  std::ifstream file(std::string(FACET_SOURCE_DIR) + "/README.md");
  const std::string text(std::istreambuf_iterator<char>(file), {});
  const std::size_t begin = text.find("Extensions of materials:"), end = text.find("\n## ", begin);
  EXPECT_NE(begin, std::string::npos);
  const std::string part = text.substr(begin, end - begin);
  const std::regex name("(KHR|EXT)_[a-zA-Z_]+");
  std::set<std::string> names;
  for (std::sregex_iterator it(part.begin(), part.end(), name); it != std::sregex_iterator(); ++it) {
    names.insert(it->str());
  }
  return names;
}

TEST(Extensions, TheReadmeNamesThoseThatAreSupported) {
  const std::set<std::string> named = NamedByReadme();
  EXPECT_EQ(named.size(), 22u);
  for (const std::string& name : named) EXPECT_TRUE(gltf::IsSupported(name)) << name;
  ForEachParameter([&](const auto& parameter) {
    const std::string group = parameter.gltf_group != nullptr ? parameter.gltf_group : "";
    EXPECT_TRUE(!IsExtension(group) || named.contains(group.substr(0, group.find('.')))) << group;
  });
  for (const ModelInfo& model : kModels) {
    const std::string extension = model.gltf_extension != nullptr ? model.gltf_extension : "";
    EXPECT_TRUE(extension.empty() || named.contains(extension)) << extension;
  }
}

// What contains a supported name, or is a part of one, is another extension.
TEST(Extensions, OthersAreNot) {
  for (const char* name :
       {"", "KHR_materials", "KHR_materials_clearcoat.clearcoatNormalTexture", "pbrMetallicRoughness", "normalTexture",
        "KHR_materials_iors", "khr_materials_ior", "KHR_texture_basisu"}) {
    EXPECT_FALSE(gltf::IsSupported(name)) << name;
  }
}

}  // namespace
}  // namespace facet
