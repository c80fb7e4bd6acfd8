#pragma once
/// The linear problem of small displacements u of a polynomial ball of degree N about rest. The matrices of the problem
/// are dense, for the whole ball, and separated by parity (parity_parts.h). With the potential energy V, the
/// constraints g_b and G = Dg, the displacements are in ker G, and the stiffness is
///
///   K = D²V − Σ_b λ_b D²g_b   at x = X, with the multiplier λ at rest.
///
/// The self-gravity of this problem is exact. The second variation of the energy of self-gravity at rest along u is
///
///   ρg Σ_nm (1 − 3/(2n + 1)) (∮(u·e) Y_nm dS)²,   n ≥ 1,   g = (4/3)πGρr     (continuum/modes/rest_problem.h).
///
/// e is the outward normal, the Y_nm are the orthonormal spherical harmonics, r is the radius, and G in the formula for
/// g is Newton's constant. This problem does not use the quadrature of gravity during a motion (body_gravity.h). If γ =
/// ρgr/μ with the shear modulus μ is large, the error of that quadrature in the highest harmonics exceeds the elastic
/// stiffness. This error mixed kinds of modes from γ = 400 on for N = 3, and from γ = 4000 on for N = 8.

#include <Eigen/Core>
#include <array>
#include <vector>

#include "polynomial/compressible_body.h"
#include "polynomial/incompressible_body.h"
#include "polynomial/parity_parts.h"
#include "polynomial/turns.h"

namespace pseudorigid::polynomial {

struct RestProblem {
  Eigen::MatrixXd stiffness;  ///< K of the whole ball, with self-gravity
  /// The rows of G, and then the six rigid motions. For a compressible body, there are no rows of G. All motions of the
  /// problem are orthogonal to these rows.
  Eigen::MatrixXd excluded;
  /// Indices of the coefficients and of the rows of `excluded` that belong to each parity.
  std::array<std::vector<int>, n_parities> unknowns, rows;

  Eigen::MatrixXd stiffness_of(Parity parity) const { return stiffness(unknowns[parity], unknowns[parity]); }
  /// An orthonormal basis of the motions of a parity that satisfy the constraints and are orthogonal to the rigid
  /// motions. Each column is a motion.
  Eigen::MatrixXd motions_of(Parity parity) const;
};

/// The integrals ∮(u·e) Y_nm dS and ∮u·∇Y_nm dS over the unit sphere, as rows that act on the coefficients of a
/// displacement u. The harmonic Y_nm has the row n² + n + m. The quadrature is exact.
struct SurfaceRows {
  Eigen::MatrixXd radial, tangential;
};
/// Returns the rows of all harmonics of degree n ≤ max_degree.
SurfaceRows surface_rows(const PolynomialSpace& space, int max_degree);

/// Sets `problem` to the problem of `body`. The space of `body` must be that of the whole ball, without symmetry
/// planes, and `turns` must be constructed from this space. `body` must not have self-gravity, because the function
/// adds it, with Newton's constant `gravity_constant` in units with ρ = r = 1. Fails if the body is not in equilibrium
/// at rest, or if the forces or the multiplier at rest cannot be computed.
mechanics::Status make_rest_problem(const IncompressibleBody& body, const Turns& turns, double gravity_constant,
                                    RestProblem& problem);
mechanics::Status make_rest_problem(const CompressibleBody& body, const Turns& turns, double gravity_constant,
                                    RestProblem& problem);

}  // namespace pseudorigid::polynomial
