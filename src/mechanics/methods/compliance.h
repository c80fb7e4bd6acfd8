#pragma once
/// The multiplier of a compliant constraint (constrained_system.h) in a step of size h. With b = DB and g = g(q), the
/// force of the energy B is the reaction of λ = −b(ḡ). The methods take a mean ḡ of g about the time at which λ acts:
///
///   rattle       ḡ = (g_n + g_{n+1})/2            λ acts from q_n to q_{n+1} and back
///   symmetric-4  ḡ = (g_{n−1} + 2g_n + g_{n+1})/4   λ = λ_n acts at q_n
///
/// Let w be the weight of g_{n+1} in ḡ. A change M⁻¹G(q_n)ᵀδ of q_{n+1} changes λ by sδ. Newton's iteration has the
/// residual r = (b(ḡ) + λ)/(wκ), and b ≈ κg:
///
///   [G(q_{n+1}) M⁻¹ G(q_n)ᵀ + s/(wκ)] δ = −r,   q_{n+1} ← q_{n+1} + M⁻¹G(q_n)ᵀδ,   λ ← λ + sδ.

#include <algorithm>
#include <cmath>
#include <utility>

#include "mechanics/core/constraint_newton.h"
#include "mechanics/methods/rattle_workspace.h"

namespace pseudorigid::mechanics::detail {

/// The tolerance of |g|_∞ in a step of size h. An error δ of g remains as an oscillation of g. Its energy is about
/// κδ²/2, and it changes v by δ/h.
template <Compliant S>
double compliance_tolerance(const S& system, double h, const RattleWorkspace<S>& w) {
  constexpr double part = 1e-5;
  const double least = system.constraint_tolerance();
  return w.constraint_tolerance > least
             ? std::min(w.constraint_tolerance, part / std::sqrt(system.constraint_stiffness()))
             : std::min(1.0, std::abs(h)) * least;
}

/// Runs this iteration with q = q_{n+1}, `lambda` = λ and the step h. The function `find_mean` sets w.compliance.mean
/// to ḡ. Its input is w.compliance.g_end = g(q_{n+1}). The function `apply` makes the changes for a correction: the
/// vector w.constraint.reaction = M⁻¹G(q_n)ᵀδ and w.constraint.delta = δ. Fails if the constraint or a Gram solve
/// fails, or if the iteration does not converge.
template <Compliant S, class Mean, class Apply>
Status meet_compliance(const S& system, double h, double weight, double per_delta, const typename S::Vector& q,
                       const typename S::Multiplier& lambda, RattleWorkspace<S>& w, Mean&& find_mean, Apply&& apply) {
  static_assert(!single_constraint<S>, "the Gram system of a single constraint has no shift");
  const double kappa = system.constraint_stiffness();
  const auto evaluate = [&] {
    Status status = system.constraint(q, w.compliance.g_end);
    if (!status) return status;
    find_mean();
    system.constraint_force(w.compliance.mean, w.constraint.residual);
    axpy(1.0, lambda, w.constraint.residual);
    scale(1 / (weight * kappa), w.constraint.residual);
    return status;
  };
  w.system.gram_shift = per_delta / (weight * kappa);
  Status status = meet_constraint(system, "position", compliance_tolerance(system, h, w), q, w.q_start, w.system,
                                  w.constraint, evaluate, apply, [&] { return noise_of_constraint(system, q); });
  w.system.gram_shift = 0;
  w.counters.n_gram_iterations += std::exchange(w.constraint.n_gram_iterations, 0);
  return status;
}

/// Moves state.q along M⁻¹G(q₀)ᵀ until g = `value`. h is the size of the steps. Fails if the constraint or a Gram solve
/// fails, or if the iteration does not converge.
template <Compliant S>
Status meet_value(const S& system, double h, const typename S::Multiplier& value, const typename S::Vector& q0,
                  State<S>& state, RattleWorkspace<S>& w) {
  const auto evaluate = [&] {
    Status status = system.constraint(state.q, w.constraint.residual);
    axpy(-1.0, value, w.constraint.residual);
    return status;
  };
  const auto apply = [&] { add(1.0, w.constraint.reaction, state.q, w.q_rounding); };
  w.constraint.direction_known = false;
  Status status = meet_constraint(system, "position", compliance_tolerance(system, h, w), state.q, q0, w.system,
                                  w.constraint, evaluate, apply, [&] { return noise_of_constraint(system, state.q); });
  w.counters.n_gram_iterations += std::exchange(w.constraint.n_gram_iterations, 0);
  return status;
}

/// Moves state.v along M⁻¹Gᵀ until G v = `rate`. Fails if a Gram solve fails or the iteration does not converge.
template <Compliant S>
Status meet_rate(const S& system, const typename S::Multiplier& rate, State<S>& state, RattleWorkspace<S>& w) {
  const auto evaluate = [&] {
    system.constraint_rate(state.q, state.v, w.constraint.residual);
    axpy(-1.0, rate, w.constraint.residual);
    return Status();
  };
  const auto apply = [&] { add(1.0, w.constraint.reaction, state.v, w.v_rounding); };
  w.constraint.direction_known = false;
  Status status = meet_constraint(system, "velocity", w.constraint_tolerance, state.q, state.q, w.system, w.constraint,
                                  evaluate, apply, [&] { return noise_of_rate(system, state.q, state.v); });
  w.counters.n_gram_iterations += std::exchange(w.constraint.n_gram_iterations, 0);
  ++w.counters.n_projections;
  return status;
}

}  // namespace pseudorigid::mechanics::detail
