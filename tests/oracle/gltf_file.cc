#include "oracle/gltf_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "facet/load.h"

namespace oracle {
namespace {

std::string Base64(const std::string& bytes) {
  const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) group = group << 8 | (i + k < bytes.size() ? std::uint8_t(bytes[i + k]) : 0u);
    for (int k = 3; k >= 0; --k) text += i + std::size_t(3 - k) > bytes.size() ? '=' : digits[group >> (6 * k) & 63];
  }
  return text;
}

std::string Big32(std::uint32_t n) { return {char(n >> 24), char(n >> 16), char(n >> 8), char(n)}; }

// ISO/IEC 15948 (PNG), 5.3 and annex D.
std::string Chunk(const std::string& type, const std::string& data) {
  std::uint32_t crc = 0xFFFFFFFFu;
  for (const char c : type + data) {
    crc ^= std::uint8_t(c);
    for (int k = 0; k < 8; ++k) crc = crc & 1 ? crc >> 1 ^ 0xEDB88320u : crc >> 1;
  }
  return Big32(std::uint32_t(data.size())) + type + data + Big32(~crc);
}

// One stored block (RFC 1950, RFC 1951): images here have less than 64 KiB.
std::string Png(const Texels& texels) {
  std::string rows;
  for (int y = 0; y < texels.height; ++y) {
    rows += '\0';
    for (int i = 0; i < texels.width * 4; ++i) rows += char(texels.numbers[std::size_t(y * texels.width * 4 + i)]);
  }
  std::uint32_t a = 1, b = 0;
  for (const char c : rows) a = (a + std::uint8_t(c)) % 65521, b = (b + a) % 65521;
  const auto size = std::uint16_t(rows.size());
  std::string stored = {0x78, 0x01, 0x01, char(size), char(size >> 8), char(~size), char(~size >> 8)};
  stored += rows + Big32(b << 16 | a);
  return "\x89PNG\r\n\x1a\n" +
         Chunk("IHDR", Big32(std::uint32_t(texels.width)) + Big32(std::uint32_t(texels.height)) +
                           std::string("\x08\x06\0\0\0", 5)) +
         Chunk("IDAT", stored) + Chunk("IEND", "");
}

std::string Joined(const std::vector<std::string>& parts) {
  std::string text;
  for (const std::string& part : parts) text += (text.empty() ? "" : ",") + part;
  return text;
}

}  // namespace

std::string Number(double number) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", number);
  return text;
}

std::string List(const std::vector<double>& numbers) {
  std::vector<std::string> parts;
  for (const double number : numbers) parts.push_back(Number(number));
  return std::string("[").append(Joined(parts)).append("]");
}

Texels MakeTexels(int width, int height, const std::function<std::vector<int>(int, int)>& rgba) {
  Texels texels{width, height, {}};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (const int number : rgba(x, y)) texels.numbers.push_back(number);
    }
  }
  return texels;
}

int GltfFile::Add(const std::string& list, const std::string& object) {
  lists_[list].push_back(object);
  return int(lists_[list].size()) - 1;
}

int GltfFile::Accessor(const std::string& type, int component_type, std::size_t count, const std::string& bytes) {
  const std::string members =
      R"("byteOffset":)" + std::to_string(bytes_.size()) + R"(,"byteLength":)" + std::to_string(bytes.size());
  const int view = Add("bufferViews", R"({"buffer":0,)" + members + "}");
  bytes_ += bytes;
  bytes_.resize((bytes_.size() + 3) / 4 * 4);
  return Add("accessors", R"({"bufferView":)" + std::to_string(view) + R"(,"componentType":)" +
                              std::to_string(component_type) + R"(,"count":)" + std::to_string(count) + R"(,"type":")" +
                              type + "\"}");
}

int GltfFile::Floats(const std::string& type, const std::vector<double>& numbers) {
  std::string bytes;
  for (const double number : numbers) {
    const auto value = float(number);
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  const std::size_t width = type == "SCALAR" ? 1 : type == "MAT4" ? 16 : std::size_t(type[3] - '0');
  return Accessor(type, 5126, numbers.size() / width, bytes);
}

int GltfFile::Floats(const std::vector<Vec>& vectors) {
  std::vector<double> numbers;
  for (const Vec& v : vectors) numbers.insert(numbers.end(), {v.x, v.y, v.z});
  return Floats("VEC3", numbers);
}

int GltfFile::Shorts(const std::string& type, const std::vector<int>& numbers) {
  std::string bytes;
  for (const int number : numbers) bytes += {char(number), char(number >> 8)};
  return Accessor(type, 5123, numbers.size() / (type == "SCALAR" ? 1 : std::size_t(type[3] - '0')), bytes);
}

int GltfFile::Texture(const Texels& texels, const std::string& sampler) {
  const int image = Add("images", R"({"uri":"data:image/png;base64,)" + Base64(Png(texels)) + "\"}");
  const int at = Add("samplers", sampler);
  return Add("textures", R"({"source":)" + std::to_string(image) + R"(,"sampler":)" + std::to_string(at) + "}");
}

void GltfFile::Light(const std::string& light, const std::string& node_members) {
  Use("KHR_lights_punctual");
  Add("nodes",
      R"({"extensions":{"KHR_lights_punctual":{"light":)" + std::to_string(lights_.size()) + "}}" + node_members + "}");
  lights_.push_back(light);
}

void GltfFile::Use(const std::string& extension) {
  if (std::find(extensions_.begin(), extensions_.end(), extension) == extensions_.end()) {
    extensions_.push_back(extension);
  }
}

std::string GltfFile::Text() const {
  std::vector<std::string> members = {R"("asset":{"version":"2.0"},"scene":0)"};
  std::vector<std::string> roots, extensions;
  const auto nodes = lists_.find("nodes");
  const std::size_t node_count = nodes == lists_.end() ? 0 : nodes->second.size();
  for (const int root : roots_) roots.push_back(std::to_string(root));
  for (std::size_t i = 0; roots_.empty() && i < node_count; ++i) roots.push_back(std::to_string(i));
  members.push_back(R"("scenes":[{"nodes":[)" + Joined(roots) + "]}]");
  for (const auto& [name, objects] : lists_) members.push_back("\"" + name + "\":[" + Joined(objects) + "]");
  if (!bytes_.empty()) {
    members.push_back(R"("buffers":[{"byteLength":)" + std::to_string(bytes_.size()) +
                      R"(,"uri":"data:application/octet-stream;base64,)" + Base64(bytes_) + "\"}]");
  }
  for (const std::string& extension : extensions_) extensions.push_back("\"" + extension + "\"");
  if (!extensions.empty()) members.push_back(R"("extensionsUsed":[)" + Joined(extensions) + "]");
  if (!lights_.empty()) {
    members.push_back(R"("extensions":{"KHR_lights_punctual":{"lights":[)" + Joined(lights_) + "]}}");
  }
  return "{" + Joined(members) + "}";
}

Image Draw(const GltfFile& file, int width, int height, const std::function<void(facet::RenderSettings&)>& change) {
  const auto* test = testing::UnitTest::GetInstance()->current_test_info();
  const std::filesystem::path path = std::filesystem::path(testing::TempDir()) /
                                     (std::string("oracle_") + test->test_suite_name() + "_" + test->name() + ".gltf");
  std::ofstream(path) << file.Text();
  const facet::LoadedScene loaded = facet::LoadGltf(path);
  std::filesystem::remove(path);
  for (const std::string& warning : loaded.report.warnings) ADD_FAILURE() << warning;
  facet::RenderSettings settings;
  settings.width = width;
  settings.height = height;
  settings.samples = 1;
  settings.camera = facet::SceneCamera{0};
  settings.environment.kind = facet::EnvironmentSettings::Kind::None;
  settings.specular_antialiasing = false;  // the closed forms are of points
  if (change) change(settings);
  return {facet::Render(loaded.scene, settings)};
}

void ExpectColor(const Image& image, int x, int y, Vec expected, double tolerance, double floor) {
  const Vec got = image.Color(x, y);
  const double want[3] = {expected.x, expected.y, expected.z}, is[3] = {got.x, got.y, got.z};
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(is[c], want[c], tolerance * std::fmax(std::fabs(want[c]), floor))
        << "channel " << c << " of pixel " << x << ", " << y;
  }
}

void AddStraightCamera(GltfFile& file, double half, Vec eye) {
  const int camera = file.Add("cameras", R"({"type":"orthographic","orthographic":{"xmag":)" + Number(half) +
                                             R"(,"ymag":)" + Number(half) + R"(,"znear":0,"zfar":100}})");
  file.Add("nodes", R"({"camera":)" + std::to_string(camera) + R"(,"translation":)" + Numbers(eye) + "}");
}

std::string SquareAttributes(GltfFile& file, double half, const std::vector<double>& uv) {
  const int positions = file.Floats({{-half, -half, 0}, {half, -half, 0}, {half, half, 0}, {-half, half, 0}});
  const int normals = file.Floats(std::vector<Vec>(4, Vec{0, 0, 1}));
  return R"("POSITION":)" + std::to_string(positions) + R"(,"NORMAL":)" + std::to_string(normals) +
         R"(,"TEXCOORD_0":)" + std::to_string(file.Floats("VEC2", uv));
}

int SquareIndices(GltfFile& file) { return file.Shorts("SCALAR", {0, 1, 2, 0, 2, 3}); }

void AddSquare(GltfFile& file, double half, const std::string& material, const std::string& more_attributes,
               const std::string& node_members, const std::vector<double>& uv) {
  const int index = file.Add("materials", material);
  const std::string attributes = SquareAttributes(file, half, uv) + more_attributes;
  const int mesh =
      file.Add("meshes", R"({"primitives":[{"attributes":{)" + attributes + R"(},"indices":)" +
                             std::to_string(SquareIndices(file)) + R"(,"material":)" + std::to_string(index) + "}]}");
  file.Add("nodes", R"({"mesh":)" + std::to_string(mesh) + node_members + "}");
}

}  // namespace oracle
