#include "settings/provenance.h"

#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>

#include "base/json_bounds.h"
#include "base/printable.h"
#include "facet/error.h"
#include "facet/version.h"
#include "image/codec.h"

namespace facet {
namespace {

constexpr std::string_view kProgram = "facet ";

using Settings = std::map<std::string, std::string>;

std::optional<Settings> ParseSettings(const std::string& text) {
  if (IsJsonDeeperThan(text, 1)) return std::nullopt;
  const nlohmann::json json = nlohmann::json::parse(text, nullptr, false);
  if (!json.is_object()) return std::nullopt;
  Settings settings;
  for (const auto& [name, value] : json.items()) {
    if (!value.is_string()) return std::nullopt;
    settings[name] = value.get<std::string>();
  }
  return settings;
}

}  // namespace

std::vector<std::array<std::string, 2>> ToImageText(const Provenance& p) {
  return {{"Software", std::string(kProgram) + p.version},
          {"facet:scene", p.scene},
          {"facet:settings", nlohmann::json(p.settings).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace)},
          {"facet:film", ToHex(p.film)},
          {"facet:pixels", ToHex(p.pixels)}};
}

Provenance ReadProvenance(std::span<const std::byte> picture, const std::string& name) {
  const std::map<std::string, std::string> text = ReadImageText(picture, name);
  const auto value = [&](const char* key) -> const std::string& {
    const auto found = text.find(key);
    if (found != text.end()) return found->second;
    throw Error(ErrorCode::InvalidInput, std::string("says nothing of ") + key, name,
                "only a PNG or EXR that facet wrote, and no other program has rewritten, can be verified");
  };
  const auto bad = [&](const char* key) {
    return Error(ErrorCode::InvalidInput, std::string("has no valid ") + key, name, "the file was changed");
  };
  const auto digest = [&](const char* key) {
    if (const std::optional<Digest> parsed = ParseDigest(value(key))) return *parsed;
    throw bad(key);
  };
  Provenance p;
  p.scene = value("facet:scene");
  const std::optional<Settings> settings = ParseSettings(value("facet:settings"));
  if (!settings) throw bad("facet:settings");
  p.settings = *settings;
  p.film = digest("facet:film");
  p.pixels = digest("facet:pixels");
  const std::string& software = value("Software");
  if (!software.starts_with(kProgram)) throw bad("Software");
  p.version = software.substr(kProgram.size());
  return p;
}

}  // namespace facet
