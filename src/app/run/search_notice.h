#pragma once
/// Messages of a search for method and step that takes longer than a second: its task, then after ten seconds, a
/// hundred …, that it continues.

#include <chrono>
#include <string>
#include <utility>

#include "app/run/run_context.h"

namespace pseudorigid::app {

class SearchNotice {
 public:
  /// `what`: a sentence about the search, after the name of the model.
  SearchNotice(const RunContext& context, std::string model, std::string what, int steps_between_looks)
      : context_(context),
        model_(std::move(model)),
        what_(std::move(what)),
        steps_between_looks_(steps_between_looks) {}

  /// After every step of a pilot.
  void step() {
    if (++n_steps_ < steps_between_looks_) return;
    n_steps_ = 0;
    const double seconds = std::chrono::duration<double>(Clock::now() - start_).count();
    if (seconds < next_) return;
    if (next_ == first_)
      context_.log->info("{}: {}", model_, what_);
    else
      context_.log->info("{}: still looking for the step, after {:.0f} s", model_, seconds);
    while (next_ <= seconds) next_ *= 10;
  }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr double first_ = 1;

  const RunContext& context_;
  std::string model_, what_;
  int steps_between_looks_;
  Clock::time_point start_ = Clock::now();
  int n_steps_ = 0;
  double next_ = first_;
};

}  // namespace pseudorigid::app
