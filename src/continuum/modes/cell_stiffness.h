#pragma once
/// The stiffness K of the cells at the positions x. K is the second variation of the stored energy, minus λ times that
/// of the constraint, with the multiplier λ. The stress is P + ∂U/∂F with the stabilisation U
/// (kernels/stored_energy.h), and λ_h is the Kirchhoff pressure of λ. For the gradient H of a displacement, the tangent
/// is
///
///   C(H) = DP(F)[H] + D(∂U/∂F)[H] + λ_h F⁻ᵀHᵀF⁻ᵀ,   C_iJkL = ∂C(H)_iJ/∂H_kL,
///   K_(a,i)(b,k) = ∫ ∂_Jφ_a C_iJkL ∂_Lφ_b dX,
///
/// with the basis functions φ_a. At rest, F = Id. In an incompressible body, λ_h then balances the stress of the law
/// (materials/rest_moduli.h).
///
/// Let c_(id)(ke) = w det(∂X/∂ξ) (∂ξ_d/∂X_J) C_iJkL (∂ξ_e/∂X_L) at the Gauss points with the weights w. The derivative
/// ∂_dφ_a is a product of one-dimensional functions. Therefore the sum K^ik_ab = Σ_de Σ_q c_(id)(ke) ∂_dφ_a ∂_eφ_b over
/// the points q is computed one direction after the other. This takes O(n⁷) operations for a cell with n³ nodes.

#include <Eigen/Core>
#include <array>
#include <functional>

#include "continuum/kernels/local_kernels.h"
#include "continuum/kernels/stored_energy.h"
#include "continuum/mesh/ball_space.h"
#include "materials/rest_moduli.h"

namespace pseudorigid::continuum {

/// The 81 entries C_iJkL of the tangent at a point.
struct Tangent {
  double operator()(int i, int J, int k, int L) const { return entries[27 * i + 9 * J + 3 * k + L]; }
  /// Adds `factor` times another tangent.
  Tangent& add(double factor, const Tangent& other) {
    for (std::size_t n = 0; n < entries.size(); ++n) entries[n] += factor * other.entries[n];
    return *this;
  }

  std::array<double, 81> entries;
};

/// The tangent at F with the Kirchhoff pressure `lambda`, which is 0 for a compressible body.
Tangent tangent_at(const StoredEnergy& stored, const materials::Tensor<double>& F, double lambda);
/// The tangent F⁻ᵀHᵀF⁻ᵀ of the constraint, which λ_h multiplies.
Tangent tangent_of_constraint(const materials::Tensor<double>& F);
/// The tangent D(cof F)[H], which the pressure on the surface multiplies.
Tangent tangent_of_pressure(const materials::Tensor<double>& F);

/// The tangent of the undeformed body, and its elastic moduli. Both include the stabilisation.
struct RestElasticity {
  RestElasticity(const StoredEnergy& stored, bool incompressible);

  Tangent tangent;
  materials::RestModuli moduli;
};

/// A function that returns the tangent at a Gauss point of a cell with the deformation gradient F. The first local
/// direction is the fastest index of the points.
using TangentOfPoint = std::function<Tangent(int point, const materials::Tensor<double>& F)>;

/// The numbers c of a cell, with a row for each Gauss point. As a matrix with the rows (i, d) and the columns (k, e), c
/// is symmetric. The columns are its entries (r, s) with r ≤ s, by rows; `entry_of_c` returns the index for r = 3i + d
/// and s = 3k + e in any order.
using PointCoefficients = Eigen::Matrix<double, Eigen::Dynamic, StiffnessTangent::n_entries>;
constexpr int entry_of_c(int r, int s) { return r > s ? entry_of_c(s, r) : 9 * r - r * (r - 1) / 2 + s - r; }

class CellStiffness {
 public:
  explicit CellStiffness(const BallSpace& space);
  PointCoefficients coefficients(unsigned int cell, const Vector& x, const TangentOfPoint& tangent) const;
  /// K of a cell with the numbers c. The indices of the rows and columns are those of the other cell_matrix.
  Eigen::MatrixXd cell_matrix(const PointCoefficients& c) const;
  /// The diagonal of cell_matrix(c).
  Eigen::VectorXd diagonal(const PointCoefficients& c) const;
  /// K of a cell at the positions x. The indices of the rows and columns are 3·node + component, with the order of
  /// nodes of BallSpace::cell_nodes.
  Eigen::MatrixXd cell_matrix(unsigned int cell, const Vector& x, const TangentOfPoint& tangent) const {
    return cell_matrix(coefficients(cell, x, tangent));
  }

 private:
  /// The derivatives ∂x_i/∂ξ_d of the nodal positions x at the Gauss points of a cell: (point, 3i + d).
  using Gradients = Eigen::Matrix<double, Eigen::Dynamic, 9>;
  Gradients by_reference(unsigned int cell, const Vector& x) const;
  /// The n³×n³ matrix of the products of the components i and k: Σ_de Σ_q c_(id)(ke) ∂_dφ_a ∂_eφ_b.
  Eigen::MatrixXd contract(const PointCoefficients& c, int i, int k) const;

  const BallSpace& space_;
  int n_;
  Eigen::MatrixXd values_, derivatives_;  ///< Lagrange polynomials ℓ_i, and ℓ_i': (Gauss point, node)
  /// Products of two one-dimensional functions at the Gauss points of one direction: [2 s + t](point, b·n + a). The
  /// first function belongs to node a. It is the derivative ℓ_a' if s = 1, and ℓ_a if s = 0. The second function
  /// belongs to node b and is ℓ_b' if t = 1, and ℓ_b if t = 0.
  std::array<Eigen::MatrixXd, 4> products_;
};

}  // namespace pseudorigid::continuum
