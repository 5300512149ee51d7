// The report as a self-contained HTML file, which can be read without network access and without JavaScript.
#include <string>
#include <string_view>

#include "base/base64.h"
#include "base/markup.h"
#include "base/number_text.h"
#include "facet/check.h"
#include "facet/version.h"

namespace facet {
namespace {

constexpr std::string_view kStyle = R"(
:root { color-scheme: light dark; --line: #d0d4da; --soft: #f3f4f6; --good: #1a7f37; --bad: #c21f2c; --odd: #9a6700; }
@media (prefers-color-scheme: dark) {
  :root { --line: #3a4048; --soft: #22262c; --good: #4ac26b; --bad: #ff7b72; --odd: #d9a514; }
}
body { font: 15px/1.45 system-ui, sans-serif; margin: 2em auto; padding: 0 1.5em; max-width: 110em; }
h1 { font-size: 1.5em; } h2 { font-size: 1.15em; margin: 0; }
code { font-size: .85em; overflow-wrap: anywhere; }
table { border-collapse: collapse; width: 100%; margin: 1em 0; }
th, td { text-align: left; vertical-align: top; padding: .35em .8em .35em 0; border-bottom: 1px solid var(--line); }
td.number { text-align: right; font-variant-numeric: tabular-nums; }
.numbers { width: auto; } .numbers td { padding-right: 1.6em; }
b.passed { color: var(--good); } b.failed, b.error { color: var(--bad); } b.within, b.updated { color: var(--odd); }
#only-open:checked ~ table tr.passed { display: none; }
section { border-top: 2px solid var(--line); padding: 1.2em 0; }
.pictures { display: flex; flex-wrap: wrap; gap: 1em; }
figure { margin: 0; } figcaption { margin-bottom: .3em; }
.pictures > * { flex: 0 1 auto; min-width: 0; max-width: 100%; }
img { display: block; max-width: 100%; min-width: min(12em, 100%); image-rendering: pixelated;
  background: repeating-conic-gradient(#bbb 0 25%, #fff 0 50%) 0 0 / 16px 16px; }
.blink .stage { position: relative; cursor: pointer; width: max-content; max-width: 100%; }
.blink .stage img + img { position: absolute; inset: 0; width: 100%; height: 100%; clip-path: inset(0 0 0 var(--cut)); }
.blink input { width: 100%; }
)";

// Adds a fourth figure, which shows the actual image over the expected one. The slider moves the boundary between them,
// a click or the "change" button switches between them, and "blink" switches repeatedly.
constexpr std::string_view kScript = R"(
for (const pictures of document.querySelectorAll('.pictures')) {
  const expected = pictures.querySelector('.expected img'), actual = pictures.querySelector('.actual img');
  if (!expected || !actual) continue;
  const figure = document.createElement('figure');
  figure.className = 'blink';
  figure.innerHTML = '<figcaption><span></span> <button>change</button> <button>blink</button></figcaption>' +
    '<div class="stage"></div>' +
    '<input type="range" min="0" max="100" aria-label="expected to the left, actual to the right">';
  const stage = figure.querySelector('.stage'), slider = figure.querySelector('input');
  const [change, blink] = figure.querySelectorAll('button');
  stage.append(expected.cloneNode(), actual.cloneNode());
  const show = cut => {
    slider.value = cut;
    stage.style.setProperty('--cut', cut + '%');
    figure.querySelector('span').textContent = cut >= 100 ? 'expected' : cut <= 0 ? 'actual' : 'expected | actual';
  };
  const turn = () => show(slider.value >= 100 ? 0 : 100);
  let timer = 0;
  slider.oninput = () => show(Number(slider.value));
  stage.onclick = change.onclick = turn;
  blink.onclick = () => { timer = timer ? clearInterval(timer) : setInterval(turn, 500); };
  show(50);
  pictures.append(figure);
}
)";

std::string Figure(const char* kind, const char* caption, const std::vector<std::byte>& png) {
  if (png.empty()) return {};
  return std::string("<figure class=\"") + kind + "\"><figcaption>" + caption + "</figcaption><img alt=\"" + caption +
         "\" src=\"data:image/png;base64," + Base64(png) + "\"></figure>\n";
}

std::string Word(Verdict verdict) {
  const std::string name = NameOf(verdict);
  return "<b class=\"" + name + "\">" + name + "</b>";
}

std::string Numbers(const ImageDifference& d) {
  std::string html = "<table class=\"numbers\">\n";
  const auto row = [&html](const char* what, const std::string& value) {
    html += std::string("<tr><td>") + what + "</td><td class=\"number\">" + value + "</td></tr>\n";
  };
  row("FLIP, mean", ShortNumber(d.flip_mean));
  row("FLIP, largest", ShortNumber(d.flip_max));
  row("RMSE", ShortNumber(d.rmse));
  row("PSNR", ShortNumber(d.psnr_db) + " dB");
  row("SSIM", ShortNumber(d.ssim));
  row("largest difference",
      ShortNumber(d.max_difference) + " at (" + std::to_string(d.max_x) + ", " + std::to_string(d.max_y) + ")");
  row("differing pixels",
      std::to_string(d.differing_pixels) + " of " + std::to_string(std::size_t(d.width) * std::size_t(d.height)));
  return html + "</table>\n";
}

std::string Films(const CheckedEntry& entry) {
  std::string html;
  if (entry.expected_film) html += "expected <code>" + ToHex(*entry.expected_film) + "</code><br>";
  if (entry.film) html += "actual <code>" + ToHex(*entry.film) + "</code>";
  return html.empty() ? html : "<p>Film: " + html + "</p>\n";
}

std::string Warning(const std::string& text) { return "Warning: " + Escaped(text); }

std::string Row(const CheckedEntry& entry, std::size_t index, bool has_section) {
  const std::string name = Escaped(entry.name);
  std::string what = Escaped(entry.message);
  if (entry.verdict == Verdict::Passed && entry.film) {
    what += (what.empty() ? "" : "; ") + std::string("film <code>") + ToHex(*entry.film) + "</code>";
  }
  if (entry.verdict == Verdict::Error) what += "<br><code>" + Escaped(entry.place) + "</code>";
  if (!has_section) {
    for (const std::string& warning : entry.warnings) what += (what.empty() ? "" : "<br>") + Warning(warning);
  }
  return "<tr class=\"" + std::string(NameOf(entry.verdict)) + "\"><td>" +
         (has_section ? "<a href=\"#entry-" + std::to_string(index) + "\">" + name + "</a>" : name) + "</td><td>" +
         Word(entry.verdict) + "</td><td class=\"number\">" + SecondsText(entry.seconds) + "&nbsp;s</td><td>" + what +
         "</td></tr>\n";
}

std::string Section(const CheckedEntry& entry, std::size_t index) {
  std::string html = "<section id=\"entry-" + std::to_string(index) + "\">\n<h2>" + Escaped(entry.name) + " " +
                     Word(entry.verdict) + "</h2>\n<p>" + Escaped(entry.message) + "<br><code>" + Escaped(entry.place) +
                     "</code></p>\n";
  const std::string pictures = Figure("expected", "expected", entry.expected) +
                               Figure("actual", "actual", entry.actual) +
                               Figure("difference", "difference (FLIP)", entry.heat_map);
  if (!pictures.empty()) html += "<div class=\"pictures\">\n" + pictures + "</div>\n";
  if (entry.difference) html += Numbers(*entry.difference);
  html += Films(entry);
  for (const std::string& warning : entry.warnings) html += "<p>" + Warning(warning) + "</p>\n";
  return html + "</section>\n";
}

}  // namespace

std::string CheckHtml(const CheckReport& report) {
  std::string summary;
  for (const Verdict verdict : {Verdict::Passed, Verdict::Within, Verdict::Updated, Verdict::Failed, Verdict::Error}) {
    const std::size_t count = report.Count(verdict);
    if (count > 0) summary += (summary.empty() ? "" : ", ") + std::to_string(count) + " " + Word(verdict);
  }
  std::string html =
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width\">\n<title>" +
      Escaped(report.manifest) + "</title>\n<style>" + std::string(kStyle) + "</style>\n</head>\n<body>\n" + "<h1>" +
      Escaped(report.manifest) + "</h1>\n<p>" + (summary.empty() ? "no entries" : summary) + "; " +
      SecondsText(report.seconds) + " s; facet " + Version() + "</p>\n";
  for (const std::string& problem : report.problems)
    html += "<p>" + Word(Verdict::Error) + " " + Escaped(problem) + "</p>\n";
  html +=
      "<input type=\"radio\" name=\"filter\" id=\"all\" checked><label for=\"all\">all</label>\n"
      "<input type=\"radio\" name=\"filter\" id=\"only-open\"><label for=\"only-open\">all but passed</label>\n"
      "<table>\n<thead><tr><th>entry</th><th>verdict</th><th>time</th><th></th></tr></thead>\n<tbody>\n";
  std::string sections;
  for (std::size_t i = 0; i < report.entries.size(); ++i) {
    const CheckedEntry& entry = report.entries[i];
    const bool has_section = entry.verdict != Verdict::Passed && entry.verdict != Verdict::Error;
    html += Row(entry, i, has_section);
    if (has_section) sections += Section(entry, i);
  }
  return html + "</tbody>\n</table>\n" + sections + "<script>" + std::string(kScript) + "</script>\n</body>\n</html>\n";
}

}  // namespace facet
