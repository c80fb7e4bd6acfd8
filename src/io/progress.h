#pragma once
/// The progress line of a time loop: fraction done, steps per second, time left. Drawn on stderr when it is a terminal,
/// otherwise nothing.

#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>

namespace pseudorigid::io {

class Progress {
 public:
  explicit Progress(std::string label, bool enabled = stderr_is_terminal(), std::string unit = "steps");
  ~Progress() { finish(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Called after every step. The clock is read only every so many calls, a number that adapts to the speed of the
  /// loop, so a step of a microsecond pays one comparison.
  void step(double fraction) {
    if (++n_steps_ >= next_look_) look(fraction);
  }
  void finish();  ///< clears the line

  static bool stderr_is_terminal();

 private:
  using Clock = std::chrono::steady_clock;
  void look(double fraction);
  void draw(double fraction, Clock::time_point now);

  std::string label_, unit_;
  std::int64_t n_steps_ = 0, next_look_ = 1, stride_ = 1;
  Clock::time_point start_, last_look_, last_draw_;
  double start_fraction_ = -1;  ///< at the first step seen; a resumed run does not begin at 0
  bool drawn_ = false;
};

/// "42%  1.3e+05 steps/s  3 min left": the words of the line, apart from the terminal so that they can be tested.
std::string progress_text(double fraction, double steps_per_second, double seconds_left,
                          std::string_view unit = "steps");

}  // namespace pseudorigid::io
