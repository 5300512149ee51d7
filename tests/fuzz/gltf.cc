// glTF files: loaded, and what was loaded rendered.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>
#include <optional>
#include <vector>

#include "facet/load.h"
#include "facet/render.h"
#include "fuzz/fuzz.h"
#include "fuzz/json_mutator.h"

namespace facet::fuzz {
namespace {

// --- The container --------------------------------------------------------------------------------------------------

struct File {
  Json json;
  bool binary = false;
  std::string bin;
};

std::uint32_t WordAt(std::string_view bytes, std::size_t at) {
  std::uint32_t word = 0;
  if (at + sizeof word <= bytes.size()) std::memcpy(&word, bytes.data() + at, sizeof word);
  return word;
}

std::string Word(std::size_t value) {
  const auto word = static_cast<std::uint32_t>(value);
  return {reinterpret_cast<const char*>(&word), sizeof word};
}

std::optional<File> ParseFile(std::string_view bytes) {
  File file;
  std::string_view text = bytes;
  if (bytes.starts_with("glTF")) {
    file.binary = true;
    if (bytes.size() < 20) return std::nullopt;
    text = bytes.substr(20).substr(0, WordAt(bytes, 12));
    const std::size_t bin = 20 + text.size();
    if (bin + 8 < bytes.size()) file.bin = bytes.substr(bin + 8).substr(0, WordAt(bytes, bin));
  }
  std::optional<Json> json = ParseJson(text);
  if (!json || !json->is_object()) return std::nullopt;
  file.json = *std::move(json);
  return file;
}

std::string Dump(const File& file) {
  std::string json = DumpJson(file.json);
  if (!file.binary) return json;
  std::string bin = file.bin;
  json.resize((json.size() + 3) / 4 * 4, ' ');
  bin.resize((bin.size() + 3) / 4 * 4, '\0');
  std::string chunks = Word(json.size()) + "JSON" + json;
  if (!bin.empty()) chunks += Word(bin.size()) + std::string("BIN\0", 4) + bin;
  return "glTF" + Word(2) + Word(12 + chunks.size()) + chunks;
}

void MutateBin(File& file, std::size_t max_size, Random& random) {
  // All of it, or a part: compressed data is small beside the rest.
  const std::size_t first = Below(2, random) == 0 ? 0 : Below(file.bin.size(), random);
  const std::size_t size = std::min<std::size_t>(file.bin.size() - first, 4096);
  std::vector<std::uint8_t> part(std::min(size + 256, std::max(size, max_size)));
  std::memcpy(part.data(), file.bin.data() + first, size);
  const std::size_t changed = LLVMFuzzerMutate(part.data(), size, Below(4, random) == 0 ? part.size() : size);
  file.bin.replace(first, size, reinterpret_cast<const char*>(part.data()), changed);
}

// --- The work -------------------------------------------------------------------------------------------------------

void Draw(const Scene& scene, const RenderSettings& settings) {
  Film film;
  if (Try([&] { film = Render(scene, settings); }) != Outcome::Done) return;
  for (const glm::vec4& pixel : film.pixels) {
    for (int c = 0; c < 4; ++c) Check(std::isfinite(pixel[c]), "a pixel is not finite");
  }
}

RenderSettings Small() {
  RenderSettings settings;
  settings.width = settings.height = 16;
  settings.samples = 1;
  settings.threads = 1;
  settings.environment.kind = EnvironmentSettings::Kind::None;
  settings.memory_limit = kMemoryLimit;
  return settings;
}

// The last of each thing, moved, seen by the file's own camera.
RenderSettings Other(const Scene& scene) {
  RenderSettings settings = Small();
  const auto last = [](const auto& list) { return static_cast<int>(std::size(list)) - 1; };
  settings.scene = last(scene.scenes);
  settings.animation = last(scene.animations);
  settings.time = 0.37;
  settings.variant = last(scene.variants);
  settings.tangents = TangentSource::Generated;
  settings.texels = TexelBits::Sixteen;
  if (!scene.cameras.empty()) settings.camera = SceneCamera{last(scene.cameras)};
  return settings;
}

}  // namespace

void Run(std::span<const std::byte> input) {
  static const ScratchFolder folder = [] {
    ScratchFolder made;
    std::string numbers;  // what other files than the scene's own are
    for (int i = 0; i < 512; ++i) numbers += Word(static_cast<std::size_t>(i) * 2654435761u);
    made.Write("data.bin", numbers);
    return made;
  }();
  const std::filesystem::path path = folder.Write("scene.glb", AsText(input));
  LoadedScene loaded;
  if (Try([&] { loaded = LoadGltf(path, {.memory_limit = kMemoryLimit}); }) != Outcome::Done) return;
  try {
    ValidateScene(loaded.scene);
  } catch (const Error& error) {
    Fail(std::string("a scene was loaded that breaks the rules: ") + error.what());
  }
  Draw(loaded.scene, Small());
  Draw(loaded.scene, Other(loaded.scene));
}

}  // namespace facet::fuzz

using namespace facet::fuzz;

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                               unsigned seed) {
  Random random(seed);
  std::optional<File> file = ParseFile({reinterpret_cast<const char*>(data), size});
  if (!file || Below(16, random) == 0) return LLVMFuzzerMutate(data, size, max_size);
  for (std::size_t i = 0, count = 1 + Below(4, random); i < count; ++i) {
    if (!file->bin.empty() && Below(4, random) == 0) {
      MutateBin(*file, max_size, random);
    } else {
      MutateJson(file->json, random);
    }
  }
  const std::string bytes = Dump(*file);
  if (bytes.size() > max_size) return LLVMFuzzerMutate(data, size, max_size);
  std::memcpy(data, bytes.data(), bytes.size());
  return bytes.size();
}

extern "C" std::size_t LLVMFuzzerCustomCrossOver(const std::uint8_t* a, std::size_t a_size, const std::uint8_t* b,
                                                 std::size_t b_size, std::uint8_t* out, std::size_t max_size,
                                                 unsigned seed) {
  Random random(seed);
  std::optional<File> file = ParseFile({reinterpret_cast<const char*>(a), a_size});
  const std::optional<File> other = ParseFile({reinterpret_cast<const char*>(b), b_size});
  if (!file || !other) return 0;
  SpliceJson(file->json, other->json, random);
  const std::string bytes = Dump(*file);
  if (bytes.size() > max_size) return 0;
  std::memcpy(out, bytes.data(), bytes.size());
  return bytes.size();
}
