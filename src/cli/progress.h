// A bar for the patient.
#pragma once

#include <chrono>
#include <mutex>

namespace facet::cli {

// Reports the share of the work that is done on standard error: on a terminal a bar that appears after half a second
// and is erased at the end; elsewhere, when asked for, a line every tenth.
class Progress {
 public:
  enum class Style { None, Bar, Lines };

  explicit Progress(Style style);
  ~Progress();  // erases the bar
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  // `share` in [0, 1]. May be called from any thread; calls that come too often cost a clock reading.
  void Update(double share);

  // What suits standard error. `wanted` overrides what would be chosen; see RenderOptions::progress.
  static Style StyleFor(bool quiet, const bool* wanted);

 private:
  using Clock = std::chrono::steady_clock;

  void DrawBar(double share);

  const Style style_;
  const Clock::time_point start_ = Clock::now();
  std::mutex mutex_;
  Clock::time_point next_draw_;
  int tenths_ = 0;
  bool drawn_ = false;
};

}  // namespace facet::cli
