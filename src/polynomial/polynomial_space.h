#pragma once
/// The spaces of a polynomial body of degree N on a reference ball or ellipsoid X = S ξ, S = diag(s), ξ in the unit
/// ball:
///
///   x_i(X) = Σ_a q_ia φ_a(X) ∈ P_N,    ∫ρ φ_a φ_b dX = δ_ab     (the mass is the identity)
///   λ(X) = Σ_b λ_b ψ_b(X) ∈ P_{N−1},   ∫ψ_a ψ_b dX = δ_ab
///
/// with the ball polynomials of ball_polynomials.h, divided by √det S. If a coordinate plane is a symmetry plane of
/// the motion, x_i is odd in ξ_i and even in the other coordinates that are reflected, and λ is even in them: the other
/// functions are left out. All integrals are those of the whole body.
///
/// The coefficients of a position stand component by component, and in each component parity by parity. In internal
/// units, ρ = 1.

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "polynomial/point_tables.h"

namespace pseudorigid::polynomial {

/// A vector at every point: one row a point.
using PointValues = Eigen::MatrixX3d;

class PolynomialSpace {
 public:
  /// Degree 1 … 13. `reflect`: the symmetry planes ξ_i = 0 of the motion. `n_points`: q of the points of integration,
  /// in each direction of an octant; least_points(degree) unless given.
  PolynomialSpace(int degree, const std::array<bool, 3>& reflect,
                  const Eigen::Vector3d& semi_axes = Eigen::Vector3d::Ones(), std::optional<int> n_points = {});
  /// ⌈(N + 3)/2⌉: exact for quadratic functions of a motion, and for 3 more degrees (octant_quadrature.h).
  static int least_points(int degree) { return (degree + 4) / 2; }

  int degree() const { return degree_; }
  /// q
  int n_points_in_direction() const { return grid_.n_radii(); }
  const std::array<bool, 3>& reflect() const { return reflect_; }
  const Eigen::Vector3d& semi_axes() const { return semi_axes_; }
  /// Number of copies of the computed part: 1 for the whole body, 8 for an octant.
  int n_mirrors() const { return 8 / n_images_; }
  /// Reflections of the octant's points that make the computed part.
  int n_images() const { return n_images_; }

  int n_functions() const { return static_cast<int>(functions_.size()); }
  /// Sign of the orientation of an image relative to the octant: −1 for an odd number of reflections.
  double orientation(int image) const;

  int n_unknowns() const { return n_unknowns_; }
  int n_pressures() const { return n_pressures_; }
  const std::vector<Block>& blocks() const { return blocks_; }
  const std::vector<Block>& pressure_blocks() const { return pressure_blocks_; }

  /// ∂x_i/∂X_k at the points of integration, and values of ψ there.
  const PointTables& gradients() const { return gradients_; }
  const PointTables& pressures() const { return pressures_; }
  int n_points() const { return gradients_.n_points(); }
  /// Weights of the points of the computed part for integrals over the whole body; 0 if points are filled up.
  const std::vector<double>& weights() const { return weights_; }
  /// ξ of the points of integration.
  const std::vector<std::array<double, 3>>& points() const { return points_; }

  double volume() const { return volume_; }
  /// E₀ = ∫ρXXᵀ, diagonal.
  const Eigen::Vector3d& inertia() const { return inertia_; }

  /// Coefficients of x = c + A X, of as much as the symmetry admits.
  void set_affine(const Eigen::Matrix3d& A, const Eigen::Vector3d& c, Eigen::Ref<Eigen::VectorXd> x) const;
  /// The affine motion nearest in the mean: A = (∫ρ x Xᵀ) E₀⁻¹ and c = ∫ρx/M.
  Eigen::Matrix3d affine_part(const Eigen::Ref<const Eigen::VectorXd>& x) const;
  Eigen::Vector3d mean(const Eigen::Ref<const Eigen::VectorXd>& x) const;
  /// ∫ρ a bᵀ of two fields.
  Eigen::Matrix3d moment(const Eigen::Ref<const Eigen::VectorXd>& a, const Eigen::Ref<const Eigen::VectorXd>& b) const;
  /// Coefficients of the force ∫∇φ·… of the uniform stress P: f_ia = Σ_k P_ik ∫∂φ_a/∂X_k dX.
  void add_uniform_stress(const Eigen::Matrix3d& P, Eigen::Ref<Eigen::VectorXd> f) const;

  /// Position of the coefficient of a function of ball_polynomials(degree) in a component, −1 if it has none.
  int place(int component, int function) const { return places_[component][function]; }
  /// The same for a pressure function.
  int pressure_place(int function) const { return pressure_places_.front()[function]; }
  /// Values and gradients by X of all φ_a at X = S ξ.
  std::vector<Jet> functions_at(const std::array<double, 3>& xi) const;
  /// x, and ∂x/∂X, from functions_at.
  Eigen::Vector3d value(const std::vector<Jet>& functions, const Eigen::Ref<const Eigen::VectorXd>& x) const;
  Eigen::Matrix3d gradient(const std::vector<Jet>& functions, const Eigen::Ref<const Eigen::VectorXd>& x) const;
  /// The field at the points of integration.
  PointValues values_at_points(const Eigen::Ref<const Eigen::VectorXd>& x) const;
  /// Tables of the position and its derivatives along e_θ and e_φ (by ξ) at the surface points of the octant.
  PointTables surface_tables(int q) const;
  /// The same tables of the position alone.
  PointTables surface_values(int q) const;

 private:
  PointTables make_tables(Fields fields, const std::vector<Block>& blocks) const;
  std::vector<Block> make_blocks(int n_components, int degree, std::vector<std::vector<int>>& places, int& size) const;
  int linear_function(int axis) const;

  int degree_;
  PointGrid grid_;
  std::array<bool, 3> reflect_;
  Eigen::Vector3d semi_axes_, inertia_;
  double volume_;
  std::vector<int> free_axes_;
  int n_images_, n_unknowns_ = 0, n_pressures_ = 0;
  std::vector<BallPolynomial> functions_;
  std::vector<std::vector<int>> places_, pressure_places_;  ///< [component][function]
  std::vector<Block> blocks_, pressure_blocks_;
  PointTables gradients_, values_, pressures_;
  std::vector<std::array<double, 3>> points_;
  std::vector<double> weights_;
  Eigen::MatrixXd integrated_gradients_;  ///< [k][function]: ∫∂φ_a/∂X_k dX
};

}  // namespace pseudorigid::polynomial
