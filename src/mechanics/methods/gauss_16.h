#pragma once
/// Gauss collocation with 8 stages, of order 16, for q̈ = a(t, q, q̇). It is described in Hairer, Lubich, Wanner,
/// Geometric Numerical Integration, II.1 and IV.2. The computation of the stages in the lanes of SIMD vectors is an
/// idea of Antoñana, Alberdi, Makazaga and Murua. With the step h, the accelerations a_j of the stages, and the
/// coefficients c_i, b_j and A = (a_ij) of gauss_coefficients.h,
///
///   a_i = a(t + c_i h, q_i, v_i),   v_i = v + h Σ_j a_ij a_j,   q_i = q + h c_i v + h² Σ_j (A²)_ij a_j
///   v_{n+1} = v + h Σ_j b_j a_j,    q_{n+1} = q + h v + h² Σ_j b_j (1 − c_j) a_j
///
/// The method is symmetric. It is symplectic if the mass is constant and there is no constraint. Momenta that are
/// bilinear in q and v are conserved up to round-off if the stages are iterated to round-off. Examples are the angular
/// momentum J and the circulation Z of a body. Forces may depend on velocity and time and may dissipate energy. A
/// system with constraints g = 0 is integrated with its explicit multiplier (explicit_multiplier.h), so each step
/// satisfies g = 0 up to the error of the step. Every 32 steps, and before each sample, the state is projected. With
/// the mass M, G = Dg and multipliers δ and μ, the projection is
///
///   q ← q + M⁻¹Gᵀδ,   v ← v − M⁻¹D²(δ·g)(v),   then  v ← v + M⁻¹Gᵀμ.
///
/// The first change of v is the cotangent lift of the change of q. Therefore the angular momentum J does not change in
/// first order of δ.
///
/// The stages are found by iteration (gauss_iteration.h). The initial guess is extrapolated by the polynomial through
/// the stages of the last step. If the iteration does not converge, the step is made in two halves, which can be halved
/// again. A step is also halved if its estimated error exceeds `tolerance`, because the polynomial through its stages
/// then does not resolve the motion. The estimate uses the Legendre coefficients of highest order of this polynomial.
/// Their absolute values do not depend on the direction of time, so the halving preserves the symmetry of the method.
///
/// The coefficients and the sums for q and v have more than double precision. Let the stages be iterated to round-off,
/// and let the step resolve the motion. The errors of a step are then random and below the round-off of the state, and
/// momenta and energy do not drift. If the step does not resolve the motion, the energy has the error of the step. If
/// the stages are iterated to a tolerance, the momenta have the error of the iteration. The energy then has the errors
/// of the iteration and of the step. The tolerance of the iteration alone does not bound the error of the energy.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "mechanics/core/field_of.h"
#include "mechanics/core/stage_by_stage.h"
#include "mechanics/methods/rattle.h"

namespace pseudorigid::mechanics {

template <class S>
struct Gauss16Workspace {
  using Field = FieldOf<S>;
  using Vector = typename S::Vector;

  explicit Gauss16Workspace(const S& system)
      : system(field_of(system).make_workspace()),
        q_rounding(system.make_vector()),
        v_rounding(system.make_vector()),
        change(system.make_vector()),
        n_entries(static_cast<std::size_t>(q_rounding.size())),
        last(n_entries),
        stages(n_entries),
        sums(n_entries),
        scratch(GaussStages::n_scratch * n_entries) {}

  typename Field::Workspace system;
  /// Bound of the estimated error of a step. A step with a larger error is halved. The default halves only steps in
  /// which the polynomial does not resolve the motion.
  double tolerance = coarsest_tolerance;
  static constexpr double coarsest_tolerance = 1e-2;
  /// Largest number of successive halvings of a step. If the number is 0, a step fails if it does not converge or if
  /// its estimated error exceeds `tolerance`.
  int most_halvings = 40;
  /// Error of the accelerations at which the iteration on the stages ends. If this tolerance is 0, the iteration ends
  /// at the round-off of the accelerations divided by 4096.
  double iteration_tolerance = 0;
  Vector q_rounding, v_rounding;  // remainders of q and v, which are sums in extended precision
  Vector change;                  // temporary: acceleration at the state, or change of v in a projection
  std::size_t n_entries;
  std::vector<OfStages> last, stages, sums, scratch;  // `last` has the stages of the last step or part of a step
  GaussTables tables;
  double h_last = 0;      // size of the last step or part of a step; 0: there was none
  double scale = 0;       // largest acceleration in the first iteration of the last step or part of a step
  int n_halvings = 0;     // largest number of halvings in the last call of `advance`
  int n_unprojected = 0;  // number of calls of `advance` since the last projection
  Counters counters;

  /// Passes each member that a checkpoint must contain to `visit`.
  template <class Visit>
  void visit_memory(Visit&& visit) {
    if constexpr (requires { system.visit_memory(visit); }) system.visit_memory(visit);
    visit(q_rounding);
    visit(v_rounding);
    for (OfStages& stages_of_entry : last)
      for (double& a : stages_of_entry) visit(a);
    visit(tables.h);
    visit(h_last);
    visit(scale);
    visit(n_halvings);
    visit(n_unprojected);
  }
};

struct Gauss16 {
  static constexpr const char* name = "gauss-16";
  static constexpr const char* documentation =
      "Gauss collocation of order 16, eight stages side by side in vector lanes, symmetric; for any forces of small "
      "systems. Momenta are kept to round-off if Step is given, else to a part of Tolerance";
  static constexpr int order = 16;
  static constexpr int n_stages = gauss::n_stages;
  /// Returns the cost of a step, which the step search uses. The unit is the cost of one force evaluation.
  template <class S>
  static double forces_of_step(const S& system) {
    constexpr double n_iterations = 7;  // the number is 4 to 9, and depends on the tolerance and the system
    return n_iterations * cost_of_iteration(field_of(system));
  }

  /// Returns the permitted error e of the accelerations at the end of the iteration, for a run of length T = `end`.
  /// `tolerance` is the permitted error of the configuration. In measured runs with T = 100 and 3000, the energy fell
  /// at a rate of 1e-3 to 5e-2 times e|v|, with the velocity v. The systems were a pseudo-rigid body, a rigid body and
  /// the double pendulum. The error of the configuration was at most 0.03 e T². For the returned e, this error is less
  /// than a sixth of the tolerance.
  static double iteration_tolerance(double tolerance, double end) { return 5 * tolerance / (end * end); }

  /// The entry Method = auto considers this method only for systems that evaluate their stages in lanes.
  static constexpr bool for_stages_in_lanes = true;
  static constexpr bool symplectic = false, symmetric = true;
  static constexpr bool adaptive = false, chosen_by_auto = true;
  /// Largest hω for which the stages of an oscillation with frequency ω need at most a dozen iterations. The iteration
  /// converges for hω < 11, the inverse of the spectral radius of A.
  static constexpr double stability_limit = 4;

  template <class S>
  using Workspace = Gauss16Workspace<S>;
  /// True for systems with dense vectors whose force is not costly (has_costly_force). Large systems do not benefit
  /// from a method that stores eight accelerations and needs sixty force evaluations for a step.
  template <class S>
  static constexpr bool fits = [] {
    if constexpr (!ConstrainedSystem<S> && !SecondOrderField<S>)
      return false;
    else
      return VectorSpace<typename S::Vector>::dense && !has_costly_force<S>;
  }();

  /// Returns a failure for systems with internal variables (relaxation.h).
  template <class S>
  static Status accepts(const S& system) {
    if (relaxes(system)) return refuses_relaxation();
    return {};
  }

  /// Makes one step, and projects the state if 32 steps have been made since the last projection. Fails if the
  /// projection fails, if the stages cannot be found after all permitted halvings, or if h is not finite. The stages
  /// cannot be found if the force fails, for example.
  template <class S>
  static Status advance(const S& system, double h, State<S>& state, Workspace<S>& w) {
    // A step starts with one halving less than the last step, but with at least 0 and at most 2 halvings. In a violent
    // phase of the motion, this omits the trial of the whole step, which would probably fail.
    constexpr int most_expected = 2;  // small, because all parts of the step are halved at least n_expected times
    const int n_expected = std::clamp(w.n_halvings - 1, 0, most_expected);
    w.n_halvings = 0;
    if (Status status = advance_in_parts(system, {h, h, 0}, n_expected, state, w); !status) return status;
    constexpr int steps_between_projections = 32;
    if (++w.n_unprojected < steps_between_projections) return {};
    return project_velocity(system, state, w);
  }

  /// Projects position and velocity onto the constraints or the invariant manifold, if there are any. Fails if the
  /// projection fails.
  template <class S>
  static Status project_velocity(const S& system, State<S>& state, Workspace<S>& w) {
    w.n_unprojected = 0;
    if constexpr (ConstrainedSystem<S>) {
      if constexpr (unconstrained<S>)
        return {};
      else
        return project_with_momenta(system, state, w);
    } else if constexpr (ProjectedField<S>) {
      return system.project(state.q, state.v, w.system);
    }
    return {};
  }

 private:
  /// A step, or a part of a step that has been halved `depth` times. `outer_h` is the length of the whole step.
  struct Part {
    double outer_h, h;
    int depth;
  };

  /// Advances the state by one part of a step. If the part has been halved n_expected times or more and its stages are
  /// found, it is one step of the method. Otherwise it is made in two halves. Fails if the stages of a part are not
  /// found and the part must not be halved again. This is the case after w.most_halvings halvings, or if h is below the
  /// round-off of the time. Also fails if h is not finite.
  template <class S>
  static Status advance_in_parts(const S& system, Part part, int n_expected, State<S>& state, Workspace<S>& w) {
    const auto [outer_h, h, depth] = part;
    w.n_halvings = std::max(w.n_halvings, depth);
    if (depth >= n_expected) {
      bool found = false;
      Status status = step(system, outer_h, h, state, w, found);
      if (found) return {};
      const bool too_short = !(state.t + h / 2 != state.t);
      if (depth >= w.most_halvings || too_short) return why_not_found(system, std::move(status), part, state, w);
      if (!std::isfinite(h)) return Status::failure("the step is not finite");
    }
    for (int half = 0; half < 2; ++half)
      if (Status status = advance_in_parts(system, {outer_h, h / 2, depth + 1}, n_expected, state, w); !status)
        return status;
    return {};
  }

  /// Returns true if the two step sizes differ only by the round-off of the sample times.
  static bool same_step(double h, double h_before) { return std::abs(h - h_before) <= 1e-10 * std::abs(h); }

  template <class S>
  static GaussStages stages_of(double outer_h, const State<S>& state, Workspace<S>& w) {
    return {.n = static_cast<int>(w.n_entries),
            .t = state.t,
            .h = w.tables.h,
            .q = state.q.data(),
            .v = state.v.data(),
            .tables = &w.tables,
            .tolerance = w.iteration_tolerance,
            .outer_h = outer_h,
            .a = w.stages.data(),
            .sums = w.sums.data(),
            .scratch = w.scratch.data(),
            .scale = w.scale};
  }

  /// Makes the step of size h and sets `found` to true, if its stages are found and its estimated error is permitted.
  /// Otherwise the state does not change, and `found` remains false. Fails only if the force fails.
  template <class S>
  static Status step(const S& system, double outer_h, double h, State<S>& state, Workspace<S>& w, bool& found) {
    ++w.counters.n_substeps;
    const auto& field = field_of(system);
    if (!same_step(h, w.tables.h))
      w.tables.set_step(h);
    else if (w.tables.c[0] == 0)  // the memory has been restored, and it does not contain the tables
      w.tables.set_step(w.tables.h);
    GaussStages s = stages_of(outer_h, state, w);
    if (Status status = begin(field, state, w, s); !status) return status;
    if (Status status = solve_stages(field, s, w.system); !status) return status;
    w.counters.n_force += gauss::n_stages * s.n_iterations;
    found = s.converged && error_of(s) <= w.tolerance;
    if (!found) return {};
    add_sums(s, state, w);
    state.t += h;
    w.stages.swap(w.last);
    w.h_last = w.tables.h;
    w.scale = s.scale;
    return {};
  }

  /// Prepares the guess of the stages: the polynomial through the stages of the last step. At the first step, the guess
  /// is the acceleration at the state in all stages. The same guess is used if the step is at least 1.5 times as long
  /// as the last step, or has the opposite sign. Fails if this acceleration cannot be computed.
  template <class F>
  static Status begin(const F& field, const State<F>& state, auto& w, GaussStages& s) {
    constexpr double longest_look = 1.5;
    if (const double ratio = s.h / w.h_last; w.h_last != 0 && ratio > 0 && ratio < longest_look) {
      const double clean = rounded_ratio(ratio);
      if (clean != w.tables.ratio) w.tables.set_ratio(clean);
      s.last = w.last.data();
      return {};
    }
    ++w.counters.n_force;
    if (Status status = field.acceleration(state.t, state.q, state.v, w.system, w.change); !status) return status;
    for (std::size_t k = 0; k < w.n_entries; ++k) w.stages[k].fill(w.change.data()[k]);
    return {};
  }

  /// Returns 1 or a power of 2 if `ratio` differs from this number only by the round-off of the sample times, else
  /// `ratio`.
  static double rounded_ratio(double ratio) {
    if (same_step(ratio, 1)) return 1;
    const double power = std::exp2(std::round(std::log2(ratio)));
    return same_step(ratio, power) ? power : ratio;
  }

  /// Returns the estimated error of a step, 1000 s.tail^2.5. If the Legendre coefficients fall like ρᵏ with the order
  /// k, s.tail is about ρ^6.5 and the error is proportional to ρ^16. The factor 1000 was fitted to motions of an
  /// incompressible pseudo-rigid body.
  static double error_of(const GaussStages& s) { return 1e3 * s.tail * s.tail * std::sqrt(s.tail); }

  /// Returns the failure of the force at a stage or at the state. If the force does not fail, returns a failure with
  /// the reason that the stages cannot be found.
  template <class S>
  [[gnu::cold, gnu::noinline]] static Status why_not_found(const S& system, Status of_stages, const Part& part,
                                                           const State<S>& state, Workspace<S>& w) {
    if (!of_stages) return of_stages;
    const auto& field = field_of(system);
    if (Status status = field.acceleration(state.t, state.q, state.v, w.system, w.change); !status) return status;
    if (!std::isfinite(w.change.squaredNorm())) return Status::failure("the force is not finite");
    // The evaluation in lanes does not return a reason. The evaluation of the stages one by one does.
    for (std::size_t k = 0; k < w.n_entries; ++k) w.stages[k].fill(w.change.data()[k]);
    GaussStages again = stages_of(part.outer_h, state, w);
    if (Status status = solve_one_by_one(field, again, w.system); !status) return status;
    return Status::failure("the stages of a step cannot be found by iteration; use a smaller step");
  }

  /// Adds the increments to q and v in extended precision, and stores the remainders for the next step. In double
  /// precision, the round-off of h v and of the sums would make energy and momenta drift by 10⁻¹⁸ per step, in internal
  /// units.
  template <class S>
  static void add_sums(const GaussStages& s, State<S>& state, Workspace<S>& w) {
    using Real = gauss::Real;
    const auto split = [](Real x, double& high, double& low) {
      high = static_cast<double>(x);
      low = static_cast<double>(x - high);
    };
    for (std::size_t k = 0; k < w.n_entries; ++k) {
      const OfStages& sums = w.sums[k];
      double &q = state.q.data()[k], &v = state.v.data()[k];
      double &of_q = w.q_rounding.data()[k], &of_v = w.v_rounding.data()[k];
      const Real whole_v = Real(v) + of_v;
      split(Real(q) + of_q + (s.h * whole_v + sums[position] + sums[position_low]), q, of_q);
      split(whole_v + (Real(sums[velocity]) + sums[velocity_low]), v, of_v);
    }
  }

  /// Projects position and velocity by the formulas at the head of this file. The first change of v, the cotangent
  /// lift, is omitted if the system has no `add_reaction_rate`. Fails if the constraint or a Gram solve fails, or if
  /// one of the iterations does not converge.
  template <ConstrainedSystem S>
  static Status project_with_momenta(const S& system, State<S>& state, Workspace<S>& w) {
    ++w.counters.n_projections;
    auto& c = w.system.constraint;
    auto& of_system = w.system.system;
    c.direction_known = false;
    const double tolerance = system.constraint_tolerance();
    // A Newton iteration replaces the residual by its square times the curvature of g. A new residual is evaluated only
    // if this product may exceed the tolerance, for curvatures up to 10⁴.
    const double foregone = S::n_constraints == dynamic_constraints ? 0 : std::sqrt(1e-4 * tolerance);
    const auto move_position = [&] {
      if constexpr (requires { system.add_reaction_rate(state.q, state.v, c.delta, w.change); }) {
        scale(0.0, w.change);
        system.add_reaction_rate(state.q, state.v, c.delta, w.change);
        system.apply_inverse_mass(w.change, w.change);
        add(-1.0, w.change, state.v, w.v_rounding);
      }
      add(1.0, c.reaction, state.q, w.q_rounding);
      ++w.counters.n_position_iterations;
    };
    if (Status status = detail::meet_position_constraint(system, tolerance, state.q, state.q, of_system, c,
                                                         move_position, foregone);
        !status)
      return status;
    c.direction_known = false;
    return detail::meet_velocity_constraint(system, tolerance, state.q, state.v, of_system, c,
                                            [&] { add(1.0, c.reaction, state.v, w.v_rounding); });
  }
};

}  // namespace pseudorigid::mechanics
