#include "cli/hash_command.h"

#include <algorithm>
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

using Line = std::pair<std::string, std::optional<Digest>>;

struct Lines {
  std::vector<Line> planes;  // of the film, except colour
  std::vector<Line> others;  // the film's is the first
};

Lines Digests(const HashOptions& options) {
  const RenderInputs inputs = LoadInputs(options.input, options.request, options.load);
  RenderStats stats;
  const Film film = Render(inputs.loaded.scene, inputs.settings, &stats);
  std::vector<std::string> warnings = inputs.loaded.report.warnings;
  warnings.insert(warnings.end(), stats.warnings.begin(), stats.warnings.end());
  PrintWarnings(warnings, options.strict, options.input.string());
  const SceneDigests scene = HashScene(inputs.loaded.scene);
  Lines lines;
  for (std::size_t i = 0; i < film.planes.size(); ++i) {
    lines.planes.emplace_back(InfoOf(film.planes[i].kind).name, HashPlane(film, i));
  }
  lines.others = {{"film", HashFilm(film)},
                  {"pixels", HashImage(EncodeFilm(film, options.request.display, options.request.type))},
                  {"description", scene.description},
                  {"geometry", scene.geometry},
                  {"textures", scene.textures},
                  {"environment", HashEnvironment(inputs.settings.environment)}};
  return lines;
}

// Lists the planes directly after the film.
std::string Text(Lines lines) {
  lines.others.insert(lines.others.begin() + 1, lines.planes.begin(), lines.planes.end());
  std::string text;
  for (const auto& [name, digest] : lines.others) {
    std::string label = name + " ";
    label.resize(std::max(label.size(), std::size_t{13}), ' ');
    text += label + (digest ? ToHex(*digest) : "none") + "\n";
  }
  return text;
}

// Planes are in an object of their own, so that their names cannot clash with other keys.
std::string Json(const Lines& lines) {
  nlohmann::ordered_json json;
  json["facet"] = Version();
  for (const auto& [name, digest] : lines.others) {
    json[name] = digest ? nlohmann::ordered_json(ToHex(*digest)) : nlohmann::ordered_json(nullptr);
  }
  for (const auto& [name, digest] : lines.planes) json["planes"][name] = ToHex(*digest);
  return json.dump(2) + "\n";
}

}  // namespace

void RunHash(const HashOptions& options) {
  MemoryBudget budget(options.load.memory_limit);  // for work other than loading and rendering
  const MemoryBudget::Scope scope(budget);
  Lines lines;
  RunWithThreads(options.request.settings.threads, [&] { lines = Digests(options); });
  PrintOutput(options.json ? Json(lines) : Text(lines));
}

}  // namespace facet::cli
