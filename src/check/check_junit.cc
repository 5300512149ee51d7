// The report for continuous integration: the JUnit XML that Jenkins, GitLab and GitHub's actions read.
#include <filesystem>
#include <string>

#include "base/markup.h"
#include "facet/check.h"

namespace facet {
namespace {

std::string Attribute(const char* name, const std::string& value) {
  return std::string(" ") + name + "=\"" + Escaped(value) + "\"";
}

// A failure or an error. The message is both an attribute and the content, since readers show either of them.
std::string Complaint(const char* element, const char* type, const std::string& message, const std::string& place) {
  return std::string("      <") + element + Attribute("type", type) + Attribute("message", message) + ">" +
         Escaped(place + ": " + message) + "</" + element + ">\n";
}

std::string Counts(const CheckReport& report) {
  return Attribute("tests", std::to_string(report.entries.size() + report.problems.size())) +
         Attribute("failures", std::to_string(report.Count(Verdict::Failed))) +
         Attribute("errors", std::to_string(report.Count(Verdict::Error) + report.problems.size())) +
         Attribute("time", SecondsText(report.seconds));
}

std::string Hashes(const CheckedEntry& entry) {
  std::string text;
  if (entry.film) text += " (film " + ToHex(*entry.film);
  if (entry.film && entry.expected_film) text += ", expected " + ToHex(*entry.expected_film);
  return text.empty() ? text : text + ")";
}

// Warnings of the loader and the renderer, such as a missing texture. Readers show them as the test's output.
std::string Warnings(const CheckedEntry& entry) {
  std::string lines;
  for (const std::string& warning : entry.warnings) lines += "warning: " + Escaped(warning) + "\n";
  return lines.empty() ? lines : "      <system-out>" + lines + "      </system-out>\n";
}

}  // namespace

std::string JUnitXml(const CheckReport& report) {
  const std::string counts = Counts(report);
  std::string xml = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites" + Attribute("name", "facet check") +
                    counts + ">\n  <testsuite" + Attribute("name", report.manifest) + counts +
                    Attribute("skipped", "0") + ">\n";
  const std::string suite = Attribute("classname", std::filesystem::path(report.manifest).stem().string());
  for (const std::string& problem : report.problems) {
    xml += "    <testcase" + suite + Attribute("name", "the manifest") + Attribute("time", "0.00") + ">\n" +
           "      <error" + Attribute("type", "error") + Attribute("message", problem) + ">" + Escaped(problem) +
           "</error>\n    </testcase>\n";
  }
  for (const CheckedEntry& entry : report.entries) {
    xml += "    <testcase" + suite + Attribute("name", entry.name) + Attribute("time", SecondsText(entry.seconds));
    std::string content;
    if (entry.verdict == Verdict::Failed) {
      content = Complaint("failure", "differs", entry.message + Hashes(entry), entry.place);
    } else if (entry.verdict == Verdict::Error) {
      content = Complaint("error", "error", entry.message, entry.place);
    }
    content += Warnings(entry);
    xml += content.empty() ? "/>\n" : ">\n" + content + "    </testcase>\n";
  }
  return xml + "  </testsuite>\n</testsuites>\n";
}

}  // namespace facet
