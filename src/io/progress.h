#pragma once
/// The progress line of a loop, for example over time steps: the completed fraction, the steps per second and the
/// remaining time. By default, the line appears on stderr if stderr is a terminal.

#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>

namespace pseudorigid::io {

class Progress {
 public:
  /// The line begins with `label`. `unit` is the word for the steps in the text “steps/s” of the line. If `enabled` is
  /// false, the object does not write a line.
  explicit Progress(std::string label, bool enabled = stderr_is_terminal(), std::string unit = "steps");
  ~Progress() { finish(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Call this function after every step. `fraction` is the completed part of the loop, from 0 to 1. The function reads
  /// the clock in one of `stride_` calls, and adapts this number to the speed of the loop, up to 1024. In a fast loop,
  /// most calls therefore cost only one comparison.
  void step(double fraction) {
    if (++n_steps_ >= next_look_) look(fraction);
  }
  void finish();  ///< deletes the line from the terminal

  static bool stderr_is_terminal();

 private:
  using Clock = std::chrono::steady_clock;
  /// Reads the clock, adapts `stride_`, and draws the line if at least 0.2 s have passed since the last drawing. The
  /// first call stores the start of the loop and does not draw.
  void look(double fraction);
  void draw(double fraction, Clock::time_point now);

  std::string label_, unit_;
  /// The number of calls of `step`, the number at which `step` calls `look` next, and the number of steps between two
  /// calls of `look`.
  std::int64_t n_steps_ = 0, next_look_ = 1, stride_ = 1;
  Clock::time_point start_, last_look_, last_draw_;
  double start_fraction_ = -1;  ///< fraction at the first call of `look`; negative before this call
  bool drawn_ = false;
};

/// The text of the line after the label, for example " 42 %  1.3e+05 steps/s  3 min left". The function is separate
/// from the class, so that tests can call it.
std::string progress_text(double fraction, double steps_per_second, double seconds_left,
                          std::string_view unit = "steps");

}  // namespace pseudorigid::io
