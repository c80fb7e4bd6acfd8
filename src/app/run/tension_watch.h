#pragma once
/// Monitors the tension in an incompressible fluid, a body that does not resist changes of its shape. Reports the first
/// time at which the multiplier λ of the volume constraint is negative. An affine motion has λ = 2p_c/(ρr²), with the
/// pressure p_c at the centre, the density ρ and the radius r. For finite elements and polynomial bodies, λ is 5/(ρr²)
/// times the mean pressure. On affine motions both definitions give the same λ. If λ < 0, the problem of the continuum
/// is ill-posed (docs/oliva.md, item 13). The program checks λ at samples and interpolates the time between two
/// samples.

#include <optional>
#include <string_view>
#include <vector>

#include "app/run/run_context.h"
#include "scene/scales.h"

namespace pseudorigid::app {

class TensionWatch {
 public:
  /// `model` is the name of the model for messages. The object refers to `context` and to the text of `model`.
  TensionWatch(const RunContext& context, std::string_view model)
      : context_(context),
        model_(model),
        is_fluid_(scene::is_ideal_fluid(context.scene) && context.scene.body.incompressible) {}

  /// True if the body is an incompressible fluid, so that the run must compute λ.
  bool watches() const { return is_fluid_; }

  /// Records the samples of an interrupted run from its rows, without warnings. Does nothing if the rows do not contain
  /// λ.
  void take_up(const io::Table& rows) {
    if (!is_fluid_ || !rows.has_column("multiplier")) return;
    const std::vector<double> times = rows.column("time"), lambdas = rows.column("multiplier");
    for (std::size_t k = 0; k < times.size(); ++k) note(times[k], lambdas[k]);
  }

  /// Checks a sample, and warns if it is the first sample under tension, λ < 0. Both arguments are in the user's units.
  void look(double time, double lambda) {
    if (note(time, lambda))
      context_.log->warn(
          "{}: tension at t = {:.6g}: the pressure at the centre falls below zero, and a fluid body would not hold "
          "together from here on",
          model_, *first_);
  }

  /// Adds the counter first_tension_time; adds nothing without tension.
  void report(io::Manifest::Model& statistics) const {
    if (first_) statistics.counters["first_tension_time"] = *first_;
  }

 private:
  /// Records a sample. Returns true if the body is an incompressible fluid and this sample is the first one under
  /// tension.
  bool note(double time, double lambda) {
    if (!is_fluid_ || first_) return false;
    if (lambda < 0)
      first_ = before_ ? before_->time + (time - before_->time) * before_->lambda / (before_->lambda - lambda) : time;
    before_ = {time, lambda};
    return first_.has_value();
  }

  struct Sample {
    double time, lambda;
  };
  const RunContext& context_;
  std::string_view model_;
  bool is_fluid_;
  std::optional<Sample> before_;  ///< the last recorded sample
  std::optional<double> first_;   ///< first time of tension in the user's units; empty before it
};

}  // namespace pseudorigid::app
