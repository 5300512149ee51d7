// Files that are no glTF files are called by their name.
#include "gltf/recognize.h"

#include <gtest/gtest.h>

#include "gltf_files.h"

namespace facet {
namespace {

using namespace std::string_literals;
using testing::LoadError;

struct Foreign {
  std::string bytes;
  const char* what;
  const char* hint;  // a part of it
};

std::vector<Foreign> ForeignFiles() {
  const std::string zip = "PK\x03\x04\x0A\0\0\0"s;
  std::string tar(512, '\0');
  tar.replace(0, 9, "model.glb");
  tar.replace(257, 5, "ustar");
  std::string stl(84 + 50 * 2, 'x');
  stl.replace(80, 4, "\2\0\0\0"s);
  return {
      {"version https://git-lfs.github.com/spec/v1\noid sha256:00\nsize 1\n", "a Git LFS pointer", "git lfs pull"},
      {"<!DOCTYPE html><html><body>404</body></html>", "an HTML page", "fetch the file itself"},
      {"\xEF\xBB\xBF\n <HTML lang=\"en\">", "an HTML page", "fetch the file itself"},
      {"<?xml version=\"1.0\"?><Error><Code>AccessDenied</Code></Error>", "an XML document", "server's answer"},
      {"<?xml version=\"1.0\"?>\n<COLLADA xmlns=\"x\">", "a COLLADA file", "Blender"},
      {"<svg xmlns=\"http://www.w3.org/2000/svg\"/>", "an SVG picture", "the glTF file that uses it"},
      {"\x1F\x8B\x08\0\0\0\0\0"s, "compressed by gzip", "gunzip"},
      {"BZh91AY&SY\x01\x02"s, "compressed by bzip2", "bunzip2"},
      {"\xFD"s + "7zXZ\0\0"s, "compressed by xz", "unxz"},
      {"\x28\xB5\x2F\xFD\x04", "compressed by Zstandard", "unzstd"},
      {zip + "scene.gltf", "a zip archive", "unpack it"},
      {zip + "scene.usdc", "a USDZ file", "Blender"},
      {zip + "3D/3dmodel.model", "a 3MF file", "Blender"},
      {tar, "a tar archive", "unpack it"},
      {"7z\xBC\xAF\x27\x1C", "a 7z archive", "unpack it"},
      {"\x89PNG\r\n\x1A\n\0\0\0\x0DIHDR"s, "a PNG picture", "the glTF file that uses it"},
      {"\xFF\xD8\xFF\xE0\0\x10JFIF"s, "a JPEG picture", "the glTF file that uses it"},
      {"RIFF\x10\0\0\0WEBPVP8 "s, "a WebP picture", "the glTF file that uses it"},
      {"\xABKTX 20\xBB\r\n\x1A\n", "a KTX2 picture", "the glTF file that uses it"},
      {"DDS |\0\0\0"s, "a DDS picture", ""},
      {"GIF89a", "a GIF picture", ""},
      {"BM\x36\0\0\0\0\0"s, "a BMP picture", ""},
      {"II*\0\x08\0\0\0"s, "a TIFF picture", ""},
      {"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n", "a Radiance HDR picture", ""},
      {"\x76\x2F\x31\x01\x02\0\0\0"s, "an OpenEXR picture", ""},
      {"8BPS\0\x01"s, "a Photoshop picture", ""},
      {"\0\0\0\x1C"
       "ftypavif"s,
       "an AVIF picture", ""},
      {"\0\0\0\x18"
       "ftypmp42"s,
       "a video", ""},
      {"%PDF-1.7", "a PDF document", ""},
      {"Kaydara FBX Binary  \0\x1A\0"s, "an FBX file", "convert it to glTF 2.0"},
      {"; FBX 7.3.0 project file\n", "an FBX file", "convert it to glTF 2.0"},
      {"BLENDER-v293", "a Blender file", "export it from Blender"},
      {"PXR-USDC\0"s, "a USD file", ""},
      {"#usda 1.0\n(\n)", "a USD file", ""},
      {"# Blender v2.8 OBJ File\nmtllib a.mtl\no Cube\nv 1 1 1\n", "an OBJ file", "convert it to glTF 2.0"},
      {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "an OBJ file", ""},
      {"newmtl red\nKd 1 0 0\n", "the materials of an OBJ file", ""},
      {"solid cube\nfacet normal 0 0 1\n", "an STL file", ""},
      {stl, "an STL file", ""},
      {"ply\nformat ascii 1.0\n", "a PLY file", ""},
      {"MM\x0A\0\0\0\x02\0\0\0"s, "a 3DS file", ""},
      {"DRACO\x02\x02\x01"s, "Draco's bare data", ""},
      {"b3dm\x01\0\0\0"s, "a 3D tile", "extract"},
      {"[InternetShortcut]\r\nURL=https://example.com/a.glb\r\n", "a shortcut to an address", "browser"},
      {"L\0\0\0\x01\x14\x02\0"s, "a Windows shortcut", "that it leads to"},
      {"\0\x05\x16\x07\0\x02\0\0"s, "what macOS keeps beside a file", "._"},
      {"\xFF\xFE{\0\"\0"s, "text in UTF-16", "save it as UTF-8"},
      {"{\0\"\0a\0"s, "text in UTF-16", "save it as UTF-8"},
      {std::string(64, '\0'), "zeros throughout", "fetch the file again"},
      {"404: Not Found", "text that begins with \"404: Not Found\"", "fetch the file again"},
      {"[1, 2]", "text that begins with \"[1, 2]\"", ""},
  };
}

TEST(Recognize, ForeignFilesAreCalledByTheirName) {
  for (const Foreign& foreign : ForeignFiles()) {
    const std::string message = LoadError(foreign.bytes, ErrorCode::InvalidInput);
    EXPECT_NE(message.find("test.glb: not a glTF file, but " + std::string(foreign.what)), std::string::npos)
        << message;
    EXPECT_NE(message.find(foreign.hint), std::string::npos) << message;
  }
}

// Beside a glTF file that is right, what it names may not be.
TEST(Recognize, BuffersAndPicturesThatWereNotFetched) {
  const std::string pointer = "version https://git-lfs.github.com/spec/v1\noid sha256:0\n";
  const testing::TempFolder folder;
  testing::FileMaker file;
  file.Attribute("POSITION", file.Floats(std::vector<float>(99, 1.0f), "VEC3", 3));
  file.RootMore() = R"(,"images":[{"uri":"a.png"},{"uri":"b.png"}])";
  folder.Write("a.bin", pointer);
  folder.Write("a.png", pointer);
  folder.Write("b.png", "<!DOCTYPE html><html>");
  try {
    LoadGltf(folder.Write("a.gltf", file.Json("a.bin")));
    ADD_FAILURE() << "no error";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("it is a Git LFS pointer in place of the file; run \"git lfs pull\""),
              std::string::npos)
        << error.what();
  }
  folder.Write("a.bin", file.Bin());
  const LoadedScene loaded = LoadGltf(folder.Write("a.gltf", file.Json("a.bin")));
  for (const auto& [image, what] :
       {std::pair(0, "not a picture, but a Git LFS pointer"), {1, "not a picture, but an HTML"}}) {
    try {
      loaded.scene.images.at(std::size_t(image)).source->Decode();
      ADD_FAILURE() << "no error";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::InvalidInput);
      EXPECT_NE(std::string(error.what()).find(what), std::string::npos) << error.what();
    }
  }
}

TEST(Recognize, LetsGltfFilesPass) {
  for (const std::string& bytes :
       {R"({"asset":{"version":"2.0"}})"s, "\xEF\xBB\xBF {\"asset\":{}}"s, "glTF\2\0\0\0"s}) {
    EXPECT_FALSE(gltf::RecognizeForeign(bytes)) << bytes;
  }
  // Neither one nor the other: the message quotes no parser.
  const std::string message = LoadError("\x01\x02\x03\x04 what is this\x7F\xFF", ErrorCode::InvalidInput);
  EXPECT_NE(message.find("neither JSON nor GLB"), std::string::npos) << message;
  EXPECT_NE(LoadError(R"({"asset":{"version":"1.0"},"geometricError":1})", ErrorCode::InvalidInput).find("3D Tiles"),
            std::string::npos);
}

}  // namespace
}  // namespace facet
