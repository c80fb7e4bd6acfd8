#pragma once
/// Evaluation of sums of ball polynomials at the points of a sector, and the transposed map.
///
/// The sector is the part of the ball between the symmetry planes of the motion, which are coordinate planes. The other
/// coordinate planes are the free planes. The points of the sector are the points of one octant and their images R_m ξ.
/// R_m contains the reflections at the free planes whose bits are set in m. At the image, a function of parity c has
/// (−1)^{c·m} times its value at the point, with c·m the number of common bits. Therefore the functions of each parity
/// are summed at the points of the octant. A transform of these sums over the parities gives all images
/// (transform_images of dense_kernels.h). Without symmetry planes, this method needs an eighth of the work and memory
/// of direct sums.
///
/// The points of the octant are r_j ω_s, and φ_nlm = R_nl(r) Y_lm(ω) (ball_polynomials.h). Therefore the sums over n
/// are computed first, at the radii, and then the sums over l and m, in the directions (sum factorisation; Orszag
/// 1980). With the coefficients c_nlm, the semi-axes s_k and e_r = ω,
///
///   u_lm(r) = Σ_n c_nlm R_nl(r),   x = Σ_lm u_lm Y_lm,
///   ∇_ξ x = Σ_lm u′_lm Y_lm e_r + (u_lm/r)(∂_θY_lm e_θ + ∂_φY_lm e_φ/sin θ),   ∂x/∂X_k = ∂x/∂ξ_k / s_k.
///
/// For few functions at few points, direct sums with tables of the functions at the points take less time.
///
/// The sums for gradients omit the linear functions, whose gradients are constant. The gradient of the affine part is
/// added afterwards. This gradient is the largest part of F, so the rounding errors of the sums are small compared with
/// F. For a body of degree 1, each entry of F has only the rounding error of one product.
///
/// The fields of a table are functions or their derivatives. A derivative along e_r, e_θ or e_φ has the same sign at an
/// image as the function, because these directions are reflected with the point. The derivative ∂/∂ξ_k has an
/// additional change of sign at an image under a reflection of ξ_k. The signs of ∂/∂ξ_k at the images are therefore the
/// signs of another parity. The bits of `shift` are the bits in which the two parities differ.

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "polynomial/ball_polynomials.h"
#include "polynomial/octant_quadrature.h"

namespace pseudorigid::polynomial {

/// The coefficients of one component of a field that belong to the functions of one parity. Free axes are those without
/// a symmetry plane.
struct Block {
  int component;
  Parity parity;
  int slot;                    ///< parity in the free coordinates only: bit b is the bit of the b-th free axis
  int offset;                  ///< index of the first coefficient
  std::vector<int> functions;  ///< indices in ball_polynomials(N)

  int n() const { return static_cast<int>(functions.size()); }
};

/// The fields that a table has for each function. `value` is the function itself. `gradient` has the derivatives
/// ∂/∂X_k. `surface` has the function and its derivatives along e_θ and e_φ on the surface.
enum class Fields { value, gradient, surface };

/// The points r_j ω_s of the octant, with the index j n_directions + s. Tables repeat the last point up to a multiple
/// of `point_block` (dense_kernels.h).
struct PointGrid {
  std::vector<double> radii;
  std::vector<SurfacePoint> directions;

  int n_radii() const { return static_cast<int>(radii.size()); }
  int n_directions() const { return static_cast<int>(directions.size()); }
};

class PointTables {
 public:
  /// Tables of the functions of `blocks` at the points of `grid` and their images. The functions are scaled to an
  /// ellipsoid (polynomial_space.h). `free_axes` are the axes without a symmetry plane.
  PointTables(int degree, Fields fields, const Eigen::Vector3d& semi_axes, const PointGrid& grid,
              const std::vector<int>& free_axes, const std::vector<Block>& blocks);

  /// Number of points of the octant, including padding.
  int stride() const { return stride_; }
  /// Bits by which the sign of a field at the images differs from the parity of the function (head of this file).
  int shift(int field) const { return shift_[field]; }
  int n_fields() const { return static_cast<int>(shift_.size()); }
  /// Number of points of all images, including padding.
  int n_points() const { return n_images_ * stride_; }
  /// Number of entries of y in `evaluate`, for a vector field with n_components components.
  std::size_t size(int n_components) const { return static_cast<std::size_t>(n_components) * n_fields() * n_points(); }
  /// Number of multiplications in the sums of `evaluate` for a block.
  double n_multiplications(const Block& block) const;

  /// Computes the fields y at all points from the coefficients c of the blocks. Field f of component i is stored from
  /// y[(i n_fields + f) n_points] on.
  void evaluate(const std::vector<Block>& blocks, int n_components, const double* c, double* y) const;
  /// Adds the result of the transposed map for y to c. y has the order of `evaluate` and is overwritten. The entries of
  /// y at padding points must be 0.
  void add_transposed(const std::vector<Block>& blocks, int n_components, double* y, double* c) const;
  /// The field `field` of one function of a block at the points of the octant, with stride() entries. `function` is the
  /// index of the function in the block.
  std::vector<double> row(const Block& block, int function, int field) const;

 private:
  /// Tables of one parity. A group is a pair (l, m), and level s has the functions with n = l + 2s.
  struct Factors {
    std::vector<int> places;                     ///< [coefficient of a block]: its index in [level][group]
    std::array<std::vector<double>, 2> radial;   ///< R′ and R/r for gradients, otherwise R: [level][radius][group]
    std::array<std::vector<double>, 3> angular;  ///< Y_lm and derivatives: [group][direction], padded
    std::array<std::vector<double>, 3> from_directions;  ///< the entries of `angular` as [direction][group]
    /// Numbers of groups, of groups with padding up to a multiple of `point_block`, and of levels.
    int n_groups = 0, n_filled = 0, n_levels = 0;
    std::array<std::vector<double>, 3> rows;  ///< [field]: [function][point], for direct sums; empty with factored sums
    /// `linear` is the index of the linear function in the block, or −1 if there is none. `linear_field` is the index
    /// of the only component of its gradient that is not 0, and `linear_gradient` is this component.
    int linear = -1, linear_field = 0;
    double linear_gradient = 0;

    std::size_t size() const { return static_cast<std::size_t>(n_levels) * n_filled; }
  };
  using Groups = std::vector<std::pair<int, int>>;  ///< pairs (l, m) of the groups
  void set_radial(const Block& block, const std::vector<BallPolynomial>& functions, const Groups& groups,
                  const PointGrid& grid, double scale, Factors& factors) const;
  void set_rows(const Block& block, Factors& factors) const;
  void set_linear(const Block& block, const std::vector<BallPolynomial>& functions, const Eigen::Vector3d& semi_axes,
                  Factors& factors) const;
  void set_angular(const Groups& groups, const PointGrid& grid, Factors& factors) const;
  void set_frames(const Eigen::Vector3d& semi_axes, const PointGrid& grid);
  /// Index in Factors::radial for a term. It is 1 for the terms of a gradient along e_θ and e_φ, which contain R/r, and
  /// otherwise 0.
  int radial_of(int term) const { return fields_ == Fields::gradient && term > 0 ? 1 : 0; }
  /// True if the fields of the table are constant: the gradients of a body of degree 1.
  bool is_constant() const { return fields_ == Fields::gradient && degree_ == 1; }
  void evaluate_octant(const Factors& factors, const double* c, double* const* y) const;
  void evaluate_sums(const Factors& factors, const double* c, double* const* y) const;
  void add_transposed_sums(const Factors& factors, const double* const* y, double* c) const;
  void add_transposed_octant(const Factors& factors, const double* const* y, double* c) const;

  /// Index in y of the first value of `field`, for the component and the parity of a block.
  std::size_t place(const Block& block, int field) const {
    return (static_cast<std::size_t>(block.component) * n_fields() + field) * n_points() +
           static_cast<std::size_t>(block.slot ^ shift_[field]) * stride_;
  }
  /// Transforms the sums of each parity in y into the values at each image. The transform is symmetric, so the function
  /// also applies the transposed map. Without images it does nothing.
  void transform(int n_components, double* y) const;

  Fields fields_;
  int degree_, n_radii_, n_directions_, width_, stride_, n_images_;  ///< width_: number of directions with padding
  std::vector<int> shift_;
  std::vector<double> frames_;  ///< D_kt in ∂/∂X_k = Σ_t D_kt ∂_t for e_r, e_θ, e_φ: [k][t][direction]
  std::array<Factors, 8> factors_;
};

}  // namespace pseudorigid::polynomial
