#include "io/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <limits>

namespace pseudorigid::io {

using namespace std::chrono_literals;

namespace {

/// The intended time between two readings of the clock, and the shortest time between two drawings of the line.
constexpr auto look_interval = 20ms, draw_interval = 200ms;
constexpr std::int64_t max_stride = 1024;  // if steps become slower, the clock is still read soon

std::string duration_text(double seconds) {
  if (seconds < 100) return fmt::format("{:.0f} s", seconds);
  if (seconds < 6000) return fmt::format("{:.0f} min", seconds / 60);
  return fmt::format("{:.1f} h", seconds / 3600);
}

}  // namespace

bool Progress::stderr_is_terminal() { return ::isatty(STDERR_FILENO) == 1; }

Progress::Progress(std::string label, bool enabled, std::string unit)
    : label_(std::move(label)), unit_(std::move(unit)) {
  if (!enabled) next_look_ = std::numeric_limits<std::int64_t>::max();
}

std::string progress_text(double fraction, double steps_per_second, double seconds_left, std::string_view unit) {
  return fmt::format("{:3.0f} %  {:.3g} {}/s  {} left", 100 * fraction, steps_per_second, unit,
                     duration_text(seconds_left));
}

void Progress::look(double fraction) {
  const auto now = Clock::now();
  if (start_fraction_ < 0) {
    start_fraction_ = fraction;
    start_ = last_draw_ = now;
  } else {
    if (now - last_look_ < look_interval / 2) stride_ = std::min(2 * stride_, max_stride);
    if (now - last_look_ > 2 * look_interval) stride_ = std::max<std::int64_t>(stride_ / 4, 1);
    if (now - last_draw_ >= draw_interval) draw(fraction, now);
  }
  last_look_ = now;
  next_look_ = n_steps_ + stride_;
}

void Progress::draw(double fraction, Clock::time_point now) {
  const double seconds = std::chrono::duration<double>(now - start_).count();
  const double done = fraction - start_fraction_;
  const double seconds_left = done > 0 ? seconds * (1 - fraction) / done : 0;
  const std::string line =
      fmt::format("\r{}  {}\033[K", label_,
                  progress_text(fraction, static_cast<double>(n_steps_ - 1) / seconds, seconds_left, unit_));
  std::fputs(line.c_str(), stderr);  // fmt::print would throw if the terminal is closed
  std::fflush(stderr);
  last_draw_ = now;
  drawn_ = true;
}

void Progress::finish() {
  if (!drawn_) return;
  std::fputs("\r\033[K", stderr);
  std::fflush(stderr);
  drawn_ = false;
}

}  // namespace pseudorigid::io
