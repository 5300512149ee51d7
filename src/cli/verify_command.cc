#include "cli/verify_command.h"

#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>

#include "base/printable.h"
#include "cli/console.h"
#include "facet/verify.h"
#include "facet/version.h"

namespace facet::cli {
namespace {

std::string Text(const Verification& v) {
  if (v.Equal()) return "equal: film " + ToHex(v.film_now) + "\n";
  std::string text;
  if (!v.intact) text += "changed: the file's pixels are not those that facet wrote\n";
  if (!v.film_equal) {
    text += "different: the scene gives another film\n  then " + ToHex(v.film_before) + "\n  now  " +
            ToHex(v.film_now) + "\n";
    if (v.written_by != Version()) {
      text += "  it was written by facet " + Printable(v.written_by) + "; this is " + Version() + "\n";
    }
  }
  if (v.differing_pixels == 0) return text + "the encoded pixels are equal\n";
  char largest[32];
  std::snprintf(largest, sizeof largest, "%.6g", v.max_difference);
  return text + std::to_string(v.differing_pixels) + " of " + std::to_string(v.pixels) +
         " pixels differ, within columns " + std::to_string(v.left) + " to " + std::to_string(v.right) + " and rows " +
         std::to_string(v.top) + " to " + std::to_string(v.bottom) + "; the most by " + largest + " at (" +
         std::to_string(v.max_x) + ", " + std::to_string(v.max_y) + ")\n";
}

std::string Json(const Verification& v) {
  nlohmann::ordered_json json;
  json["facet"] = Version();
  json["equal"] = v.Equal();
  json["written_by"] = v.written_by;
  json["scene"] = v.scene;
  json["intact"] = v.intact;
  json["film"] = {{"equal", v.film_equal}, {"before", ToHex(v.film_before)}, {"now", ToHex(v.film_now)}};
  json["pixels"] = {{"count", v.pixels}, {"differing", v.differing_pixels}};
  if (v.differing_pixels > 0) {
    json["pixels"]["rectangle"] = {{"left", v.left}, {"top", v.top}, {"right", v.right}, {"bottom", v.bottom}};
    json["pixels"]["largest"] = {{"difference", v.max_difference}, {"x", v.max_x}, {"y", v.max_y}};
  }
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace

int RunVerify(const VerifyOptions& options) {
  const VerifySettings settings{options.environment, options.materials, options.threads, options.load};
  const Verification verification = VerifyPicture(options.picture, options.input, settings);
  PrintWarnings(verification.warnings, options.strict, options.input.string());
  PrintOutput(options.json ? Json(verification) : Text(verification));
  return verification.Equal() ? 0 : 1;
}

}  // namespace facet::cli
