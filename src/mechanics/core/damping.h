#pragma once
/// The implicit half step of a method with damping. Damping is a force F(q, v) = −∂R/∂v with a convex function R of v.
/// Examples are viscosity, drag and friction. The mass is M, and the constraint g = 0 has the derivative G = Dg. A step
/// of size 2s begins with an explicit half step to the velocity v_half, and ends with an implicit half step. Let f be
/// the total force, which includes F. The residual r of the half step at a velocity v satisfies
///
///   M r = M (v_half − v) + s f(q, v).
///
/// The velocity at the end of the step is v + u. The correction u and the multiplier μ satisfy
///
///   (M + s C) u + G(q)ᵀμ = M r,   G(q) u = 0,
///
/// with the symmetric and positive semidefinite operator C = ∂²R/∂v² at v. If F is linear in v, C depends only on q,
/// and v + u is the exact solution. For other forces, such as friction, u is the correction of Newton's method. The
/// function Ψ(v) = ½(v − v_half)ᵀM (v − v_half) + sR is convex, and M r is −∂Ψ/∂v up to forces that do not depend on v.
/// The function add_damping can also apply the operator S of the secant, which is defined by F(v) = F(0) − S v.
///
/// On ker G the equation is P(1 + s M⁻¹C) u = P r with the projection P = 1 − M⁻¹Gᵀ(G M⁻¹Gᵀ)⁻¹G. The operator on the
/// left is symmetric and positive in the inner product ⟨x, y⟩ = xᵀM y, so conjugate gradients solve the equation. The
/// eigenvalues of the operator are between 1 and 1 + sγ, with the largest damping rate γ. By the lower bound, the error
/// of u is at most the residual, both in the norm √(xᵀM x). By the upper bound, the number of iterations grows like
/// √(sγ). For bodies with few unknowns, a preconditioner reduces this number (damping_preconditioner.h). The implicit
/// half step is stable for every γ.

#include <algorithm>
#include <limits>
#include <utility>

#include "mechanics/core/constrained_system.h"
#include "mechanics/core/constraint_newton.h"
#include "mechanics/core/damping_preconditioner.h"
#include "mechanics/core/linearization.h"

namespace pseudorigid::mechanics {

/// A system that also applies the operators C and S at a state to a vector u. Forces other than the damping must not
/// depend on the velocity, because the implicit half step treats only the damping.
template <class S>
concept Damped = ConstrainedSystem<S> &&
    requires(const S s, const State<S> state, const typename S::Vector v, typename S::Vector f) {
  s.add_damping(state, v, Linearization::tangent, f);  // (state, u, kind, f): f += −C u, or f += −S u
  s.apply_mass(v, f);                                  // f = M v
  s.add_taken(0.0, f);                                 // (energy, v): adds `energy` to the entry of v that is the
                                                       // dissipated energy
};

/// Returns true if the damping is linear in v. A system without a member `damping_is_linear` must have linear damping.
template <class S>
bool damping_is_linear(const S& system) {
  if constexpr (requires { system.damping_is_linear(); }) return system.damping_is_linear();
  return true;
}

/// Temporaries of `solve_damping`. They are empty if the system has no damping or if `used` is false.
template <class S>
struct DampingTemporaries {
  DampingTemporaries(const S&, bool) {}
};
template <Damped S>
struct DampingTemporaries<S> {
  explicit DampingTemporaries(const S& system, bool used)
      : preconditioner(system, used),
        residual(vector_if(used, system)),
        solution(residual),
        direction(residual),
        force(residual),
        product(residual),
        momentum(residual),
        at_rest(residual) {}

  [[no_unique_address]] DampingPreconditioner<S> preconditioner;
  typename S::Vector residual;  ///< the residual r, or P r after the projection
  typename S::Vector solution;  ///< the correction u
  /// `direction` is the search direction p of conjugate gradients, and `force` is −C p with the damping operator C.
  /// `product` is first P T M r with the preconditioner T of damping_preconditioner.h, and then p
  /// multiplied by P(1 + s M⁻¹C). `momentum` is M x for a scalar product ⟨x, y⟩.
  typename S::Vector direction, force, product, momentum;
  typename S::Vector at_rest;  ///< f(q, 0), if `rest_known` is true (rattle_velocity.h)
  bool rest_known = false;
  /// Size of the round-off that the projection leaves in `residual`, in the maximum norm. Before the projection, r
  /// contains the forces along the reactions, such as the pressure of self-gravity, which may be much larger than P r.
  double round_off = 0;
  /// Number of products with C since a caller last set this number to 0. Products for the matrices of the
  /// preconditioner are included.
  long n_products = 0;

 private:
  static typename S::Vector vector_if(bool used, const S& system) {
    return used ? system.make_vector() : typename S::Vector{};
  }
};

namespace detail {

/// Tolerance of the projections, divided by the permitted residual `enough` of `solve_damping`.
inline constexpr double left_by_projections = 0.1;

/// Replaces x by P x at the configuration q, up to the residual |G x|_∞ ≤ `tolerance`. Does nothing without
/// constraints. Fails if a Gram solve fails or the iteration for the constraint does not converge.
template <ConstrainedSystem S>
Status project_onto_tangent_space(const S& system, double tolerance, const typename S::Vector& q, typename S::Vector& x,
                                  typename S::Workspace& system_workspace, ConstraintTemporaries<S>& constraint) {
  if constexpr (unconstrained<S>)
    return {};
  else
    return !is_constrained(system) ? Status()
                                   : meet_velocity_constraint(system, tolerance, q, x, system_workspace, constraint,
                                                              [&] { axpy(1.0, constraint.reaction, x); });
}

}  // namespace detail

/// Replaces r = w.residual by P r, and sets w.round_off. `enough` is at most the permitted residual of the following
/// call of `solve_damping`. Fails if a Gram solve fails or the iteration for the constraint does not converge.
template <Damped S>
Status project_residual(const S& system, const typename S::Vector& q, double enough,
                        typename S::Workspace& system_workspace, detail::ConstraintTemporaries<S>& constraint,
                        DampingTemporaries<S>& w) {
  w.round_off = 8 * std::numeric_limits<double>::epsilon() * max_norm(w.residual);
  return detail::project_onto_tangent_space(system, detail::left_by_projections * enough, q, w.residual,
                                            system_workspace, constraint);
}

namespace detail {

/// Runs conjugate gradients for `solve_damping` until |w.residual|_∞ is at most `sufficient`. On entry w.residual is
/// P r. Sets w.solution to u, and w.residual to the remaining residual. The tolerance of the projections is a
/// tenth of `enough`. The preconditioner is used if `preconditioned` is true. Fails if a projection fails, if
/// `most_iterations` products with C are not enough, or if 1 + s M⁻¹C is not positive.
template <Damped S>
Status conjugate_gradients(const S& system, double s, const State<S>& state, double enough, double sufficient,
                           bool preconditioned, int most_iterations, typename S::Workspace& system_workspace,
                           ConstraintTemporaries<S>& constraint, DampingTemporaries<S>& w) {
  const auto project = [&](typename S::Vector& x) {
    return project_onto_tangent_space(system, left_by_projections * enough, state.q, x, system_workspace, constraint);
  };
  const auto not_found = [] {
    return Status::failure("the velocity that the dissipation leaves is not found; use a smaller step");
  };
  const auto& conditioned = preconditioned ? w.product : w.residual;  // P T M r with the preconditioner, otherwise r
  scale(0.0, w.solution);
  double square = 0;  // the scalar product of `conditioned` with M r
  for (int i = 0; max_norm(w.residual) > sufficient; ++i) {
    if (i == most_iterations) return not_found();
    system.apply_mass(w.residual, w.momentum);
    if (preconditioned) {
      w.preconditioner.apply(w.momentum, w.product);
      if (Status status = project(w.product); !status) return status;
    }
    const double before = std::exchange(square, dot(conditioned, w.momentum));
    if (i == 0) {
      w.direction = conditioned;
    } else {
      scale(square / before, w.direction);
      axpy(1.0, conditioned, w.direction);
    }
    scale(0.0, w.force);
    system.add_damping(state, w.direction, Linearization::tangent, w.force);
    ++w.n_products;
    system.apply_mass(w.direction, w.momentum);
    const double curvature = dot(w.direction, w.momentum) - s * dot(w.direction, w.force);
    if (!(curvature > 0)) return not_found();
    system.apply_inverse_mass(w.force, w.product);
    if (Status status = project(w.product); !status) return status;
    scale(-s, w.product);
    axpy(1.0, w.direction, w.product);
    const double alpha = square / curvature;
    axpy(alpha, w.direction, w.solution);
    axpy(-alpha, w.product, w.residual);
  }
  return {};
}

}  // namespace detail

/// Sets w.solution to u for the projected residual P r = w.residual and the operator C at `state`. Call
/// project_residual first, with at most this `enough`. On return w.residual is the remaining residual. The iteration
/// ends when |w.residual|_∞ is at most the largest of `enough`, w.round_off and 64 ε |P r|_∞, with the round-off ε. The
/// function fails if P r is not finite, if a projection fails, if 2000 iterations are not enough, or if 1 + s M⁻¹C is
/// not positive. The last case occurs in a long step backwards in time, s < 0, and if a product with C is not finite.
template <Damped S>
Status solve_damping(const S& system, double s, const State<S>& state, double enough,
                     typename S::Workspace& system_workspace, detail::ConstraintTemporaries<S>& constraint,
                     DampingTemporaries<S>& w) {
  constexpr int most_iterations = 2000;
  // A comparison with NaN is false, so the iteration would take such a residual for a small one.
  if (!std::isfinite(dot(w.residual, w.residual))) return Status::failure("the damping force is not finite");
  const double round_off = 64 * std::numeric_limits<double>::epsilon() * max_norm(w.residual);
  const double sufficient = std::max({enough, w.round_off, round_off});
  if (max_norm(w.residual) <= sufficient) {
    scale(0.0, w.solution);
    return {};
  }
  const auto solve = [&](bool preconditioned, int most) {
    const long before = w.n_products;
    Status status = detail::conjugate_gradients(system, s, state, enough, sufficient, preconditioned, most,
                                                system_workspace, constraint, w);
    if (status) w.preconditioner.count(w.n_products - before);
    return status;
  };
  if (w.preconditioner.prepare(system, s, state, w.residual, w.n_products)) {
    if (solve(true, w.preconditioner.most_products())) return {};
    w.preconditioner.give_up(w.residual);
  }
  return solve(false, most_iterations);
}

}  // namespace pseudorigid::mechanics
