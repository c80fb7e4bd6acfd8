#pragma once
/// Viscoelastic branches at the Gauss points, and at the nodes for pictures. Branch b has the modulus μ_b and the
/// internal metric C_b. The sum Σ μ_b C_b⁻¹ at the Gauss points of a cell is extrapolated to the nodes by the Lagrange
/// polynomials on these points.

#include <vector>

#include "continuum/body/ball_body.h"
#include "materials/maxwell_branch.h"

namespace pseudorigid::continuum {

/// The sums Σ μ_b C_b⁻¹ and Σ μ_b over the branches b at each node of a cell of this rank. The first local direction is
/// the fastest index. Without branches, all results are zero.
std::vector<materials::BranchesAtPoint> branches_at_nodes(const BallBody& ball, const Vector& x, unsigned int cell);

/// The same sums at each Gauss point of the cell.
std::vector<materials::BranchesAtPoint> branches_at_points(const BallBody& ball, const Vector& x, unsigned int cell);

}  // namespace pseudorigid::continuum
