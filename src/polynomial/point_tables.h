#pragma once
/// Values at the points of a sector of fields that are sums of ball polynomials, and the reverse.
///
/// The sector is the ball cut by the coordinate planes that are symmetry planes of the motion. Its points are those of
/// one octant and their images R_m ξ under reflections at the other planes, the free ones. A function of parity c has
/// at an image the value (−1)^{c·m} times that at the point. So a table of the octant serves all images: the functions
/// of each parity are summed at the octant's points, and a transform of the sums over the parities gives all images at
/// once (transform_images), an eighth of the work and memory where no plane is a symmetry plane.
///
/// A field is a value, or a derivative along a direction that is reflected with the point: ∂/∂ξ_k as it stands has a
/// further sign at images under a reflection of ξ_k, which is that of another parity (`shift`).

#include <array>
#include <cstddef>
#include <vector>

#include "polynomial/ball_polynomials.h"

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

class PointTables {
 public:
  /// `stride` points of the octant, `n_images` of each; `shift`: the slot's bits of each field.
  PointTables(int stride, int n_images, std::vector<int> shift);

  /// The rows of the functions of a parity: all fields of a function one after the other, `stride` numbers each.
  void set(Parity parity, std::vector<double> rows) { tables_[parity] = std::move(rows); }
  const std::vector<double>& rows(Parity parity) const { return tables_[parity]; }

  int stride() const { return stride_; }
  int shift(int field) const { return shift_[field]; }
  int n_fields() const { return static_cast<int>(shift_.size()); }
  /// Of all images.
  int n_points() const { return n_images_ * stride_; }
  /// Numbers of all fields of so many components.
  std::size_t size(int n_components) const { return static_cast<std::size_t>(n_components) * n_fields() * n_points(); }

  /// y: field f of component i at (i n_fields + f) n_points, from the coefficients c of the blocks.
  void evaluate(const std::vector<Block>& blocks, int n_components, const double* c, double* y) const;
  /// c ← c + the transposed map of y, which is changed.
  void add_transposed(const std::vector<Block>& blocks, int n_components, double* y, double* c) const;

 private:
  std::size_t place(const Block& block, int field) const {
    return (static_cast<std::size_t>(block.component) * n_fields() + field) * n_points() +
           static_cast<std::size_t>(block.slot ^ shift_[field]) * stride_;
  }
  void transform(int n_components, double* y) const;

  int stride_, n_images_;
  std::vector<int> shift_;
  std::array<std::vector<double>, 8> tables_;
};

}  // namespace pseudorigid::polynomial
