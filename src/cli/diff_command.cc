#include "cli/diff_command.h"

#include <new>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "base/number_text.h"
#include "base/output_file.h"
#include "base/printable.h"
#include "cli/console.h"
#include "facet/error.h"
#include "facet/film.h"
#include "facet/load.h"
#include "facet/version.h"
#include "image/formats.h"

namespace facet::cli {
namespace {

constexpr int kWithin = 0, kDifferent = 1;

ImageDifference Compare(const DiffOptions& options) {
  const Image a = LoadImage(options.a, options.compare.memory_limit);
  const Image b = LoadImage(options.b, options.compare.memory_limit);
  for (const auto& [path, image] : {std::pair(options.a, &a), std::pair(options.b, &b)}) {
    if (!image->damage.empty()) PrintWarning(path.string() + ": " + image->damage);
  }
  try {
    return CompareImages(a, b, options.compare);
  } catch (const Error& error) {  // it does not name the file yet
    throw Error(error.code(), error.message(), options.b.string(), error.hint());
  }
}

std::string Count(std::size_t count, const char* noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

std::string Table(const DiffOptions& options, const ImageDifference& d, const std::vector<std::string>& broken) {
  const auto row = [](std::string label, const std::string& value) {
    label.resize(20, ' ');
    return "  " + label + value + "\n";
  };
  const std::size_t pixels = d.flip_map.PixelCount();
  std::string text = Printable(options.a.string()) + " and " + Printable(options.b.string()) + ": " +
                     std::to_string(d.width) + "x" + std::to_string(d.height) + ", " +
                     (d.equal          ? "equal"
                      : broken.empty() ? "within the thresholds"
                                       : "different") +
                     (d.linear ? ", linear light" : "") + "\n";
  if (!d.equal) {
    text += row("largest difference",
                ShortNumber(d.max_difference) + " at " + std::to_string(d.max_x) + "," + std::to_string(d.max_y));
  }
  text += row("differing pixels", std::to_string(d.differing_pixels) + " of " + std::to_string(pixels));
  text += row("RMSE", ShortNumber(d.rmse));
  text += row("PSNR", ShortNumber(d.psnr_db) + " dB");
  text += row("SSIM", ShortNumber(d.ssim));
  text += row(d.linear ? "HDR-FLIP" : "FLIP", ShortNumber(d.flip_mean) + ", largest " + ShortNumber(d.flip_max));
  if (d.non_finite_pixels_a + d.non_finite_pixels_b > 0) {
    text += row("not finite", Count(d.non_finite_pixels_a, "pixel") + " and " + Count(d.non_finite_pixels_b, "pixel"));
  }
  for (const std::string& line : broken) {
    if (!d.equal) text += row("verdict", line);
  }
  return text;
}

// Infinite numbers become null.
std::string Json(const DiffOptions& options, const ImageDifference& d, const std::vector<std::string>& broken) {
  using Ordered = nlohmann::ordered_json;
  Ordered json = {
      {"facet", Version()},
      {"a", options.a.string()},
      {"b", options.b.string()},
      {"width", d.width},
      {"height", d.height},
      {"compared", d.linear ? "linear light" : "encoded"},
      {"equal", d.equal},
      {"within", broken.empty()},
      {"beyond", broken},
      {"max_difference", d.max_difference},
      {"max_difference_at", d.equal ? Ordered() : Ordered{d.max_x, d.max_y}},
      {"differing_pixels", d.differing_pixels},
      {"non_finite_pixels", {d.non_finite_pixels_a, d.non_finite_pixels_b}},
      {"rmse", d.rmse},
      {"psnr_db", d.psnr_db},
      {"ssim", d.ssim},
      {"flip",
       {{"kind", d.linear ? "HDR" : "LDR"},
        {"mean", d.flip_mean},
        {"max", d.flip_max},
        {"pixels_per_degree", options.compare.pixels_per_degree}}},
  };
  // File names need not be UTF-8; JSON must be.
  return json.dump(2, ' ', false, Ordered::error_handler_t::replace) + "\n";
}

}  // namespace

int RunDiff(const DiffOptions& options) {
  if (options.output) {
    if (FormatToWrite(*options.output).IsLinear()) {
      throw Error(ErrorCode::InvalidUsage, "a heat map is for displays, not linear light", "-o", "write .png");
    }
    CheckWritable(*options.output);
    RefuseOverwriting({*options.output}, {options.a, options.b});
  }
  const ImageDifference difference = Compare(options);
  const std::vector<std::string> broken = BrokenThresholds(difference, options.thresholds);
  if (options.output) {
    WriteImage(*options.output, HeatMap(difference), {{"Software", std::string("facet ") + Version()}});
  }
  PrintOutput(options.json ? Json(options, difference, broken) : Table(options, difference, broken));
  return broken.empty() ? kWithin : kDifferent;
}

}  // namespace facet::cli
