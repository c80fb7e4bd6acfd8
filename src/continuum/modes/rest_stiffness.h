#pragma once
/// The stiffness K of the ball about rest x = X, cell by cell. It is the second variation of the stored energy. The
/// linear map C is the tangent of the law at F = Id, and C(H) is its value for the displacement gradient H. If a
/// multiplier balances a stress at rest, C(H) includes the second variation of the constraint
/// (materials/rest_moduli.h).
///
///   C_iJkL = ∂C(H)_iJ/∂H_kL + κ δ_iJ δ_kL,      K_(a,i)(b,k) = ∫ ∂_Jφ_a C_iJkL ∂_Lφ_b dX,
///
/// with the basis functions φ_a. The last term of C_iJkL is due to the volumetric stabilisation
/// (kernels/stored_energy.h).
///
/// Let c^ik_de = w det(∂X/∂ξ) (∂ξ_d/∂X_J) C_iJkL (∂ξ_e/∂X_L) at the Gauss points with the weights w. The derivative
/// ∂_dφ_a is a product of one-dimensional functions. Therefore the sum K^ik_ab = Σ_de Σ_q c^ik_de ∂_dφ_a ∂_eφ_b is
/// computed one direction after the other. This takes O(n⁷) operations for a cell of n³ nodes.

#include <Eigen/Core>
#include <array>
#include <vector>

#include "continuum/kernels/stored_energy.h"
#include "continuum/mesh/ball_space.h"
#include "materials/rest_moduli.h"

namespace pseudorigid::continuum {

struct RestElasticity {
  RestElasticity(const StoredEnergy& stored, bool incompressible);

  /// The entry C_iJkL.
  double operator()(int i, int J, int k, int L) const { return entries[27 * i + 9 * J + 3 * k + L]; }

  std::array<double, 81> entries;
  materials::RestModuli moduli;  ///< moduli of the law and of the stabilisation
};

class RestStiffness {
 public:
  RestStiffness(const BallSpace& space, const RestElasticity& elasticity);
  /// K of a cell. The rows and columns are 3·node + component, with the order of nodes of BallSpace::cell_nodes.
  Eigen::MatrixXd cell_matrix(unsigned int cell) const;

 private:
  /// c^ik_de at the points: [pair i ≤ k][pair d, e].
  using PointCoefficients = std::array<std::array<Eigen::VectorXd, 9>, 6>;
  PointCoefficients coefficients(unsigned int cell) const;
  Eigen::MatrixXd contract(const std::array<Eigen::VectorXd, 9>& c) const;

  const BallSpace& space_;
  RestElasticity elasticity_;
  int n_;
  Eigen::MatrixXd values_, derivatives_;  ///< ℓ_i and ℓ_i' at the Gauss points, [point, node]
  /// Products of two one-dimensional functions at the Gauss points of one direction: [2 s + t](point, pair of nodes).
  /// The numbers s and t are 1 if the first and the second function is a derivative ℓ_i', and otherwise 0.
  std::array<Eigen::MatrixXd, 4> products_;
};

}  // namespace pseudorigid::continuum
