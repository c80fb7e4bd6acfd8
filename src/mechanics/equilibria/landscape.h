#pragma once
/// Interface between the search for critical points and a system of any size, in a chart or in constrained form. A
/// landscape consists of the potential energy V on N = {g = 0} with its derivatives, the mass M and the linear damping
/// C. With the position q, the velocity v, the force f and a multiplier λ, its functions are
///
///   ∇V,   g,   G = Dg,   H_L = ∇²V − Σ λ_k D²g_k,   M,   C = −∂f/∂v at v = 0.
///
/// The last argument of `gradient` and of the functions below it is the output, which the function resizes. G has one
/// row for each constraint. A function that returns a Status fails if its quantity cannot be computed.

#include <Eigen/Core>
#include <concepts>

#include "mechanics/core/status.h"

namespace pseudorigid::mechanics {

template <class L>
concept Landscape = requires(const L l, const Eigen::VectorXd q, Eigen::VectorXd x, Eigen::MatrixXd A) {
  { l.n_coordinates() } -> std::convertible_to<int>;
  { l.n_constraints() } -> std::convertible_to<int>;
  { l.periods() } -> std::convertible_to<Eigen::VectorXd>;  // period of each coordinate, or 0 if not periodic
  { l.potential(q) } -> std::convertible_to<double>;        // potential energy V
  { l.gradient(q, x) } -> std::same_as<Status>;             // gradient ∇V
  { l.constraint(q, x) } -> std::same_as<Status>;           // constraints g
  l.constraint_gradient(q, A);                              // derivative G of the constraints
  { l.hessian(q, x, A) } -> std::same_as<Status>;           // (q, λ) → H_L, the Hessian of V − λᵀg
  l.mass(q, A);                                             // mass matrix M
  { l.damping(q, A) } -> std::same_as<Status>;              // damping matrix C
};

}  // namespace pseudorigid::mechanics
