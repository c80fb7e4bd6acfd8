#pragma once
/// Linear damping: forces −C(q) v with C symmetric and positive semidefinite, such as viscosity and drag. The mass is
/// M, and the constraint g = 0 has the derivative G = Dg. Let r be the residual of an implicit step of size 2s at the
/// velocity v. The step ends with the velocity v + u. The correction u and the multiplier μ satisfy
///
///   (M + s C(q)) u + G(q)ᵀμ = M r,   G(q) u = 0.
///
/// On ker G this is P(1 + s M⁻¹C) u = P r with the projection P = 1 − M⁻¹Gᵀ(G M⁻¹Gᵀ)⁻¹G. The operator on the left is
/// symmetric and positive in the inner product ⟨x, y⟩ = xᵀM y, so conjugate gradients solve the equation. The
/// eigenvalues of the operator are between 1 and 1 + sγ, with the largest damping rate γ. From the lower bound, the
/// error of u is at most the residual. From the upper bound, the number of iterations grows like √(sγ). The implicit
/// step is stable for every γ.

#include <algorithm>
#include <limits>
#include <utility>

#include "mechanics/core/constrained_system.h"
#include "mechanics/core/constraint_newton.h"

namespace pseudorigid::mechanics {

/// A system that also computes its linear damping, f += −C(q) v. No other part of the force may depend on the velocity.
template <class S>
concept LinearlyDamped = ConstrainedSystem<S> && requires(const S s, const typename S::Vector v, typename S::Vector f) {
  s.add_damping(v, v, f);  // (q, v, f)
  s.apply_mass(v, f);      // f = M v
  s.add_taken(0.0, f);     // (energy, v): adds `energy` to the dissipated energy, which v contains
};

/// Temporaries of `solve_damping`. They are empty if the system has no linear damping or if `used` is false.
template <class S>
struct DampingTemporaries {
  DampingTemporaries(const S&, bool) {}
};
template <LinearlyDamped S>
struct DampingTemporaries<S> {
  explicit DampingTemporaries(const S& system, bool used)
      : residual(vector_if(used, system)),
        solution(residual),
        direction(residual),
        product(residual),
        force(residual),
        momentum(residual) {}

  typename S::Vector residual;  ///< r, set by the caller
  typename S::Vector solution;  ///< u
  typename S::Vector direction, product, force, momentum;
  long n_products = 0;  ///< number of products with C

 private:
  static typename S::Vector vector_if(bool used, const S& system) {
    return used ? system.make_vector() : typename S::Vector{};
  }
};

namespace detail {

/// x ← P x at the configuration q. Fails if the iteration for the constraint does not converge.
template <ConstrainedSystem S>
Status project_onto_tangent_space(const S& system, double tolerance, const typename S::Vector& q, typename S::Vector& x,
                                  typename S::Workspace& system_workspace, ConstraintTemporaries<S>& constraint) {
  if constexpr (unconstrained<S>)
    return {};
  else
    return meet_velocity_constraint(system, tolerance, q, x, system_workspace, constraint,
                                    [&] { axpy(1.0, constraint.reaction, x); });
}

}  // namespace detail

/// Sets w.solution to u for the residual r = w.residual. On return w.residual is the remaining residual. The iteration
/// ends when the remaining residual is at most `enough` or is round-off. It fails if a projection fails, if 2000
/// iterations are not enough, or if the operator is not positive. A long step backwards in time has an operator that is
/// not positive.
template <LinearlyDamped S>
Status solve_damping(const S& system, double s, const typename S::Vector& q, double enough,
                     typename S::Workspace& system_workspace, detail::ConstraintTemporaries<S>& constraint,
                     DampingTemporaries<S>& w) {
  constexpr int most_iterations = 2000;
  constexpr double part = 0.1;  // fraction of `enough` that projections may leave
  const auto project = [&](typename S::Vector& x) {
    return detail::project_onto_tangent_space(system, part * enough, q, x, system_workspace, constraint);
  };
  const auto squared = [&](const typename S::Vector& x) {
    system.apply_mass(x, w.momentum);
    return dot(x, w.momentum);
  };
  scale(0.0, w.solution);
  if (Status status = project(w.residual); !status) return status;
  const double round_off = 64 * std::numeric_limits<double>::epsilon() * max_norm(w.residual);
  const double sufficient = std::max(enough, round_off);
  w.direction = w.residual;
  double square = squared(w.residual);
  for (int i = 0; i < most_iterations; ++i) {
    if (max_norm(w.residual) <= sufficient) return {};
    scale(0.0, w.force);
    system.add_damping(q, w.direction, w.force);
    ++w.n_products;
    const double curvature = squared(w.direction) - s * dot(w.direction, w.force);
    if (!(curvature > 0)) break;
    system.apply_inverse_mass(w.force, w.product);
    if (Status status = project(w.product); !status) return status;
    scale(-s, w.product);
    axpy(1.0, w.direction, w.product);
    const double alpha = square / curvature;
    axpy(alpha, w.direction, w.solution);
    axpy(-alpha, w.product, w.residual);
    const double before = std::exchange(square, squared(w.residual));
    scale(square / before, w.direction);
    axpy(1.0, w.residual, w.direction);
  }
  return Status::failure("the velocity that the dissipation leaves is not found; use a smaller step");
}

}  // namespace pseudorigid::mechanics
