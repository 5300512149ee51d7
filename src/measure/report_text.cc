// The report as JSON, which can be read back, and as CSV for spreadsheets and plots.
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "base/json_bounds.h"
#include "base/memory_budget.h"
#include "base/printable.h"
#include "facet/error.h"
#include "facet/report.h"
#include "gltf/recognize.h"

namespace facet {
namespace {

using Json = nlohmann::ordered_json;

Json ErrorAsJson(const FilmError& error) {
  return {{"rmse", error.rmse},
          {"relative_rmse", error.relative_rmse},
          {"largest", error.largest},
          {"flip", error.flip},
          {"standard_error", error.standard_error}};
}

// A value of the file and its JSON pointer.
struct Value {
  const Json& json;
  Json::json_pointer pointer;
  const std::string& file;

  [[noreturn]] void Fail(const std::string& message) const {
    throw Error(ErrorCode::InvalidInput, message, pointer.empty() ? file : file + ": " + Printable(pointer.to_string()),
                "give a file that 'facet report' wrote as JSON");
  }
  void Expect(bool good, const char* what) const {
    if (!good) Fail(std::string("is no ") + what);
  }
  bool Has(const char* key) const { return json.contains(key); }
  Value operator[](const char* key) const {
    Expect(json.is_object(), "object");
    if (!json.contains(key)) Fail("has no " + Quoted(key));
    return {json.at(key), pointer / key, file};
  }

  void Read(std::string& to) const {
    Expect(json.is_string(), "string");
    to = json.get<std::string>();
  }
  void Read(bool& to) const {
    Expect(json.is_boolean(), "true or false");
    to = json.get<bool>();
  }
  // Reads an error or a time, which is never negative. null stands for values that are not finite.
  void Read(double& to) const {
    Expect(json.is_number() || json.is_null(), "number");
    to = json.is_null() ? std::numeric_limits<double>::quiet_NaN() : json.get<double>();
    Expect(!(to < 0.0), "number from 0");
  }
  void Read(std::size_t& to) const {
    Expect(json.is_number_unsigned(), "whole number from 0");
    to = json.get<std::size_t>();
  }
  void Read(int& to) const {
    std::size_t whole = 0;
    Read(whole);
    Expect(whole <= std::size_t(std::numeric_limits<int>::max()), "whole number from 0 to 2147483647");
    to = int(whole);
  }
  void Read(FilmError& to) const {
    (*this)["rmse"].Read(to.rmse);
    (*this)["relative_rmse"].Read(to.relative_rmse);
    (*this)["largest"].Read(to.largest);
    (*this)["flip"].Read(to.flip);
    if (Has("standard_error")) (*this)["standard_error"].Read(to.standard_error);
  }
  void Read(SettingsText& to) const {
    Expect(json.is_object(), "object");
    for (const auto& [key, value] : json.items()) Value{value, pointer / key, file}.Read(to[key]);
  }
  void Read(ReportPoint& to) const {
    (*this)["changed"].Read(to.changed);
    (*this)["runs"].Read(to.runs);
    (*this)["seconds"].Read(to.seconds);
    (*this)["seconds_low"].Read(to.seconds_low);
    (*this)["seconds_high"].Read(to.seconds_high);
    (*this)["peak_bytes"].Read(to.peak_bytes);
    (*this)["error"].Read(to.error);
    (*this)["pareto"].Read(to.pareto);
  }
  void Read(ApproximationCost& to) const {
    (*this)["option"].Read(to.option);
    (*this)["used"].Read(to.used);
    (*this)["cheapest"].Read(to.cheapest);
    (*this)["most_exact"].Read(to.most_exact);
    (*this)["error_used"].Read(to.error_used);
    (*this)["error_cheapest"].Read(to.error_cheapest);
    (*this)["error_most_exact"].Read(to.error_most_exact);
    (*this)["seconds_used"].Read(to.seconds_used);
    (*this)["seconds_cheapest"].Read(to.seconds_cheapest);
    (*this)["seconds_most_exact"].Read(to.seconds_most_exact);
    (*this)["change"].Read(to.change);
  }
  template <class T>
  void Read(std::vector<T>& to) const {
    Expect(json.is_array(), "array");
    to.resize(json.size());
    for (std::size_t i = 0; i < to.size(); ++i) Value{json[i], pointer / i, file}.Read(to[i]);
  }
};

// RFC 4180, section 2: fields with a comma, a quote or a line break are quoted, and quotes in them are doubled.
std::string CsvField(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

// The shortest text that reads back as the same number; empty if it is not finite.
std::string CsvNumber(double value) {
  if (!std::isfinite(value)) return {};
  std::array<char, 32> text;
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

}  // namespace

std::string ToJson(const ErrorReport& report) {
  const ErrorReport::Reference& reference = report.reference;
  Json json = {{"facet", report.version},
               {"scene", report.scene},
               {"target", report.target},
               {"threads", report.threads},
               {"width", report.width},
               {"height", report.height},
               {"settings", report.settings},
               {"seconds", report.seconds},
               {"complete", report.complete},
               {"planned_points", report.planned_points},
               {"reference",
                {{"samples", reference.samples},
                 {"batches", reference.batches},
                 {"pixels", reference.pixels},
                 {"seconds", reference.seconds},
                 {"rms_error", reference.rms_error},
                 {"relative_error", reference.relative_error},
                 {"notes", reference.notes}}},
               {"rounding", report.rounding ? ErrorAsJson(*report.rounding) : Json()},
               {"points", Json::array()},
               {"costs", Json::array()}};
  for (const ReportPoint& point : report.points) {
    json["points"].push_back({{"changed", point.changed},
                              {"runs", point.runs},
                              {"seconds", point.seconds},
                              {"seconds_low", point.seconds_low},
                              {"seconds_high", point.seconds_high},
                              {"peak_bytes", point.peak_bytes},
                              {"error", ErrorAsJson(point.error)},
                              {"pareto", point.pareto}});
  }
  for (const ApproximationCost& cost : report.costs) {
    json["costs"].push_back({{"option", cost.option},
                             {"used", cost.used},
                             {"cheapest", cost.cheapest},
                             {"most_exact", cost.most_exact},
                             {"error_used", cost.error_used},
                             {"error_cheapest", cost.error_cheapest},
                             {"error_most_exact", cost.error_most_exact},
                             {"seconds_used", cost.seconds_used},
                             {"seconds_cheapest", cost.seconds_cheapest},
                             {"seconds_most_exact", cost.seconds_most_exact},
                             {"change", cost.change}});
  }
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

ErrorReport ReportFromJson(const std::string& json, const std::string& name) {
  const std::string file = Printable(name);
  gltf::RefuseForeignJson(json, file);
  if (IsJsonDeeperThan(json, kMaxJsonDepth)) {
    throw Error(ErrorCode::InvalidInput, "JSON is nested deeper than " + std::to_string(kMaxJsonDepth) + " levels",
                file);
  }
  const MemoryLease lease(JsonMemory(json), 2, "JSON", file);
  Json parsed;
  try {
    parsed = Json::parse(json);
  } catch (const Json::exception& error) {
    throw Error(ErrorCode::InvalidInput, Printable(error.what()), file);
  }
  const Value root{parsed, Json::json_pointer(), file};
  ErrorReport report;
  root["facet"].Read(report.version);
  root["scene"].Read(report.scene);
  root["target"].Read(report.target);
  root["threads"].Read(report.threads);
  root["width"].Read(report.width);
  root["height"].Read(report.height);
  root["settings"].Read(report.settings);
  root["seconds"].Read(report.seconds);
  root["complete"].Read(report.complete);
  root["planned_points"].Read(report.planned_points);
  const Value reference = root["reference"];
  reference["samples"].Read(report.reference.samples);
  reference["batches"].Read(report.reference.batches);
  // Older reports have no such key; their references always cover the whole image.
  report.reference.pixels = std::size_t(report.width) * std::size_t(report.height);
  if (reference.Has("pixels")) reference["pixels"].Read(report.reference.pixels);
  reference["seconds"].Read(report.reference.seconds);
  reference["rms_error"].Read(report.reference.rms_error);
  reference["relative_error"].Read(report.reference.relative_error);
  reference["notes"].Read(report.reference.notes);
  if (const Value rounding = root["rounding"]; !rounding.json.is_null()) rounding.Read(report.rounding.emplace());
  root["points"].Read(report.points);
  root["costs"].Read(report.costs);
  return report;
}

std::string ToCsv(const ErrorReport& report) {
  std::set<std::string> varied;
  for (const ReportPoint& point : report.points) {
    for (const auto& [option, value] : point.changed) varied.insert(option);
  }
  std::string csv;
  for (const std::string& option : varied) csv += CsvField(option) + ",";
  csv += "runs,seconds,seconds_low,seconds_high,peak_bytes,rmse,relative_rmse,largest,flip,standard_error,pareto\r\n";
  for (const ReportPoint& point : report.points) {
    for (const std::string& option : varied) {
      const auto changed = point.changed.find(option), asked = report.settings.find(option);
      if (changed != point.changed.end()) {
        csv += CsvField(changed->second);
      } else if (asked != report.settings.end()) {
        csv += CsvField(asked->second);
      }
      csv += ",";
    }
    csv += std::to_string(point.runs) + ",";
    for (const double seconds : {point.seconds, point.seconds_low, point.seconds_high}) csv += CsvNumber(seconds) + ",";
    csv += std::to_string(point.peak_bytes) + ",";
    const FilmError& e = point.error;
    for (const double error : {e.rmse, e.relative_rmse, e.largest, e.flip, e.standard_error})
      csv += CsvNumber(error) + ",";
    csv += point.pareto ? "yes\r\n" : "no\r\n";
  }
  return csv;
}

}  // namespace facet
