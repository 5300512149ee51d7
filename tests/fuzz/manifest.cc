// Manifests of golden tests: read, written anew, and run where that is little work.
#include "check/manifest.h"
#include "base/memory_budget.h"
#include "cli/tiny_scene.h"
#include "facet/check.h"
#include "fuzz/fuzz.h"
#include "fuzz/json_mutator.h"

namespace facet::fuzz {
namespace {

constexpr const char* kFile = "manifest.json";

// What takes long for other reasons than a fault.
bool IsLittleWork(const Manifest& manifest) {
  if (manifest.entries.size() > 4) return false;
  for (const ManifestEntry& entry : manifest.entries) {
    const RenderSettings& settings = entry.request.settings;
    if (settings.width * settings.height * settings.samples > 4096 || settings.environment_size > 128 ||
        settings.environment_samples > 24 || entry.request.environment) {
      return false;
    }
  }
  return true;
}

}  // namespace

void Run(std::span<const std::byte> input) {
  static const ScratchFolder folder = [] {
    ScratchFolder made;
    made.Write("scene.gltf", test::TinyScene());
    return made;
  }();
  const std::filesystem::path path = folder.Write(kFile, AsText(input));
  bool little_work = false;
  const Outcome read = Try([&] {
    MemoryBudget budget(kMemoryLimit);
    const MemoryBudget::Scope scope(budget);
    const Manifest manifest = ReadManifest(path);
    little_work = IsLittleWork(manifest);
    std::vector<NewExpectation> expectations;
    for (std::size_t i = 0; i < manifest.entries.size(); ++i) {
      const ManifestEntry& entry = manifest.entries[i];
      for (const std::string& setting : entry.own_settings) SettingPointer(entry, setting);
      if (!entry.problem) expectations.push_back({i, {}, {Digest{}, Digest{}, Digest{}, std::nullopt}});
    }
    const std::string text = Rewritten(manifest, expectations);
    const Manifest again = ReadManifest(folder.Write("rewritten.json", text));
    Check(again.entries.size() == manifest.entries.size(), "a manifest that was rewritten has other entries");
    for (const NewExpectation& expectation : expectations) {
      const ManifestEntry& entry = again.entries[expectation.entry];
      Check(!entry.problem, "a manifest that was rewritten has a new problem");
      Check(entry.expect.film == Digest{}, "what was written into a manifest is not there");
    }
  });
  if (read != Outcome::Done || !little_work) return;
  Try([&] {
    const CheckReport report =
        CheckManifest(path, {.threads = 1, .pictures = true, .load = {.memory_limit = kMemoryLimit, .root = {}}});
    for (const CheckedEntry& entry : report.entries) {
      Check(entry.message.find("a defect of facet") == std::string::npos, entry.message);
    }
    CheckHtml(report);
    JUnitXml(report);
  });
}

}  // namespace facet::fuzz
