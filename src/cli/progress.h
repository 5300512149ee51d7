// The progress of a rendering on standard error.
#pragma once

#include <chrono>
#include <mutex>

namespace facet::cli {

// Reports the finished share of the work on standard error. On a terminal, a bar appears after half a second and is
// erased at the end. Otherwise, a line is printed for every tenth, if progress was requested.
class Progress {
 public:
  enum class Style { None, Bar, Lines };

  explicit Progress(Style style);
  ~Progress();  // erases the bar
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  // `share` in [0, 1]. May be called from any thread. Calls in quick succession only read the clock.
  void Update(double share);

  // The style for standard error. `wanted` is RenderOptions::progress, or null if that is not set.
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
