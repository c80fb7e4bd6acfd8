#pragma once
/// The workspace of RATTLE (rattle.h). A step begins at q_n and v_n, and the velocity after its first half step is
/// v_{n+1/2}. Λ is the multiplier times the length of the half steps in which it acts (rattle.h).

#include "mechanics/core/constrained_system.h"
#include "mechanics/core/constraint_newton.h"
#include "mechanics/core/damping.h"
#include "mechanics/core/second_order_field.h"
#include "mechanics/methods/multiplier_history.h"

namespace pseudorigid::mechanics {

/// Total numbers of steps, substeps, force evaluations, corrections of q, projections of v, and iterations of Gram
/// solvers. A composition counts each step of RATTLE as a substep. The methods explicit-8 and gauss-16 count each trial
/// as a substep.
struct Counters {
  long n_steps = 0, n_substeps = 0, n_force = 0, n_position_iterations = 0, n_projections = 0, n_gram_iterations = 0;
};

/// Returns a zero vector if sums of vectors are compensated (vector_space.h), otherwise an empty object.
template <class S>
typename S::Vector make_rounding(const S& system) {
  if constexpr (VectorSpace<typename S::Vector>::compensated)
    return system.make_vector();
  else
    return {};
}

/// Temporaries of the iteration on a force that depends on the velocity. The vectors are empty for other forces.
template <class S>
struct VelocityIteration {
  /// True if a solve for multipliers is costly, as for distributed vectors. Each iteration then starts from the sum of
  /// the reactions of all earlier iterations.
  static constexpr bool keeps_reactions = !unconstrained<S> && !VectorSpace<typename S::Vector>::dense;

  explicit VelocityIteration(const S& system)
      : half(vector_if(velocity_dependent(system), system)),
        before(vector_if(velocity_dependent(system), system)),
        free(vector_if(keeps_reactions && velocity_dependent(system), system)),
        reaction(vector_if(keeps_reactions && velocity_dependent(system), system)) {}

  typename S::Vector half;            // v_n in the first half step, v_{n+1/2} in the second half step
  typename S::Vector before;          // v_{n+1} of the previous iteration
  typename S::Vector free, reaction;  // v_{n+1} before the last projection; sum of the changes by all projections

 private:
  static typename S::Vector vector_if(bool wanted, const S& system) {
    return wanted ? system.make_vector() : typename S::Vector{};
  }
};

/// Multipliers of a step with a compliant constraint (rattle.h). They are empty for a rigid constraint.
template <class S>
struct ComplianceTemporaries {};
template <Compliant S>
struct ComplianceTemporaries<S> {
  explicit ComplianceTemporaries(const S& system) {
    if (!is_compliant(system)) return;
    g_start = g_end = mean = lambda = system.make_multiplier();
  }
  typename S::Multiplier g_start, g_end;  // g at both ends of a step
  typename S::Multiplier mean, lambda;    // (g_n + g_{n+1})/2 and λ
  bool g_known = false;                   // true if g_end belongs to the state
};

template <class S>
ComplianceTemporaries<S> make_compliance([[maybe_unused]] const S& system) {
  if constexpr (Compliant<S>)
    return ComplianceTemporaries<S>(system);
  else
    return {};
}

/// Temporaries, cached values and initial guesses of one integration.
template <ConstrainedSystem S>
struct RattleWorkspace {
  explicit RattleWorkspace(const S& system)
      : system(system.make_workspace()),
        acceleration(system.make_vector()),
        q_start(system.make_vector()),
        settling(system),
        damping(system, velocity_dependent(system)),
        q_rounding(make_rounding(system)),
        v_rounding(make_rounding(system)),
        constraint(system),
        impulse(system.make_multiplier()),
        history(system),
        compliance(make_compliance(system)),
        constraint_tolerance(system.constraint_tolerance()) {}

  typename S::Workspace system;
  typename S::Vector acceleration, q_start;  // M⁻¹f at the state (symmetric_multistep.h adds a reaction); q_n
  VelocityIteration<S> settling;
  [[no_unique_address]] DampingTemporaries<S> damping;
  typename S::Vector q_rounding, v_rounding;  // remainders of the compensated sums of q and v
  detail::ConstraintTemporaries<S> constraint;
  typename S::Multiplier impulse;  // Λ; after record_multiplier (rattle.h) the multiplier λ
  MultiplierHistory<S> history;
  [[no_unique_address]] ComplianceTemporaries<S> compliance;
  double constraint_tolerance;      // permitted |g|_∞ and |G v|_∞; by default system.constraint_tolerance()
  double pending_weight = 0;        // length of the last half step, if its reaction is not yet in v; otherwise 0
  double acceleration_time = 0;     // time at which `acceleration` was computed
  bool acceleration_known = false;  ///< true if `acceleration` belongs to the state
  bool begun = false;               ///< true after the first step of a damped system
  bool stiff = false;               ///< true if the fixed-point iteration is slow, so that linear systems replace it
  Counters counters;

  /// Passes each member that a checkpoint must contain to `visit`. A resumed run computes the other members again.
  template <class Visit>
  void visit_memory(Visit&& visit) {
    if constexpr (requires { system.visit_memory(visit); }) system.visit_memory(visit);
    history.visit_memory(visit);
    visit(pending_weight);
    if constexpr (Damped<S>) {
      visit(begun);
      visit(stiff);
      damping.preconditioner.visit_memory(visit);
    }
    if constexpr (VectorSpace<typename S::Vector>::compensated) {
      visit(q_rounding);
      visit(v_rounding);
    }
  }
};

}  // namespace pseudorigid::mechanics
