#pragma once
/// The progress line of a loop in time: the completed fraction, the steps per second and the remaining time. By
/// default, the line appears on stderr if stderr is a terminal.

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

  /// Call this function after every step. The function reads the clock once in several calls and adapts the number of
  /// these calls to the speed of the loop. Most calls therefore cost only one comparison.
  void step(double fraction) {
    if (++n_steps_ >= next_look_) look(fraction);
  }
  void finish();  ///< deletes the line from the terminal

  static bool stderr_is_terminal();

 private:
  using Clock = std::chrono::steady_clock;
  void look(double fraction);
  void draw(double fraction, Clock::time_point now);

  std::string label_, unit_;
  std::int64_t n_steps_ = 0, next_look_ = 1, stride_ = 1;
  Clock::time_point start_, last_look_, last_draw_;
  double start_fraction_ = -1;  ///< −1, then the fraction at the first look; positive in a resumed run
  bool drawn_ = false;
};

/// The text of the line, for example " 42 %  1.3e+05 steps/s  3 min left". It is a separate function for tests.
std::string progress_text(double fraction, double steps_per_second, double seconds_left,
                          std::string_view unit = "steps");

}  // namespace pseudorigid::io
