#include "cli/progress.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <string>

namespace facet::cli {
namespace {

constexpr auto kPatience = std::chrono::milliseconds(500);
constexpr auto kBetweenDraws = std::chrono::milliseconds(50);

int TerminalColumns() {
  winsize size{};
  return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

void Write(const std::string& text) {
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

}  // namespace

Progress::Progress(Style style) : style_(style), next_draw_(start_ + kPatience) {}

Progress::~Progress() {
  if (drawn_) Write("\r\033[K");
}

Progress::Style Progress::StyleFor(bool quiet, const bool* wanted) {
  if (quiet || (wanted != nullptr && !*wanted)) return Style::None;
  if (isatty(STDERR_FILENO) == 1) return Style::Bar;
  return wanted != nullptr ? Style::Lines : Style::None;
}

void Progress::Update(double share) {
  if (style_ == Style::None) return;
  const std::unique_lock lock(mutex_, std::try_to_lock);
  if (!lock.owns_lock()) return;  // another thread is reporting; do not wait for the terminal
  share = std::clamp(share, 0.0, 1.0);
  if (style_ == Style::Lines) {
    const int tenths = static_cast<int>(share * 10.0);
    if (tenths > tenths_) {
      tenths_ = tenths;
      Write("facet: " + std::to_string(tenths * 10) + " %\n");
    }
    return;
  }
  const Clock::time_point now = Clock::now();
  if (now < next_draw_) return;
  next_draw_ = now + kBetweenDraws;
  DrawBar(share);
}

void Progress::DrawBar(double share) {
  const int percent = static_cast<int>(share * 100.0);
  const int width = std::clamp(TerminalColumns() - 20, 10, 50);
  const int full = static_cast<int>(share * width);
  std::string line = "\rrendering [";
  line.append(static_cast<std::size_t>(full), '#').append(static_cast<std::size_t>(width - full), '.');
  line += "] " + std::to_string(percent) + " %\033[K";
  Write(line);
  drawn_ = true;
}

}  // namespace facet::cli
