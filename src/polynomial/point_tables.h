#pragma once
/// Values at the points of a sector of fields that are sums of ball polynomials, and the reverse.
///
/// The sector is the ball cut by the coordinate planes that are symmetry planes of the motion. Its points are those of
/// one octant and their images R_m ξ under reflections at the other planes, the free ones. A function of parity c has
/// at an image the value (−1)^{c·m} times that at the point. So the functions of each parity are summed at the octant's
/// points, and a transform of the sums over the parities gives all images at once (transform_images), an eighth of the
/// work and memory if no plane is a symmetry plane.
///
/// The points of the octant are r_j ω_s, and φ_nlm = R_nl(r) Y_lm(ω). So sums over n come first, at the radii, then
/// those over l and m, in the directions (sum factorisation; Orszag 1980): with e_r = ω,
///
///   u_lm(r) = Σ_n c_nlm R_nl(r),   x = Σ_lm u_lm Y_lm,
///   ∇_ξ x = Σ_lm u′_lm Y_lm e_r + (u_lm/r)(∂_θY_lm e_θ + ∂_φY_lm e_φ/sin θ),   ∂x/∂X_k = ∂x/∂ξ_k / s_k.
///
/// For few functions at few points the direct sums are cheaper, from tables of the functions at the points.
///
/// The linear functions are left out of the sums for gradients, as theirs are constant: F, of which the affine part is
/// the largest, gets fewer rounding errors, and that of a body of degree 1 none.
///
/// A field is a value, or a derivative along a direction that is reflected with the point: ∂/∂ξ_k as it stands has a
/// further sign at images under a reflection of ξ_k, which is that of another parity (`shift`).

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "polynomial/ball_polynomials.h"
#include "polynomial/octant_quadrature.h"

namespace pseudorigid::polynomial {

/// Coefficients of one component of a field, of the functions of one parity.
struct Block {
  int component;
  Parity parity;
  int slot;                    ///< the parity in the free coordinates, bit b for the b-th of them
  int offset;                  ///< of its coefficients
  std::vector<int> functions;  ///< places among ball_polynomials(N)

  int n() const { return static_cast<int>(functions.size()); }
};

/// Content of a table for each function: its value; ∂/∂X_k; its value and the derivatives along e_θ and e_φ of the
/// surface.
enum class Fields { value, gradient, surface };

/// Points r_j ω_s of the octant, j n_directions + s, filled up to whole blocks with the last one.
struct PointGrid {
  std::vector<double> radii;
  std::vector<SurfacePoint> directions;

  int n_radii() const { return static_cast<int>(radii.size()); }
  int n_directions() const { return static_cast<int>(directions.size()); }
};

class PointTables {
 public:
  /// Tables of the functions of `blocks`, scaled to an ellipsoid (polynomial_space.h). `free_axes`: those without a
  /// symmetry plane.
  PointTables(int degree, Fields fields, const Eigen::Vector3d& semi_axes, const PointGrid& grid,
              const std::vector<int>& free_axes, const std::vector<Block>& blocks);

  /// Number of points of the octant, with padding.
  int stride() const { return stride_; }
  int shift(int field) const { return shift_[field]; }
  int n_fields() const { return static_cast<int>(shift_.size()); }
  /// Number of points of all images.
  int n_points() const { return n_images_ * stride_; }
  /// Numbers of all fields of so many components.
  std::size_t size(int n_components) const { return static_cast<std::size_t>(n_components) * n_fields() * n_points(); }
  /// Multiplications of a pass through a block.
  double n_multiplications(const Block& block) const;

  /// y: field f of component i at (i n_fields + f) n_points, from the coefficients c of the blocks.
  void evaluate(const std::vector<Block>& blocks, int n_components, const double* c, double* y) const;
  /// c ← c + the transposed map of y, which is changed.
  void add_transposed(const std::vector<Block>& blocks, int n_components, double* y, double* c) const;
  /// A field of a single function of a parity at the points of the octant, `stride` numbers.
  std::vector<double> row(const Block& block, int function, int field) const;

 private:
  /// Tables of one parity. A group is a pair (l, m), and the level s belongs to functions with n = l + 2s.
  struct Factors {
    std::vector<int> places;                             ///< places of the coefficients of a block among [level][group]
    std::array<std::vector<double>, 2> radial;           ///< [level][radius][group]: R′ and R/r, or R
    std::array<std::vector<double>, 3> angular;          ///< [group][direction], filled up to `width_`
    std::array<std::vector<double>, 3> from_directions;  ///< [direction][group]
    int n_groups = 0, n_filled = 0, n_levels = 0;
    std::array<std::vector<double>, 3> rows;  ///< [field]: [function][point], where the direct sums are cheaper
    int linear = -1,
        linear_field = 0;  ///< place of the linear function among the gradients, and of its field that is not zero
    double linear_gradient = 0;

    std::size_t size() const { return static_cast<std::size_t>(n_levels) * n_filled; }
  };
  using Groups = std::vector<std::pair<int, int>>;  ///< (l, m)
  void set_radial(const Block& block, const std::vector<BallPolynomial>& functions, const Groups& groups,
                  const PointGrid& grid, double scale, Factors& factors) const;
  void set_rows(const Block& block, Factors& factors) const;
  void set_linear(const Block& block, const std::vector<BallPolynomial>& functions, const Eigen::Vector3d& semi_axes,
                  Factors& factors) const;
  void set_angular(const Groups& groups, const PointGrid& grid, Factors& factors) const;
  void set_frames(const Eigen::Vector3d& semi_axes, const PointGrid& grid);
  /// Which of the radial factors a term has.
  int radial_of(int term) const { return fields_ == Fields::gradient && term > 0 ? 1 : 0; }
  bool is_constant() const { return fields_ == Fields::gradient && degree_ == 1; }
  void evaluate_octant(const Factors& factors, const double* c, double* const* y) const;
  void evaluate_sums(const Factors& factors, const double* c, double* const* y) const;
  void add_transposed_sums(const Factors& factors, const double* const* y, double* c) const;
  void add_transposed_octant(const Factors& factors, const double* const* y, double* c) const;

  std::size_t place(const Block& block, int field) const {
    return (static_cast<std::size_t>(block.component) * n_fields() + field) * n_points() +
           static_cast<std::size_t>(block.slot ^ shift_[field]) * stride_;
  }
  void transform(int n_components, double* y) const;

  Fields fields_;
  int degree_, n_radii_, n_directions_, width_, stride_, n_images_;
  std::vector<int> shift_;
  std::vector<double> frames_;  ///< [field][term][direction], of the gradient
  std::array<Factors, 8> factors_;
};

}  // namespace pseudorigid::polynomial
