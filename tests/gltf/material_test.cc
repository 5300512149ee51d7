// Materials, textures, samplers and pictures.
#include <gtest/gtest.h>

#include "gltf/uri.h"
#include "gltf_files.h"

namespace facet {
namespace {

using testing::LoadBytes;
using testing::LoadError;
using testing::TempFolder;

std::string Root(const std::string& members) { return R"({"asset":{"version":"2.0"},)" + members + "}"; }

TEST(MaterialFile, DefaultsAreTheSpecifications) {
  const Material material = LoadBytes(Root(R"("materials":[{}])")).scene.materials.at(0);
  EXPECT_EQ(material.base_color_factor, glm::vec4(1));
  EXPECT_EQ(material.metallic_factor, 1.0f);
  EXPECT_EQ(material.roughness_factor, 1.0f);
  EXPECT_EQ(material.normal_scale, 1.0f);
  EXPECT_EQ(material.occlusion_strength, 1.0f);
  EXPECT_EQ(material.emissive_factor, glm::vec3(0));
  EXPECT_EQ(material.emissive_strength, 1.0f);
  EXPECT_EQ(material.alpha_mode, AlphaMode::Opaque);
  EXPECT_EQ(material.alpha_cutoff, 0.5f);
  EXPECT_FALSE(material.double_sided);
  EXPECT_EQ(material.model, ShadingModel::MetallicRoughness);
  EXPECT_FALSE(material.base_color_texture);
  EXPECT_FALSE(material.normal_texture);
}

TEST(MaterialFile, EveryMember) {
  const LoadedScene loaded = LoadBytes(Root(R"("extensionsUsed":["KHR_materials_unlit","KHR_texture_transform",
      "KHR_materials_emissive_strength"],"images":[{"uri":"data:image/png;base64,AAAA"}],
      "textures":[{"source":0},{"source":0}],"materials":[{"name":"m","pbrMetallicRoughness":{"baseColorFactor":
      [0.1,0.2,0.3,0.4],"metallicFactor":0,"roughnessFactor":0.25,"baseColorTexture":
      {"index":1,"texCoord":2,"extensions":
      {"KHR_texture_transform":{"offset":[0.5,-1],"rotation":1.5,"scale":[2,3],"texCoord":1}}},
      "metallicRoughnessTexture":{"index":0}},"normalTexture":{"index":1,"scale":-2},
      "occlusionTexture":{"index":0,"strength":0.5,"texCoord":1},"emissiveTexture":{"index":1},
      "emissiveFactor":[1,0.5,0],"alphaMode":"MASK","alphaCutoff":0.75,"doubleSided":true,
      "extensions":{"KHR_materials_unlit":{},"KHR_materials_emissive_strength":{"emissiveStrength":7.5}}}])"));
  const Material& material = loaded.scene.materials.at(0);
  EXPECT_TRUE(loaded.report.warnings.empty());
  EXPECT_EQ(material.name, "m");
  EXPECT_EQ(material.base_color_factor, glm::vec4(0.1f, 0.2f, 0.3f, 0.4f));
  EXPECT_EQ(material.metallic_factor, 0.0f);
  EXPECT_EQ(material.roughness_factor, 0.25f);
  EXPECT_EQ(material.base_color_texture.texture, 1);
  EXPECT_EQ(material.base_color_texture.tex_coord, 1) << "the extension's set wins";
  EXPECT_EQ(material.base_color_texture.offset, glm::vec2(0.5f, -1.0f));
  EXPECT_EQ(material.base_color_texture.scale, glm::vec2(2, 3));
  EXPECT_EQ(material.base_color_texture.rotation, 1.5f);
  EXPECT_EQ(material.metallic_roughness_texture.texture, 0);
  EXPECT_EQ(material.normal_texture.texture, 1);
  EXPECT_EQ(material.normal_scale, -2.0f);
  EXPECT_EQ(material.occlusion_texture.tex_coord, 1);
  EXPECT_EQ(material.occlusion_strength, 0.5f);
  EXPECT_EQ(material.emissive_texture.texture, 1);
  EXPECT_EQ(material.emissive_factor, glm::vec3(1, 0.5f, 0));
  EXPECT_EQ(material.emissive_strength, 7.5f);
  EXPECT_EQ(material.alpha_mode, AlphaMode::Mask);
  EXPECT_EQ(material.alpha_cutoff, 0.75f);
  EXPECT_TRUE(material.double_sided);
  EXPECT_EQ(material.model, ShadingModel::Unlit);
}

TEST(MaterialFile, FactorsOutOfRangeAreClampedWithAWarning) {
  const LoadedScene loaded =
      LoadBytes(Root(R"("materials":[{"pbrMetallicRoughness":{"roughnessFactor":1.5,"metallicFactor":-1}}])"));
  EXPECT_EQ(loaded.scene.materials[0].roughness_factor, 1.0f);
  EXPECT_EQ(loaded.scene.materials[0].metallic_factor, 0.0f);
  EXPECT_EQ(loaded.report.warnings.size(), 2u);
}

TEST(MaterialFile, SamplersAndTheirDefaults) {
  const auto read = [](const std::string& sampler) {
    return LoadBytes(Root("\"samplers\":[" + sampler + R"(],"textures":[{"sampler":0}])")).scene.textures.at(0).sampler;
  };
  const Sampler none = read("{}");
  EXPECT_EQ(none.wrap_u, Wrap::Repeat);
  EXPECT_EQ(none.magnification, Filter::Linear);
  EXPECT_EQ(none.minification, Filter::Linear);
  EXPECT_EQ(none.mip, MipFilter::Linear);
  const Sampler wraps = read(R"({"wrapS":33071,"wrapT":33648,"magFilter":9728})");
  EXPECT_EQ(wraps.wrap_u, Wrap::ClampToEdge);
  EXPECT_EQ(wraps.wrap_v, Wrap::MirroredRepeat);
  EXPECT_EQ(wraps.magnification, Filter::Nearest);
  const std::tuple<int, Filter, MipFilter> filters[] = {
      {9728, Filter::Nearest, MipFilter::None},    {9729, Filter::Linear, MipFilter::None},
      {9984, Filter::Nearest, MipFilter::Nearest}, {9985, Filter::Linear, MipFilter::Nearest},
      {9986, Filter::Nearest, MipFilter::Linear},  {9987, Filter::Linear, MipFilter::Linear}};
  for (const auto& [value, minification, mip] : filters) {
    const Sampler sampler = read("{\"minFilter\":" + std::to_string(value) + "}");
    EXPECT_EQ(sampler.minification, minification) << value;
    EXPECT_EQ(sampler.mip, mip) << value;
  }
  const Sampler unknown = read("{\"wrapS\":10496,\"wrapT\":-1,\"magFilter\":1,\"minFilter\":\"LINEAR\"}");
  EXPECT_EQ(unknown.wrap_u, Wrap::Repeat);
  EXPECT_EQ(unknown.wrap_v, Wrap::Repeat);
  EXPECT_EQ(unknown.magnification, Filter::Linear);
  EXPECT_EQ(unknown.mip, MipFilter::Linear);
}

TEST(MaterialFile, TexturesOfExtensions) {
  const LoadedScene loaded = LoadBytes(Root(R"("extensionsUsed":["EXT_texture_webp","KHR_texture_basisu"],
      "images":[{"uri":"data:image/webp;base64,AAAA"},{"uri":"data:image/png;base64,AAAA"}],"textures":[
      {"extensions":{"EXT_texture_webp":{"source":0}}},{"source":1,"extensions":{"EXT_texture_webp":{"source":0}}},
      {"extensions":{"KHR_texture_basisu":{"source":0}}}])"));
  EXPECT_EQ(loaded.scene.textures[0].image, 0);
  EXPECT_EQ(loaded.scene.textures[1].image, 1) << "the fallback needs no module";
  EXPECT_EQ(loaded.scene.textures[2].image, -1);
  EXPECT_EQ(loaded.report.warnings,
            (std::vector<std::string>{"extensionsUsed: ignored: KHR_texture_basisu is not supported",
                                      "textures[2]: the texture's image needs KHR_texture_basisu; it stays white"}));
}

// A grey PNG of one pixel.
const char* const kOnePixelPng =
    "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAAAAAA6fptVAAAACklEQVR4nGNoAAAAggCBd81ytgAAAABJRU5ErkJggg==";

TEST(MaterialFile, PicturesFromFilesAndDataUrisAreDecodedWhenAsked) {
  const LoadedScene embedded =
      LoadBytes(Root(R"("images":[{"name":"dot","uri":"data:image/png;base64,)" + std::string(kOnePixelPng) + "\"}]"));
  EXPECT_EQ(embedded.scene.images.at(0).name, "dot");
  const Image image = embedded.scene.images[0].source->Decode();
  EXPECT_EQ(image.width, 1);
  EXPECT_EQ(image.height, 1);
  EXPECT_EQ(embedded.scene.images[0].source->Name(), "image 0 of test.glb");

  const TempFolder folder;
  const auto png = gltf::DecodeBase64(kOnePixelPng);
  ASSERT_TRUE(png);
  folder.Write("a dot.png", std::string(reinterpret_cast<const char*>(png->data), png->size));
  const LoadedScene beside = LoadGltf(folder.Write("a.gltf", Root(R"("images":[{"uri":"a%20dot.png"}])")));
  EXPECT_TRUE(beside.report.warnings.empty());
  EXPECT_EQ(beside.scene.images.at(0).source->Decode().width, 1);
}

TEST(MaterialFile, HeadersAreReadWithoutDecoding) {
  const auto expect = [](const ImageSource& source, const char* format, int width, int height, std::size_t bytes) {
    const auto header = source.Header();
    ASSERT_TRUE(header) << source.Name();
    EXPECT_EQ(header->format, format);
    EXPECT_EQ(header->width, width);
    EXPECT_EQ(header->height, height);
    EXPECT_EQ(header->bits, 8);
    EXPECT_EQ(header->bytes, bytes);
  };
  const auto png = gltf::DecodeBase64(kOnePixelPng);
  ASSERT_TRUE(png);
  // JPEGs of which there is only a header: at the start, and behind segments longer than one read.
  const std::string frame("\xFF\xC0\0\x11\x08\0\x20\0\x30\3 frame", 16);
  const std::string segment = std::string("\xFF\xE2\xFF\xFF", 4) + std::string(65533, 'x');
  const std::string near = "\xFF\xD8" + frame + std::string(100000, 'x');
  const std::string behind = "\xFF\xD8" + segment + segment + frame + std::string(100000, 'x');
  const TempFolder folder;
  folder.Write("near.jpg", near);
  folder.Write("behind.jpg", behind);
  folder.Write("gone.jpg", near);
  folder.Write("text.jpg", "no picture");
  const LoadedScene loaded = LoadGltf(folder.Write(
      "a.gltf", Root(R"("images":[{"uri":"near.jpg"},{"uri":"behind.jpg"},{"uri":"gone.jpg"},{"uri":"text.jpg"},
                                  {"uri":"nowhere.jpg"},{"uri":"data:image/png;base64,)" +
                     std::string(kOnePixelPng) + "\"}]")));
  const auto& images = loaded.scene.images;
  ASSERT_EQ(images.size(), 6u);
  expect(*images[0].source, "JPEG", 48, 32, near.size());
  expect(*images[1].source, "JPEG", 48, 32, behind.size());
  EXPECT_TRUE(images[2].source->Header());
  std::filesystem::remove(folder.Path() / "gone.jpg");
  for (const std::size_t i : {2u, 3u, 4u}) EXPECT_FALSE(images[i].source->Header()) << i;
  expect(*images[5].source, "PNG", 1, 1, png->size);
}

TEST(MaterialFile, MissingPicturesAreAWarningAndAnErrorWhenDecoded) {
  const LoadedScene loaded = LoadBytes(Root(R"("images":[{"uri":"nowhere.png"},{"uri":"data:image/png;base64,!"},{},
                                                {"uri":"https://example.com/a.png"}])"));
  EXPECT_EQ(loaded.report.warnings.size(), 4u);
  for (const SceneImage& image : loaded.scene.images) EXPECT_THROW(image.source->Decode(), Error);
  // What is no picture is found out when it is decoded.
  const LoadedScene broken = LoadBytes(Root(R"("images":[{"uri":"data:image/png;base64,AAAA"}])"));
  EXPECT_TRUE(broken.report.warnings.empty());
  EXPECT_THROW(broken.scene.images.at(0).source->Decode(), Error);
}

TEST(MaterialFile, AMissingPictureIsSaidOnce) {
  // Images that name one file, and textures that use them; of a texture without a picture nothing is decoded.
  const LoadedScene loaded = LoadBytes(Root(R"("images":[{"uri":"no.png"},{"uri":"no.png"}],
      "textures":[{"source":0},{"source":1},{"source":0}])"));
  ASSERT_EQ(loaded.report.warnings.size(), 1u);
  EXPECT_NE(loaded.report.warnings[0].find("no.png\" does not exist) (and in 1 more place)"), std::string::npos)
      << loaded.report.warnings[0];
  for (const Texture& texture : loaded.scene.textures) EXPECT_EQ(texture.image, -1);
  // The other picture of a texture stands in.
  const LoadedScene other = LoadBytes(Root(R"("images":[{"uri":"no.png"},{"uri":"data:image/webp;base64,AAAA"}],
      "textures":[{"source":0,"extensions":{"EXT_texture_webp":{"source":1}}}])"));
  EXPECT_EQ(other.scene.textures[0].image, 1);
}

TEST(MaterialFile, Base64OfPicturesMayHaveBlanks) {
  std::string spread;
  for (const char c : std::string(kOnePixelPng)) spread += std::string(1, c) + (spread.size() % 3 ? "\\n" : " ");
  const LoadedScene loaded = LoadBytes(Root("\"images\":[{\"uri\":\"data:image/png; BASE64 ," + spread + "\"}]"));
  EXPECT_TRUE(loaded.report.warnings.empty());
  EXPECT_EQ(loaded.scene.images.at(0).source->Decode().width, 1);
}

}  // namespace
}  // namespace facet
