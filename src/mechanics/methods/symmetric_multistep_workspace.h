#pragma once
/// The workspace of a symmetric multistep method (symmetric_multistep.h), and the part of it that belongs to a
/// compliant constraint (compliance.h).

#include <algorithm>
#include <array>
#include <cstddef>

#include "mechanics/methods/compliance.h"
#include "mechanics/methods/rattle.h"

namespace pseudorigid::mechanics {

/// Contains the last values of a compliant constraint. It is empty for a rigid constraint.
template <class S>
struct ConstraintHistory {
  static constexpr bool is_used = false;

  explicit ConstraintHistory(const S&) {}
  template <class Visit>
  void visit_memory(Visit&&) {}
};
template <Compliant S>
struct ConstraintHistory<S> {
  explicit ConstraintHistory(const S& system) : is_used(is_compliant(system)) {
    if (is_used) g.fill(system.make_multiplier());
  }
  void record(const typename S::Multiplier& newest) {
    std::rotate(g.begin(), g.end() - 1, g.end());
    g[0] = newest;
  }
  template <class Visit>
  void visit_memory(Visit&& visit) {
    if (!is_used) return;
    for (auto& x : g) visit(x);
  }

  bool is_used;
  std::array<typename S::Multiplier, 4> g;  // the last values g_n, the latest first
};

/// Workspace of a symmetric multistep method. The members `d` and `a` are the history, a ring of k − 1 slots with d_i
/// and a_i of the last k − 1 steps. In the slot of the newest step, `a` contains the old value a_{n−(k−1)} until a_n is
/// computed. The base class has the members that RATTLE also uses.
template <ConstrainedSystem S, int k, template <class> class Start>
struct SymmetricMultistepWorkspace : RattleWorkspace<S> {
  static constexpr int n_slots = k - 1;
  /// Largest number of previous multipliers from which a polynomial extrapolates the next multiplier.
  static constexpr int n_extrapolated = S::n_constraints == dynamic_constraints ? 5 : 6;

  explicit SymmetricMultistepWorkspace(const S& system)
      : RattleWorkspace<S>(system), start(system), multiplier(system.make_multiplier()), constraints(system) {
    d.fill(system.make_vector());
    a.fill(system.make_vector());
    multipliers.fill(system.make_multiplier());
  }

  Start<S> start;
  typename S::Multiplier multiplier;  // λ_n, extrapolated and then corrected
  std::array<typename S::Vector, n_slots> d, a;
  std::array<typename S::Multiplier, n_extrapolated> multipliers;  // λ of the last steps, in a ring of slots
  [[no_unique_address]] ConstraintHistory<S> constraints;
  double h = 0;               // size of the steps in the history; 0: there was no step
  int newest = 0;             // slot of d_n = q_n − q_{n−1}, the difference of the last step
  int n_known = 0;            // number of differences d in the history
  int newest_multiplier = 0;  // slot of λ_{n−1}
  int n_multipliers = 0;      // number of multipliers in the history

  /// Passes each member that a checkpoint must contain to `visit`.
  template <class Visit>
  void visit_memory(Visit&& visit) {
    RattleWorkspace<S>::visit_memory(visit);
    start.visit_memory(visit);
    visit(this->acceleration);
    for (auto& x : d) visit(x);
    for (auto& x : a) visit(x);
    for (auto& x : multipliers) visit(x);
    constraints.visit_memory(visit);
    visit(h);
    visit(newest);
    visit(n_known);
    visit(newest_multiplier);
    visit(n_multipliers);
    visit(this->acceleration_known);
  }
};

namespace detail {

/// Adds g at the state to the history of a compliant constraint. Fails if the constraint cannot be evaluated.
template <Compliant S, class Workspace>
Status record_constraint(const S& system, const State<S>& state, Workspace& w) {
  Status status = system.constraint(state.q, w.compliance.g_end);
  w.compliance.g_known = status.ok();
  if (status) w.constraints.record(w.compliance.g_end);
  return status;
}

/// Records g at the end of a step of the start, with the difference d. Adds M⁻¹Gᵀλ at the beginning of the step to a.
/// λ is −b of the mean of g as in the method. At the start of the run, one value is missing, and the mean is that of
/// the step. Fails if the constraint cannot be evaluated.
template <Compliant S, class Workspace>
[[gnu::noinline]] Status add_start_reaction(const S& system, const State<S>& state, const typename S::Vector& d,
                                            Workspace& w, typename S::Vector& a) {
  if (Status status = record_constraint(system, state, w); !status) return status;
  const bool is_first = w.n_known == 0;
  auto &mean = w.compliance.mean, &lambda = w.compliance.lambda;
  mean = w.constraints.g[1];
  axpy(0.5, w.constraints.g[0], mean);
  axpy(is_first ? -0.5 : 0.5, w.constraints.g[is_first ? 1 : 2], mean);
  if (!is_first) scale(0.5, mean);
  system.constraint_force(mean, lambda);
  scale(-1.0, lambda);
  typename S::Vector q = state.q;
  axpy(-1.0, d, q);
  set_reaction(system, q, lambda, w.system, w.constraint);
  axpy(1.0, w.constraint.reaction, a);
  return {};
}

/// Projects v onto G v = ġ for a compliant constraint. The rate ġ is extrapolated linearly from the differences over
/// two steps. Fails if the projection fails.
template <Compliant S, class Workspace>
[[gnu::noinline]] Status project_onto_rate(const S& system, State<S>& state, Workspace& w) {
  auto& rate = w.compliance.mean;
  rate = w.constraints.g[0];
  constexpr std::array<double, 4> weights{1, -0.5, -1, 0.5};  // (2(g_n − g_{n−2}) − (g_{n−1} − g_{n−3}))/2h
  for (std::size_t i = 1; i < weights.size(); ++i) axpy(weights[i], w.constraints.g[i], rate);
  scale(1 / w.h, rate);
  return meet_rate(system, rate, state, w);
}

}  // namespace detail
}  // namespace pseudorigid::mechanics
