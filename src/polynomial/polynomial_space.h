#pragma once
/// The spaces of a polynomial body of degree N. The reference body is a ball or an ellipsoid X = S ξ, with the
/// semi-axes s, S = diag(s) and ξ in the unit ball. The position x and the pressure λ of the constraint are
///
///   x_i(X) = Σ_a q_ia φ_a(X) ∈ P_N,    ∫ρ φ_a φ_b dX = δ_ab     (the mass is the identity)
///   λ(X) = Σ_b λ_b ψ_b(X) ∈ P_{N−1},   ∫ψ_a ψ_b dX = δ_ab
///
/// The φ_a and ψ_b are the functions of ball_polynomials.h, divided by √det S. If the coordinate plane ξ_i = 0 is a
/// symmetry plane of the motion, x_i is odd in ξ_i. The other components and λ are then even in ξ_i. The spaces omit
/// functions without this parity. All integrals are over the whole body.
///
/// The coefficients of a position are ordered by component, then by parity, and then by the index of the function in
/// ball_polynomials(N). All quantities are in internal units, in which the density ρ is 1.

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "polynomial/point_tables.h"

namespace pseudorigid::polynomial {

/// A vector field at the quadrature points, one row for each point.
using PointValues = Eigen::MatrixX3d;

class PolynomialSpace {
 public:
  /// `degree` is 1 … 13. `reflect[i]` is true if ξ_i = 0 is a symmetry plane of the motion. `n_points` is the number q
  /// of quadrature points in each direction of an octant. If `n_points` is empty, q is least_points(degree).
  PolynomialSpace(int degree, const std::array<bool, 3>& reflect,
                  const Eigen::Vector3d& semi_axes = Eigen::Vector3d::Ones(), std::optional<int> n_points = {});
  /// The number ⌈(N + 3)/2⌉ of points in each direction. With this number, integrals of polynomials of degree 2N + 3
  /// are exact (octant_quadrature.h).
  static int least_points(int degree) { return (degree + 4) / 2; }

  int degree() const { return degree_; }
  /// The number q of quadrature points in each direction of an octant.
  int n_points_in_direction() const { return grid_.n_radii(); }
  const std::array<bool, 3>& reflect() const { return reflect_; }
  const Eigen::Vector3d& semi_axes() const { return semi_axes_; }
  /// Number of copies of the computed sector in the body: 1 if the sector is the whole body, and 8 if it is an octant.
  int n_mirrors() const { return 8 / n_images_; }
  /// Number of images of the octant in the computed sector, including the octant itself.
  int n_images() const { return n_images_; }

  int n_functions() const { return static_cast<int>(functions_.size()); }
  /// The parity of a function: bit i is set if the function is odd in ξ_i.
  Parity parity(int function) const { return functions_[function].parity(); }
  /// Orientation of an image of the octant: −1 if the image is due to an odd number of reflections, otherwise 1.
  double orientation(int image) const;

  int n_unknowns() const { return n_unknowns_; }
  int n_pressures() const { return n_pressures_; }
  const std::vector<Block>& blocks() const { return blocks_; }
  const std::vector<Block>& pressure_blocks() const { return pressure_blocks_; }

  /// `gradients` has the tables of ∂x_i/∂X_k at the quadrature points. `pressures` has the tables of λ.
  const PointTables& gradients() const { return gradients_; }
  const PointTables& pressures() const { return pressures_; }
  int n_points() const { return gradients_.n_points(); }
  /// Quadrature weights of the points of the sector for integrals over the whole body. The weights of padding points
  /// are 0.
  const std::vector<double>& weights() const { return weights_; }
  /// The quadrature points ξ in the unit ball, including padding points.
  const std::vector<std::array<double, 3>>& points() const { return points_; }

  double volume() const { return volume_; }
  /// The diagonal of E₀ = ∫ρXXᵀ dX, which is a diagonal matrix.
  const Eigen::Vector3d& inertia() const { return inertia_; }

  /// Sets the coefficients of x = c + A X, and does not change coefficients of higher degree. Entries of A and c that
  /// do not have the symmetry of the sector are omitted.
  void set_affine(const Eigen::Matrix3d& A, const Eigen::Vector3d& c, Eigen::Ref<Eigen::VectorXd> x) const;
  /// The affine motion c + A X with the least mean square of the distance to x. `affine_part` returns A = (∫ρ x Xᵀ dX)
  /// E₀⁻¹, and `mean` returns c = (∫ρ x dX)/M with the mass M.
  Eigen::Matrix3d affine_part(const Eigen::Ref<const Eigen::VectorXd>& x) const;
  Eigen::Vector3d mean(const Eigen::Ref<const Eigen::VectorXd>& x) const;
  /// ∫ρ a bᵀ dX for two vector fields with the coefficients a and b.
  Eigen::Matrix3d moment(const Eigen::Ref<const Eigen::VectorXd>& a, const Eigen::Ref<const Eigen::VectorXd>& b) const;
  /// f ← f + the force ∫P∇φ dX of the uniform stress P: f_ia = Σ_k P_ik ∫∂φ_a/∂X_k dX.
  void add_uniform_stress(const Eigen::Matrix3d& P, Eigen::Ref<Eigen::VectorXd> f) const;

  /// Index of the coefficient of a function of ball_polynomials(degree) in a component, or −1 if the space omits the
  /// function.
  int place(int component, int function) const { return places_[component][function]; }
  /// Index of the coefficient of a pressure function, or −1 if the space omits the function.
  int pressure_place(int function) const { return pressure_places_.front()[function]; }
  /// Values of all φ_a at the point X = S ξ, and their gradients with respect to X.
  std::vector<Jet> functions_at(const std::array<double, 3>& xi) const;
  /// The position and ∂x/∂X at a point, for the coefficients x. `functions` is the result of functions_at for this
  /// point.
  Eigen::Vector3d value(const std::vector<Jet>& functions, const Eigen::Ref<const Eigen::VectorXd>& x) const;
  Eigen::Matrix3d gradient(const std::vector<Jet>& functions, const Eigen::Ref<const Eigen::VectorXd>& x) const;
  /// The field with the coefficients x at the quadrature points, one row for each point, including the padding points.
  PointValues values_at_points(const Eigen::Ref<const Eigen::VectorXd>& x) const;
  /// Tables of the position on the surface and of its derivatives along e_θ and e_φ, with respect to ξ. The points are
  /// octant_surface_points(q) and their images in the computed sector.
  PointTables surface_tables(int q) const;
  /// Tables of the position alone at the points of surface_tables(q).
  PointTables surface_values(int q) const;

 private:
  PointTables make_tables(Fields fields, const std::vector<Block>& blocks) const;
  /// The blocks of a field with n_components components and functions up to `degree`. Sets places[component][function]
  /// to the index of the coefficient, or to −1 for an omitted function. Sets `size` to the number of coefficients.
  std::vector<Block> make_blocks(int n_components, int degree, std::vector<std::vector<int>>& places, int& size) const;
  /// Index of the function that is a multiple of ξ_axis.
  int linear_function(int axis) const;

  int degree_;
  PointGrid grid_;
  std::array<bool, 3> reflect_;
  Eigen::Vector3d semi_axes_, inertia_;
  double volume_;
  std::vector<int> free_axes_;
  int n_images_, n_unknowns_ = 0, n_pressures_ = 0;
  std::vector<BallPolynomial> functions_;
  std::vector<std::vector<int>> places_, pressure_places_;  ///< indices of coefficients, [component][function]
  std::vector<Block> blocks_, pressure_blocks_;
  PointTables gradients_, values_, pressures_;
  std::vector<std::array<double, 3>> points_;
  std::vector<double> weights_;
  Eigen::MatrixXd integrated_gradients_;  ///< [k][function]: ∫∂φ_a/∂X_k dX
};

}  // namespace pseudorigid::polynomial
