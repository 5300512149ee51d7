#include "cli/check_command.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "base/markup.h"
#include "base/output_file.h"
#include "cli/console.h"
#include "facet/error.h"
#include "facet/version.h"

namespace facet::cli {
namespace {

constexpr int kPassed = 0, kDiffers = 1, kFailed = 2;

constexpr Verdict kVerdicts[] = {Verdict::Passed, Verdict::Within, Verdict::Updated, Verdict::Failed, Verdict::Error};

// The number of characters in UTF-8 text.
std::size_t Length(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }));
}

std::string Padded(std::string text, std::size_t length) {
  const std::size_t now = Length(text);
  if (now < length) text.append(length - now, ' ');
  return text;
}

std::string Table(const CheckReport& report) {
  std::size_t longest = 0;
  for (const CheckedEntry& entry : report.entries) longest = std::max(longest, Length(entry.name));
  std::string text;
  for (const CheckedEntry& entry : report.entries) {
    text += Padded(entry.name, std::min<std::size_t>(longest, 48)) + "  " + Padded(NameOf(entry.verdict), 7) + "  " +
            SecondsText(entry.seconds) + " s" + (entry.message.empty() ? "" : "  " + entry.message) + "\n";
  }
  text += std::to_string(report.entries.size()) + (report.entries.size() == 1 ? " entry" : " entries");
  const char* separator = ": ";
  for (const Verdict verdict : kVerdicts) {
    if (report.Count(verdict) == 0) continue;
    text += std::exchange(separator, ", ") + std::to_string(report.Count(verdict)) + " " + NameOf(verdict);
  }
  return text + "; " + SecondsText(report.seconds) + " s\n";
}

// Infinite numbers become null.
std::string Json(const CheckReport& report) {
  using Ordered = nlohmann::ordered_json;
  Ordered json = {{"facet", Version()}, {"manifest", report.manifest}, {"seconds", report.seconds}};
  for (const Verdict verdict : kVerdicts) json["counts"][NameOf(verdict)] = report.Count(verdict);
  json["problems"] = report.problems;
  json["entries"] = Ordered::array();
  for (const CheckedEntry& entry : report.entries) {
    Ordered e = {{"name", entry.name},
                 {"place", entry.place},
                 {"verdict", NameOf(entry.verdict)},
                 {"seconds", entry.seconds},
                 {"message", entry.message},
                 {"film", entry.film ? Ordered(ToHex(*entry.film)) : Ordered()},
                 {"expected_film", entry.expected_film ? Ordered(ToHex(*entry.expected_film)) : Ordered()},
                 {"difference", nullptr},
                 {"warnings", entry.warnings}};
    if (const std::optional<ImageDifference>& d = entry.difference) {
      e["difference"] = {{"equal", d->equal},         {"max_difference", d->max_difference},
                         {"max_x", d->max_x},         {"max_y", d->max_y},
                         {"rmse", d->rmse},           {"differing_pixels", d->differing_pixels},
                         {"psnr_db", d->psnr_db},     {"ssim", d->ssim},
                         {"flip_mean", d->flip_mean}, {"flip_max", d->flip_max}};
    }
    json["entries"].push_back(std::move(e));
  }
  return json.dump(2, ' ', false, Ordered::error_handler_t::replace) + "\n";
}

// Maps the path of each picture file to write to its PNG bytes.
std::map<std::filesystem::path, const std::vector<std::byte>*> PicturesOf(const CheckReport& report,
                                                                          const std::filesystem::path& folder) {
  std::map<std::filesystem::path, const std::vector<std::byte>*> pictures;
  for (const CheckedEntry& entry : report.entries) {
    if (entry.verdict != Verdict::Failed) continue;
    if (!entry.actual.empty()) pictures[folder / (entry.name + ".actual.png")] = &entry.actual;
    if (!entry.heat_map.empty()) pictures[folder / (entry.name + ".difference.png")] = &entry.heat_map;
  }
  return pictures;
}

}  // namespace

int RunCheck(const CheckCommandOptions& options) {
  if (options.output) {
    std::error_code failure;
    std::filesystem::create_directories(*options.output, failure);
    if (failure) throw Error(ErrorCode::OutputFailed, failure.message(), options.output->string());
  }
  std::vector<std::filesystem::path> outputs;
  for (const auto& report : {options.html, options.junit}) {
    if (report) outputs.push_back(*report);
  }
  for (const std::filesystem::path& output : outputs) CheckWritable(output);
  RefuseOverwriting(outputs, {options.manifest});
  CheckOptions check = options.check;
  check.pictures = options.html || options.output;
  const CheckReport report = CheckManifest(options.manifest, check);
  PrintOutput(options.json ? Json(report) : Table(report));
  for (const std::string& problem : report.problems) PrintError(problem);
  for (const CheckedEntry& entry : report.entries) {
    for (const std::string& warning : entry.warnings) PrintWarning(entry.name + ": " + warning);
    if (entry.verdict == Verdict::Error) PrintError(entry.place + ": " + entry.message);
  }
  std::map<std::filesystem::path, const std::vector<std::byte>*> pictures;
  if (options.output) pictures = PicturesOf(report, *options.output);
  for (const auto& [path, png] : pictures) outputs.push_back(path);
  std::vector<std::filesystem::path> inputs = {options.manifest};
  for (const CheckedEntry& entry : report.entries) inputs.insert(inputs.end(), entry.files.begin(), entry.files.end());
  RefuseOverwriting(outputs, inputs);
  // If one output cannot be written, the others are still written, and the first error is thrown at the end.
  std::optional<Error> failure;
  const auto try_to = [&](const auto& write) {
    try {
      write();
    } catch (const Error& error) {
      if (!failure) failure = error;
    }
  };
  for (const auto& [path, png] : pictures) {
    try_to([&, &to = path, &bytes = *png] { WriteFile(to, bytes, OutputFile::Links::Refuse); });
  }
  if (options.html) try_to([&] { WriteFile(*options.html, CheckHtml(report)); });
  if (options.junit) try_to([&] { WriteFile(*options.junit, JUnitXml(report)); });
  if (failure) throw Error(*failure);
  if (!report.problems.empty() || report.Count(Verdict::Error) > 0) return kFailed;
  return report.Count(Verdict::Failed) > 0 ? kDiffers : kPassed;
}

}  // namespace facet::cli
