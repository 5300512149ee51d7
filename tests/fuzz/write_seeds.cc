// write_seeds DECODER_FILES FOLDER: what each fuzzer begins with, one folder for each. DECODER_FILES: what the program
// decoder_files wrote.
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli/tiny_scene.h"
#include "facet/error.h"
#include "facet/film.h"
#include "gltf/everything.h"
#include "image/codec.h"
#include "measure/sample_error_report.h"
#include "settings/provenance.h"
#include "settings/render_request.h"

namespace facet::fuzz {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr std::size_t kMostBytes = 48 << 10;  // small inputs are tried faster, and more of their bytes matter

std::string Read(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

class Seeds {
 public:
  explicit Seeds(fs::path folder) : folder_(std::move(folder)) {}

  fs::path PathOf(const std::string& fuzzer, const std::string& name) const {
    fs::create_directories(folder_ / fuzzer);
    return folder_ / fuzzer / name;
  }
  void Write(const std::string& fuzzer, const std::string& name, const std::string& bytes) const {
    if (bytes.size() > kMostBytes) return;
    std::ofstream file(PathOf(fuzzer, name), std::ios::binary);
    if (!file.write(bytes.data(), static_cast<std::streamsize>(bytes.size())).flush()) {
      throw std::runtime_error("cannot write " + name);
    }
  }
  void WritePicture(const std::string& format, const std::string& name, const std::string& bytes) const {
    Write("picture_" + format, name, bytes);
    Write("picture_any", format + "-" + name, bytes);
  }

 private:
  fs::path folder_;
};

// The pictures in a .glb file of decoder_files, one by one.
void WritePicturesOf(const std::string& glb, const std::string& stem, const Seeds& seeds) {
  std::uint32_t json_size = 0;
  std::memcpy(&json_size, glb.data() + 12, sizeof json_size);
  const json root = json::parse(glb.substr(20, json_size));
  if (!root.contains("images")) return;
  int number = 0;
  for (const json& image : root["images"]) {
    const json& view = root["bufferViews"][image["bufferView"].get<std::size_t>()];
    const std::string bytes =
        glb.substr(20 + json_size + 8 + view["byteOffset"].get<std::size_t>(), view["byteLength"].get<std::size_t>());
    const std::string format = image["mimeType"].get<std::string>().substr(6);  // after "image/"
    seeds.WritePicture(format, stem + "-" + std::to_string(number++), bytes);
  }
}

void WriteDecoderFiles(const fs::path& folder, const Seeds& seeds) {
  const std::map<std::string, std::string> formats = {{".exr", "exr"}, {".tif", "tiff"}, {".hdr", "radiance"}};
  for (const auto& entry : fs::directory_iterator(folder)) {
    const fs::path& path = entry.path();
    const std::string bytes = Read(path);
    if (path.extension() == ".glb") {
      seeds.Write("gltf", path.filename(), bytes);
      WritePicturesOf(bytes, path.stem(), seeds);
    } else if (const auto format = formats.find(path.extension()); format != formats.end()) {
      seeds.WritePicture(format->second, path.filename(), bytes);
    }
  }
}

void WriteScenes(const Seeds& seeds) {
  seeds.Write("gltf", "tiny.gltf", test::TinyScene());
  json scene = testing::Everything();
  seeds.Write("gltf", "everything.gltf", scene.dump());
  scene["buffers"][0]["uri"] = "data.bin";
  seeds.Write("gltf", "everything-beside.gltf", scene.dump());
  scene["buffers"][0].erase("uri");
  std::string numbers;
  for (std::size_t i = 0; i < scene["buffers"][0]["byteLength"].get<std::size_t>() / 4 + 1; ++i) {
    numbers += testing::Pack({float(i % 7) * 0.25f - 0.5f});
  }
  seeds.Write("gltf", "everything.glb", testing::Glb(scene.dump(), numbers));
  seeds.Write("gltf", "empty.gltf", R"({"asset":{"version":"2.0"}})");
}

// One of each format that OpenImageIO writes, and text in those that hold some.
void WriteOtherPictures(const Seeds& seeds) {
  Image image{.width = 5, .height = 4, .channels = 3};
  for (int i = 0; i < 5 * 4 * 3; ++i) image.bytes.push_back(static_cast<std::byte>(i * 37));
  RenderRequest request;
  const ImageText text = ToImageText(
      {.version = "1", .scene = "scene.glb", .settings = SpelledOut(request), .film = {}, .pixels = HashImage(image)});
  for (const char* format : {"png", "exr", "bmp", "dpx", "fits", "gif", "hdr", "ico", "jp2", "j2c", "pgm", "pnm", "ppm",
                             "sgi", "tga", "tif", "heic", "avif"}) {
    try {
      WriteImage(seeds.PathOf("picture_any", std::string("small.") + format), image, text);
    } catch (const Error& error) {
      std::printf("no small.%s: %s\n", format, error.what());  // not every OpenImageIO writes every format
    }
  }
  for (const char* format : {"png", "exr"}) {
    WriteImage(seeds.PathOf("picture_text", std::string("small.") + format), image, text);
  }
}

void WriteSettings(const Seeds& seeds) {
  const RenderRequest request;
  seeds.Write("settings", "default.json", json(SpelledOut(request)).dump());
  json every;
  for (const RequestOption& option : RequestOptions()) {
    every[std::string(option.name)] = option.initial;
    if (!option.sweep.empty()) every[std::string(option.name)] = option.sweep.substr(0, option.sweep.find(' '));
  }
  seeds.Write("settings", "every.json", every.dump());
  seeds.Write("settings", "given.json", R"({"size":"64x32","samples":"8","orbit":"30,60,2","target":"0,1,-2","fov":"40",
    "exposure":"-1.5","background":"#abc","scene":"1","camera":"Front","animation":"0","time":"1.5","variant":"Blue",
    "without":"normal-map,skins","environment":"sky.hdr"})");
}

void WriteManifests(const Seeds& seeds) {
  const std::string digest(64, 'a');
  seeds.Write("manifest", "small.json",
              R"({"version": 1, "settings": {"size": "8x8", "samples": 1, "exposure": -1.5,
    "environment": "none"}, "entries": [{"name": "a", "scene": "scene.gltf"},
    {"name": "b", "scene": "scene.gltf", "settings": {"samples": "2", "camera": "Front", "animation": "Slide", "time": 0.5},
     "expect": {"film": ")" +
                  digest + R"(", "picture": "golden/b.png", "max-flip": 0.5, "max-pixels": 12, "min-psnr": -3,
                "max-rmse": 0.1, "max-difference": 0.2, "min-ssim": 0.9,
                "inputs": {"description": ")" +
                  digest + R"(", "geometry": ")" + digest + R"(", "textures": ")" + digest + R"(", "environment": ")" +
                  digest + R"("}}}]})");
  seeds.Write("manifest", "one.json", R"({"version":1,"entries":[{"name":"a","scene":"scene.gltf"}]})");
}

void WriteNumbers(const Seeds& seeds) {
  std::string bytes;
  for (int i = 0; i < 400; ++i) bytes += static_cast<char>(i * 73 ^ i >> 3);
  for (const std::size_t size : {1, 40, 400}) {
    seeds.Write("image_difference", std::to_string(size), bytes.substr(0, size));
    seeds.Write("environment_cache", std::to_string(size), std::string(size, '\0'));
  }
  const std::string half("\0\0\0\x3f", 4);
  seeds.Write("environment_cache", "half", std::string(113, '\0') + half);
}

void WriteAll(const fs::path& decoder_files, const fs::path& folder) {
  fs::remove_all(folder);
  const Seeds seeds(folder);
  WriteDecoderFiles(decoder_files, seeds);
  WriteScenes(seeds);
  WriteOtherPictures(seeds);
  WriteSettings(seeds);
  WriteManifests(seeds);
  WriteNumbers(seeds);
  seeds.Write("report", "sample.json", ToJson(test::SampleErrorReport()));
}

}  // namespace
}  // namespace facet::fuzz

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: write_seeds DECODER_FILES FOLDER\n");
    return 2;
  }
  try {
    facet::fuzz::WriteAll(argv[1], argv[2]);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "write_seeds: %s\n", error.what());
    return 2;
  }
}
