#pragma once
/// The stiffness of the ball about its rest x = X, cell by cell. The second variation of the stored energy, and of the
/// constraint if a multiplier carries a stress at rest (materials/rest_moduli.h), is that of
///
///   C_iJkL = ∂C(H)_iJ/∂H_kL + κ δ_iJ δ_kL,      K_(a,i)(b,k) = ∫ ∂_Jφ_a C_iJkL ∂_Lφ_b dX,
///
/// the last term that of the volumetric stabilisation (kernels/stored_energy.h).
///
/// With c^ik_de = w det(∂X/∂ξ) (∂ξ_d/∂X_J) C_iJkL (∂ξ_e/∂X_L) at the Gauss points, and ∂_dφ_a a product of
/// one-dimensional functions, K^ik_ab = Σ_de Σ_q c^ik_de ∂_dφ_a ∂_eφ_b is summed one direction after the other:
/// O(n⁷) operations for a cell of n³ nodes.

#include <Eigen/Core>
#include <array>
#include <vector>

#include "continuum/kernels/stored_energy.h"
#include "continuum/mesh/ball_space.h"
#include "materials/rest_moduli.h"

namespace pseudorigid::continuum {

struct RestElasticity {
  RestElasticity(const StoredEnergy& stored, bool incompressible);

  double operator()(int i, int J, int k, int L) const { return entries[27 * i + 9 * J + 3 * k + L]; }

  std::array<double, 81> entries;
  materials::RestModuli moduli;  ///< moduli of the law and of the stabilisation
};

class RestStiffness {
 public:
  RestStiffness(const BallSpace& space, const RestElasticity& elasticity);
  /// K of a cell; row and column 3·node + component, nodes as in BallSpace::cell_nodes.
  Eigen::MatrixXd cell_matrix(unsigned int cell) const;

 private:
  /// c^ik_de at the points, [6 pairs i ≤ k][9 pairs d, e].
  using PointCoefficients = std::array<std::array<Eigen::VectorXd, 9>, 6>;
  PointCoefficients coefficients(unsigned int cell) const;
  Eigen::MatrixXd contract(const std::array<Eigen::VectorXd, 9>& c) const;

  const BallSpace& space_;
  RestElasticity elasticity_;
  int n_;
  Eigen::MatrixXd values_, derivatives_;  ///< ℓ_i and ℓ_i' at the Gauss points, [point, node]
  /// Products of two functions of one direction at its points, [2·(first is a derivative) + (second is)](point, pair).
  std::array<Eigen::MatrixXd, 4> products_;
};

}  // namespace pseudorigid::continuum
