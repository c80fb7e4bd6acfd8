#pragma once
/// Explicit symmetric linear multistep methods for conservative systems with constraints (Console, Hairer, Lubich,
/// Numer. Math. 124 (2013) 517),
///
///   Σ_j α_j q_{n+j} = h² Σ_j β_j M⁻¹[f(q_{n+j}) + G(q_{n+j})ᵀ λ_{n+j}],   g(q_{n+k}) = 0,   β_0 = β_k = 0:
///
/// one force a step, and one constraint solve for the newest multiplier λ_{n+k−1}. The step is made for the differences
/// d_n = q_n − q_{n−1} (multistep_coefficients.h) with a_n = M⁻¹[f + Gᵀλ]_n, and q summed with compensation:
///
///   d_{n+1} = Σ_i α̂_i d_{n−i} + h² Σ_i β̂_i a_{n−i},   q_{n+1} = q_n + d_{n+1}.
///
/// The first k − 1 steps are made by the explicit method of order 8 with a tolerance at round-off. The steps do not use
/// the velocity; where it is looked at,
///
///   v_n = d_n/h + h Σ_i c_i a_{n−i}   (order k + 1),   then projected onto G v = 0,
///
/// in which λ_n need not be known: it acts along M⁻¹G(q_n)ᵀ, just where the projection does. A changed step starts
/// anew.
///
/// Energy and momenta are kept up to bounded oscillations of size h^order. Round-off of the constraint, ε, makes one of
/// ε/h² in the multipliers, which the history carries on with the weights β̂ (up to 5 for order 8, 62 for order 12) and
/// which grows with the square root of the number of steps: order 8 is the one for long runs.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "mechanics/core/constraint_newton.h"
#include "mechanics/core/explicit_multiplier.h"
#include "mechanics/methods/dormand_prince_8.h"
#include "mechanics/methods/multistep_coefficients.h"

namespace pseudorigid::mechanics {

/// Slot i mod (k − 1) of the history holds d_i and a_i, for the last k − 1 points.
template <ConstrainedSystem S, int k>
struct SymmetricMultistepWorkspace {
  static constexpr int n_slots = k - 1;

  explicit SymmetricMultistepWorkspace(const S& system)
      : system(system.make_workspace()),
        field(system),
        starter(field, 4 * std::numeric_limits<double>::epsilon()),
        acceleration(system.make_vector()),
        q_start(system.make_vector()),
        q_rounding(system.make_vector()),
        constraint(system),
        multiplier(system.make_multiplier()) {
    d.fill(system.make_vector());
    a.fill(system.make_vector());
    multipliers.fill(system.make_multiplier());
  }

  typename S::Workspace system;
  ExplicitMultiplier<S> field;
  DormandPrince8Workspace<ExplicitMultiplier<S>> starter;
  typename S::Vector acceleration, q_start, q_rounding;  // M⁻¹f at the state; q_n; what rounding keeps back from q
  detail::ConstraintTemporaries<S> constraint;
  typename S::Multiplier multiplier;
  std::array<typename S::Vector, n_slots> d, a;
  std::array<typename S::Multiplier, 4> multipliers;  // λ_{n−1}, λ_{n−2}, …
  double h = 0;
  int newest = 0;   // slot of the state's d
  int n_known = 0;  // steps in the history
  int n_multipliers = 0;
  bool acceleration_known = false;
  Counters counters;

  /// Hands out what belongs to the state of the computation and must survive a checkpoint.
  template <class Visit>
  void visit_memory(Visit&& visit) {
    starter.visit_memory(visit);
    visit(q_rounding);
    visit(acceleration);
    for (auto& x : d) visit(x);
    for (auto& x : a) visit(x);
    for (auto& x : multipliers) visit(x);
    visit(h);
    visit(newest);
    visit(n_known);
    visit(n_multipliers);
    visit(acceleration_known);
  }
};

template <class Coefficients>
struct SymmetricMultistep {
  static constexpr int order = Coefficients::order;
  static constexpr int n_stages = 1;
  static constexpr bool symplectic = false, symmetric = true;
  static constexpr bool adaptive = false, chosen_by_auto = false;
  static constexpr double stability_limit = Coefficients::stability_limit;
  static constexpr MultistepFormula<order> formula = multistep_formula<order>(Coefficients::a);

  template <class S>
  using Workspace = SymmetricMultistepWorkspace<S, order>;
  template <class S>
  static constexpr bool fits = [] {
    if constexpr (ConstrainedSystem<S>)
      return DormandPrince8::fits<ExplicitMultiplier<S>>;
    else
      return false;
  }();

  template <ConstrainedSystem S>
  static Status accepts(const S& system) {
    if (velocity_dependent(system) || dissipative(system) || time_dependent(system))
      return Status::failure(
          "symmetric multistep methods are for conservative forces that depend on the position alone; use explicit-8");
    return {};
  }

  /// One step. The velocity is left for `project_velocity`.
  template <ConstrainedSystem S>
  static Status advance(const S& system, double h, State<S>& state, Workspace<S>& w) {
    if (!same_step(h, w.h)) {
      if (Status status = restart(system, h, state, w); !status) return status;
    }
    ++w.counters.n_substeps;
    if (w.n_known < w.n_slots) return start_up<S>(state, w);
    if (Status status = ensure_acceleration(system, state, w); !status) return status;
    if (Status status = make_step(system, state, w); !status) return status;
    state.t += h;
    w.acceleration_known = false;
    return {};
  }

  template <ConstrainedSystem S>
  static Status project_velocity(const S& system, State<S>& state, Workspace<S>& w) {
    if (w.n_known < w.n_slots) return {};  // the starter's velocity, valid already
    if (Status status = ensure_acceleration(system, state, w); !status) return status;
    state.v = w.d[w.newest];
    scale(1 / w.h, state.v);
    axpy(w.h * formula.velocity[0], w.acceleration, state.v);
    for (int i = 1; i <= w.n_slots; ++i)  // slot of the state still holds a_{n−(k−1)}
      axpy(w.h * formula.velocity[i], w.a[(w.newest + w.n_slots - i) % w.n_slots], state.v);
    if constexpr (unconstrained<S>) return {};
    ++w.counters.n_projections;
    w.constraint.direction_known = false;
    return detail::meet_velocity_constraint(system, system.constraint_tolerance(), state.q, state.v, w.system,
                                            w.constraint, [&] { axpy(1.0, w.constraint.reaction, state.v); });
  }

 private:
  /// Steps that differ by the round-off of the sample times are the same.
  static bool same_step(double h, double h_before) { return std::abs(h - h_before) <= 1e-10 * std::abs(h); }

  template <class S>
  static Status restart(const S& system, double h, State<S>& state, Workspace<S>& w) {
    if (w.h != 0)
      if (Status status = project_velocity(system, state, w); !status) return status;
    w.h = h;
    w.n_known = w.n_multipliers = 0;
    w.acceleration_known = false;
    w.starter.acceleration_known = false;
    w.starter.h = 0;
    w.starter.q_rounding = w.q_rounding;
    w.starter.v_rounding = system.make_vector();
    w.multipliers.fill(system.make_multiplier());
    return {};
  }

  /// A step of the explicit method, from which the history is filled.
  template <class S>
  static Status start_up(State<S>& state, Workspace<S>& w) {
    if (Status status = w.field.acceleration(state.t, state.q, state.v, w.starter.system, w.a[w.newest]); !status)
      return status;
    w.q_start = state.q;
    w.q_rounding = w.starter.q_rounding;
    const double t_end = state.t + w.h;
    while (state.t != t_end)
      if (Status status = DormandPrince8::step(w.field, t_end, state, w.starter); !status) return status;
    w.newest = (w.newest + 1) % w.n_slots;
    w.d[w.newest] = (state.q - w.q_start) + (w.starter.q_rounding - w.q_rounding);
    w.q_rounding = w.starter.q_rounding;
    ++w.n_known;
    return {};
  }

  template <class S>
  static Status ensure_acceleration(const S& system, const State<S>& state, Workspace<S>& w) {
    if (w.acceleration_known) return {};
    if (Status status = system.force(state.t, state.q, state.v, w.system, w.acceleration); !status) return status;
    system.apply_inverse_mass(w.acceleration, w.acceleration);
    ++w.counters.n_force;
    w.acceleration_known = true;
    return {};
  }

  /// d_{n+1}, q_{n+1} with a_n from the extrapolated multiplier, and then from the one that makes g(q_{n+1}) = 0.
  /// Flattened: calls kept the temporaries of small systems in memory, a sixth of the step of an SL(3) body.
  template <class S>
  [[gnu::flatten]] static Status make_step(const S& system, State<S>& state, Workspace<S>& w) {
    auto& a = w.a[w.newest];
    a = w.acceleration;
    if constexpr (!unconstrained<S>) {
      w.q_start = state.q;
      w.constraint.direction_known = false;
      extrapolate_multiplier<S>(w);
      detail::set_reaction(system, w.q_start, w.multiplier, w.constraint);
      axpy(1.0, w.constraint.reaction, a);
    }
    typename S::Vector increment = sum_history<S>(w);
    add(1.0, increment, state.q, w.q_rounding);
    if constexpr (!unconstrained<S>) {
      const double per_shift = 1 / (w.h * w.h * formula.acceleration[0]);  // multiplier for a shift of q_{n+1}
      const auto apply = [&] {
        add(1.0, w.constraint.reaction, state.q, w.q_rounding);
        axpy(1.0, w.constraint.reaction, increment);
        axpy(per_shift, w.constraint.reaction, a);
        axpy(per_shift, w.constraint.delta, w.multiplier);
        ++w.counters.n_position_iterations;
      };
      if (Status status = detail::meet_position_constraint(system, system.constraint_tolerance(), state.q, w.q_start,
                                                           w.system, w.constraint, apply);
          !status)
        return status;
      record_multiplier<S>(w);
    }
    if (!std::isfinite(increment.squaredNorm())) return Status::failure("the force is not finite");
    w.newest = (w.newest + 1) % w.n_slots;
    w.d[w.newest] = increment;
    return {};
  }

  /// Σ_i α̂_i d_{n−i} + h² Σ_i β̂_i a_{n−i}.
  template <class S>
  static typename S::Vector sum_history(const Workspace<S>& w) {
    typename S::Vector sum = w.d[w.newest];
    scale(formula.difference[0], sum);
    axpy(w.h * w.h * formula.acceleration[0], w.a[w.newest], sum);
    for (int i = 1; i < w.n_slots; ++i) {
      const int slot = w.newest >= i ? w.newest - i : w.newest - i + w.n_slots;
      const double of_d = formula.difference[i], of_a = w.h * w.h * formula.acceleration[i];
      const double* d = w.d[slot].data();
      const double* a = w.a[slot].data();
      for (Eigen::Index k = 0; k < sum.size(); ++k) sum.data()[k] += of_d * d[k] + of_a * a[k];
    }
    return sum;
  }

  /// w.multiplier ← λ_n by the polynomial through the last ones.
  template <class S>
  static void extrapolate_multiplier(Workspace<S>& w) {
    constexpr double weights[5][4]{{}, {1}, {2, -1}, {3, -3, 1}, {4, -6, 4, -1}};
    w.multiplier = w.multipliers[0];
    if (w.n_multipliers == 0) return;
    scale(weights[w.n_multipliers][0], w.multiplier);
    for (int i = 1; i < w.n_multipliers; ++i) axpy(weights[w.n_multipliers][i], w.multipliers[i], w.multiplier);
  }
  template <class S>
  static void record_multiplier(Workspace<S>& w) {
    for (int i = 3; i > 0; --i) w.multipliers[i] = w.multipliers[i - 1];
    w.multipliers[0] = w.multiplier;
    w.n_multipliers = std::min(w.n_multipliers + 1, 4);
  }
};

struct Symmetric8 : SymmetricMultistep<Symmetric8Coefficients> {
  static constexpr const char* name = "symmetric-8";
  static constexpr const char* documentation =
      "explicit symmetric multistep method of order 8, one force a step, for conservative forces";
};
struct Symmetric12 : SymmetricMultistep<Symmetric12Coefficients> {
  static constexpr const char* name = "symmetric-12";
  static constexpr const char* documentation =
      "explicit symmetric multistep method of order 12, one force a step, for conservative forces";
};

}  // namespace pseudorigid::mechanics
