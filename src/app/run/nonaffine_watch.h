#pragma once
/// Monitors the non-affine displacement of a fluid. If the body is a ball or an ellipsoid, its exact motion under its
/// own gravity and quadratic potentials is affine, x = QX (Dirichlet). A non-affine part of a computed motion is
/// therefore an error. This error grows, because no force restores the affine form. The program warns at the first
/// sample at which the error exceeds 1 % of the size of the body. At the end of the run, the program reports the
/// largest error. For a mesh from a file, the program does not check that the body is an ellipsoid.

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <string_view>

#include "app/run/run_context.h"
#include "scene/scales.h"

namespace pseudorigid::app {

class NonaffineWatch {
 public:
  /// `model` is the name of the model for messages. The object refers to `context` and to the text of `model`.
  NonaffineWatch(const RunContext& context, std::string_view model)
      : context_(context),
        model_(model),
        watches_(scene::is_ideal_fluid(context.scene) && stays_affine(context.scene)) {}

  /// True if the body is an ideal fluid whose exact motion is affine. The run must then compute the non-affine
  /// displacement.
  bool watches() const { return watches_; }

  /// Checks a sample. `time` is in the user's units. `displacement` is |x − QX| / |x|, the error relative to the size
  /// of the body. Positions x are relative to the centre of mass, and |x|² is the integral of x·x over the mass.
  void look(double time, double displacement) {
    if (!watches_) return;
    largest_ = std::max(largest_, displacement);
    if (first_ || displacement <= acceptable) return;
    first_ = time;
    context_.log->warn(
        "{}: at t = {:.6g} the non-affine displacement is {:.3g} % of the size of the body; in a fluid it is an error, "
        "which grows until the run stops",
        model_, time, 100 * displacement);
  }

  /// Three numbers for checkpoints. They are the largest displacement, the time of the warning, and 1. Without a
  /// warning, the last two are 0.
  std::array<double, 3> remarks() const { return {largest_, first_.value_or(0), first_ ? 1.0 : 0.0}; }
  /// Restores the numbers of `remarks`.
  void take_remarks(std::span<const double, 3> remarks) {
    largest_ = remarks[0];
    if (remarks[2] != 0) first_ = remarks[1];
  }

  /// Writes the largest displacement into the statistics and the log. Does nothing if watches() is false.
  void report(io::Manifest::Model& statistics) const {
    if (!watches_) return;
    statistics.counters["nonaffine_displacement_at_most"] = largest_;
    context_.log->info(
        "{}: the non-affine displacement, which in a fluid is an error, is at most {:.3g} % of the size of the body",
        model_, 100 * largest_);
  }

 private:
  static constexpr double acceptable =
      0.01;  ///< largest displacement without a warning, relative to the size of the body

  /// True if the exact motion of a fluid ball is affine under the loads of the scene. It is not affine if a traction,
  /// viscous or viscoelastic stress, contact with planes, or the full potential of companions acts.
  static bool stays_affine(const scene::Scene& scene) {
    const loads::Forcing forcing = loads::full_forcing(scene.loads);
    return forcing.nominal_traction.isZero(0) && forcing.viscosity == 0 && forcing.planes.empty() &&
           forcing.branches.empty() && !forcing.companions.full_potential;
  }

  const RunContext& context_;
  std::string_view model_;
  bool watches_;
  double largest_ = 0;
  std::optional<double> first_;  ///< time of the warning in the user's units; empty before it
};

}  // namespace pseudorigid::app
