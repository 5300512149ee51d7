// Reports that are read back.
#include "facet/report.h"
#include "fuzz/fuzz.h"

namespace facet::fuzz {

void Run(std::span<const std::byte> input) {
  ErrorReport report;
  const std::string text(AsText(input));
  if (Try([&] { report = ReportFromJson(text, "report.json"); }) != Outcome::Done) return;
  const std::string json = ToJson(report);
  std::string again;
  const Outcome read = Try([&] { again = ToJson(ReportFromJson(json, "report.json")); });
  Check(read == Outcome::Done, "a report that was written is not read");
  Check(again == json, "a report that was written is read as another");
  ToCsv(report);
  Try([&] { ToHtml(report); });
  for (const Bound& bound : {Bound{0.01, {}}, Bound{{}, 0.1}, Bound{0.01, 0.1}}) {
    Try([&] {
      const Choice choice = ChoosePoint(report, bound);
      Check(choice.point < report.points.size(), "a point was chosen that is not there");
    });
  }
}

}  // namespace facet::fuzz
