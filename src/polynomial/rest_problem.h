#pragma once
/// The linear problem of small displacements u of a polynomial ball about rest,
///
///   K u,   K = D²V − Σ_b λ_b D²g_b   at x = X with its multiplier λ,   on ker G,
///
/// as dense matrices of the whole ball, taken apart by parity (parity_parts.h).
///
/// Self-gravity at rest is exact: its second variation is ρg Σ (1 − 3/(2n + 1)) |∮(u·n) Y_nm dS|², g = (4/3)πGρr
/// (continuum/modes/parity_sector.h). The quadrature of gravity during a motion (body_gravity.h) is not used. Its error
/// in the highest harmonics exceeds the elasticity if γ = ρgr/μ is large: it mixed kinds of modes from γ = 400 on for
/// N = 3, and from 4000 on for N = 8.

#include <Eigen/Core>
#include <array>
#include <vector>

#include "polynomial/compressible_body.h"
#include "polynomial/incompressible_body.h"
#include "polynomial/parity_parts.h"
#include "polynomial/turns.h"

namespace pseudorigid::polynomial {

struct RestProblem {
  Eigen::MatrixXd stiffness;  ///< K with self-gravity
  Eigen::MatrixXd excluded;   ///< rows that are 0 on the motions of the problem: G and the rigid motions
  std::array<std::vector<int>, n_parities> unknowns, rows;  ///< of each parity, and of `excluded`

  Eigen::MatrixXd stiffness_of(Parity parity) const { return stiffness(unknowns[parity], unknowns[parity]); }
  /// Orthonormal columns: the motions of a parity that preserve volume and are orthogonal to the rigid ones.
  Eigen::MatrixXd motions_of(Parity parity) const;
};

/// Harmonics Y_nm of the sphere, n ≤ max_degree, at [n² + m + n]: rows ∮(u·n) Y_nm dS and ∮u·∇Y_nm dS of a displacement
/// u. The quadrature is exact.
struct SurfaceRows {
  Eigen::MatrixXd radial, tangential;
};
SurfaceRows surface_rows(const PolynomialSpace& space, int max_degree);

/// `body` is that of a ball without symmetry planes and without self-gravity, whose constant is `gravity_constant`.
/// Fails if it is in no equilibrium at rest.
mechanics::Status make_rest_problem(const IncompressibleBody& body, const Turns& turns, double gravity_constant,
                                    RestProblem& problem);
mechanics::Status make_rest_problem(const CompressibleBody& body, const Turns& turns, double gravity_constant,
                                    RestProblem& problem);

}  // namespace pseudorigid::polynomial
