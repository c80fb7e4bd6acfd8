#pragma once
/// Monitors the surface of an incompressible ball. Let λ₁ be the least stretch along the surface at a point, and λ_n
/// the stretch along the normal. The program warns at the first sample at which the least ratio λ₁/λ_n falls to the
/// surface limit of the material law. For neo-Hookean and Mooney–Rivlin bodies, this limit is Biot's limit
/// (continuum/output/surface_stretch.h). Beyond the limit, the exact motion has growing surface waves of every length.
/// The finite elements show only the waves that the mesh resolves.

#include <algorithm>
#include <array>
#include <optional>
#include <span>

#include "app/run/run_context.h"
#include "continuum/output/surface_stretch.h"
#include "materials/law_table.h"

namespace pseudorigid::app {

class WrinklingWatch {
 public:
  WrinklingWatch(const RunContext& context, const materials::AnyLaw& law) : context_(context) {
    if (context.needs.surface_watch) limit_ = materials::surface_limit(law);
  }

  /// Checks the positions x of the nodes at a sample. `time` is in the user's units. Collective: all ranks must call
  /// this function.
  void look(double time, const continuum::BallSpace& space, const continuum::Vector& x) {
    if (!limit_) return;
    const continuum::LeastPlace surface = continuum::least_surface_stretch(space, x);
    least_ = std::min(least_, surface.value);
    if (first_ || surface.value > *limit_) return;
    first_ = time;
    context_.log->warn(
        "continuum: the surface reaches Biot's limit at t = {:.6g}: its stretch along the surface is {:.3g} of that "
        "along the normal at X/r = ({:.3f}, {:.3f}, {:.3f}); below {:.4f} a smooth surface is unstable to wrinkles as "
        "short as the mesh admits, so check on a finer mesh what is seen near it",
        time, surface.value, surface.where[0], surface.where[1], surface.where[2], *limit_);
  }

  /// Three numbers for checkpoints. They are the least ratio λ₁/λ_n so far, the time of the warning, and 1. Without a
  /// warning, the last two are 0.
  std::array<double, 3> remarks() const { return {least_, first_.value_or(0), first_ ? 1.0 : 0.0}; }
  /// Restores the numbers of `remarks`.
  void take_remarks(std::span<const double, 3> remarks) {
    least_ = remarks[0];
    if (remarks[2] != 0) first_ = remarks[1];
  }

  /// Adds the counter of the least ratio λ₁/λ_n if this ratio is below 1. Adds the counter of the time of the warning
  /// if there was a warning.
  void report(io::Manifest::Model& statistics) const {
    if (limit_ && least_ < 1) statistics.counters["least_surface_stretch_ratio"] = least_;
    if (first_) statistics.counters["surface_limit_time"] = *first_;
  }

 private:
  const RunContext& context_;
  std::optional<double> limit_;  ///< limit of λ₁/λ_n for the law; if empty, nothing is checked
  double least_ = 1;  ///< least λ₁/λ_n over the surface and the samples so far; 1 before the first sample
  std::optional<double> first_;  ///< time of the warning in the user's units; empty before it
};

}  // namespace pseudorigid::app
