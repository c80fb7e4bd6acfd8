#pragma once
/// Check that the steps between two samples conserve the energy. An interval is checked only if the least det F is
/// below 0.95 at one of its ends, with the deformation gradient F, or if every interval is watched. Let K be the
/// kinetic and V the potential energy, E = K + V, and N the number of samples. The indices 0 and 1 denote the ends of
/// the interval between the samples. The condition is
///
///   |E_1 − E_0| ≤ min(τ, 5e-4)/√N · max(E_m, K_0 + K_1),   E_m = K + |V − V of the body at rest| at the start,
///
/// with the tolerance τ of the scene, but at least 1e-9. The errors of the energy and of Q are of the same order in the
/// step. In 32 releases of elements until t = 5 r/c, the error of Q was below τ, but for one of 1.8 τ. The elements had
/// degrees 3 to 6, the stretches were 1.35 and 1.5, and τ was 1e-6 to 1e-3. The bound 2 τ gave two errors above τ in
/// an earlier form of the step control. The condition is the same for the interval backwards in time.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <optional>

#include "mechanics/core/second_order_field.h"

namespace pseudorigid::app {

template <class Model>
class EnergyWatch {
  using State = typename Model::State;

 public:
  /// The object refers to `model`. `tolerance` is τ and `n_samples` is N in the condition above. `every_interval` is
  /// true if every interval is watched.
  EnergyWatch(const Model& model, double tolerance, long n_samples, bool every_interval)
      : model_(model),
        most_(std::clamp(tolerance, 1e-9, 5e-4) / std::sqrt(static_cast<double>(n_samples))),
        every_interval_(every_interval) {}

  /// Returns true if the condition in the opening comment holds between the states `before` and `after` at the ends of
  /// an interval. J_before and J_after are the least det F in these states. Also returns true if forces dissipate
  /// energy or depend on time, because E is then not constant. Unless every interval is watched, also returns true if
  /// J_before and J_after are at least 0.95. Errors of the energy then result from the chosen step and are not judged.
  bool keeps_energy(const State& before, double J_before, const State& after, double J_after) {
    constexpr double watched = 0.95;
    if (mechanics::dissipative(model_.system()) || mechanics::time_dependent(model_.system())) return true;
    if (!every_interval_ && J_before >= watched && J_after >= watched) return true;
    if (!of_motion_) {
      const State start = model_.initial_state();
      const Eigen::Vector2d at_start = model_.energies(start);
      of_motion_ = at_start[0] + std::abs(at_start[1] - model_.energies(model_.at_rest(start))[1]);
    }
    const Eigen::Vector2d E_0 = model_.energies(before), E_1 = model_.energies(after);
    return std::abs(E_1.sum() - E_0.sum()) <= most_ * std::max(*of_motion_, E_0[0] + E_1[0]);
  }

 private:
  const Model& model_;
  double most_;  ///< the factor min(τ, 5e-4)/√N of the formula above
  bool every_interval_;
  std::optional<double> of_motion_;  ///< E_m of the formula above; computed when it is first needed
};

}  // namespace pseudorigid::app
