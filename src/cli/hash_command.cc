#include "cli/hash_command.h"

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/memory_budget.h"
#include "base/parallel.h"
#include "cli/console.h"
#include "facet/render.h"
#include "facet/version.h"

namespace facet::cli {
namespace {

using Line = std::pair<const char*, std::optional<Digest>>;

std::vector<Line> Digests(const HashOptions& options) {
  const RenderInputs inputs = LoadInputs(options.input, options.request, options.load);
  RenderStats stats;
  const Film film = Render(inputs.loaded.scene, inputs.settings, &stats);
  std::vector<std::string> warnings = inputs.loaded.report.warnings;
  warnings.insert(warnings.end(), stats.warnings.begin(), stats.warnings.end());
  PrintWarnings(warnings, options.strict, options.input.string());
  const SceneDigests scene = HashScene(inputs.loaded.scene);
  return {{"film", HashFilm(film)},
          {"pixels", HashImage(Develop(film, options.request.display, options.request.type))},
          {"description", scene.description},
          {"geometry", scene.geometry},
          {"textures", scene.textures},
          {"environment", HashEnvironment(inputs.settings.environment)}};
}

std::string Text(const std::vector<Line>& lines) {
  std::string text;
  for (const auto& [name, digest] : lines) {
    std::string label = name;
    label.resize(13, ' ');
    text += label + (digest ? ToHex(*digest) : "none") + "\n";
  }
  return text;
}

std::string Json(const std::vector<Line>& lines) {
  nlohmann::ordered_json json;
  json["facet"] = Version();
  for (const auto& [name, digest] : lines) {
    json[name] = digest ? nlohmann::ordered_json(ToHex(*digest)) : nlohmann::ordered_json(nullptr);
  }
  return json.dump(2) + "\n";
}

}  // namespace

void RunHash(const HashOptions& options) {
  MemoryBudget budget(options.load.memory_limit);  // of what is neither loading nor rendering
  const MemoryBudget::Scope scope(budget);
  std::vector<Line> lines;
  RunWithThreads(options.request.settings.threads, [&] { lines = Digests(options); });
  PrintOutput(options.json ? Json(lines) : Text(lines));
}

}  // namespace facet::cli
