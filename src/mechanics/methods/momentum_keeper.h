#pragma once
/// Correction of the round-off of the momenta p_i = ⟨M v, ξ_i(q)⟩, for a method that conserves them. Here M is the
/// mass, q the position, v the velocity, and ξ_i(q) the velocity field of the i-th symmetry. By round-off, each step
/// changes the momenta by about 10⁻¹⁸ in internal units, and these errors would accumulate. If the error of a momentum
/// exceeds the round-off of this momentum, the correction changes the velocity along the fields ξ_i. In the metric of
/// the kinetic energy, the correction is the smallest change that restores the momenta:
///
///   v ← v + Σ α_i ξ_i(q),   Σ_j ⟨M ξ_i, ξ_j⟩ α_j = p_i(0) − p_i,
///
/// with the momenta p_i(0) of the first state. The change is tangent to the constraints, because the symmetries
/// preserve the constraints.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "mechanics/core/conservative_system.h"
#include "mechanics/core/dense_algebra.h"

namespace pseudorigid::mechanics {

template <ConservativeSystem S>
class MomentumKeeper {
 public:
  using Vector = typename S::Vector;

  explicit MomentumKeeper(const S& system)
      : xi_(static_cast<std::size_t>(system.n_symmetries()), system.make_vector()),
        momentum_(system.make_vector()),
        unused_(momentum_),
        start_(xi_.size()) {}

  /// At the first call, stores the momenta p_i(0) of the state. Later calls do nothing. `keep` restores the stored
  /// momenta.
  void begin(const S& system, const State<S>& state) {
    if (known_) return;
    known_ = true;
    set_symmetries(system, state);
    for (std::size_t i = 0; i < xi_.size(); ++i) start_[i] = dot(momentum_, xi_[i]);
  }

  /// Corrects state.v by the formula at the head of this file. `v_rounding` is the remainder of the compensated sum
  /// state.v. Does nothing if there are no symmetries, or if the errors of all momenta are round-off. Call `begin`
  /// before.
  void keep(const S& system, State<S>& state, Vector& v_rounding) {
    const auto n = static_cast<Eigen::Index>(xi_.size());
    if (n == 0) return;
    set_symmetries(system, state);
    Eigen::VectorXd lost(n);
    bool beyond_round_off = false;
    const double size = std::sqrt(dot(momentum_, momentum_));
    for (Eigen::Index i = 0; i < n; ++i) {
      const Vector& xi = xi_[static_cast<std::size_t>(i)];
      lost[i] = start_[static_cast<std::size_t>(i)] - dot(momentum_, xi);
      beyond_round_off |=
          std::abs(lost[i]) > 4 * std::numeric_limits<double>::epsilon() * size * std::sqrt(dot(xi, xi));
    }
    if (beyond_round_off) give_back(system, lost, state, v_rounding);
  }

  /// Passes each member that a checkpoint must contain to `visit`.
  template <class Visit>
  void visit_memory(Visit&& visit) {
    visit(std::span<double>(start_));
    visit(known_);
  }

 private:
  /// Sets momentum_ = M v and xi_ to the fields ξ_i at the state.
  void set_symmetries(const S& system, const State<S>& state) {
    system.apply_mass(state.v, momentum_);
    for (std::size_t i = 0; i < xi_.size(); ++i)
      system.symmetry(static_cast<int>(i), state.q, state.v, xi_[i], unused_);
  }

  /// Adds Σ α_i ξ_i to the velocity, such that momentum i increases by lost[i].
  void give_back(const S& system, const Eigen::VectorXd& lost, State<S>& state, Vector& v_rounding) {
    const Eigen::Index n = lost.size();
    Eigen::MatrixXd gram(n, n);
    for (Eigen::Index i = 0; i < n; ++i) {
      system.apply_mass(xi_[static_cast<std::size_t>(i)], momentum_);
      for (Eigen::Index j = 0; j < n; ++j) gram(i, j) = dot(momentum_, xi_[static_cast<std::size_t>(j)]);
    }
    // The matrix is singular if a combination of symmetries does not move the body. An example is a rotation of space
    // and an opposite rotation of the body about the same axis.
    const Eigen::VectorXd alpha = least_squares(gram, lost, 1e-8);
    for (Eigen::Index i = 0; i < n; ++i) add(alpha[i], xi_[static_cast<std::size_t>(i)], state.v, v_rounding);
  }

  std::vector<Vector> xi_;
  Vector momentum_, unused_;
  std::vector<double> start_;  // the momenta p_i(0) of the first state
  bool known_ = false;
};

}  // namespace pseudorigid::mechanics
