#pragma once
/// The only part of the kernels that depends on the law: the operations at the quadrature points of a batch of cells,
/// between the derivatives of the shape functions and the sums over them. All laws are compiled in one file, without
/// the degree, and all degrees without the law. It holds the geometry that the law's stress reads (stress_points.h);
/// points are counted through all batches.
///
/// A tensor at every point is 9 · n_points numbers, entry (i, j) of point q at (3i + j) n_points + q. Wide vectors
/// cross this interface in memory only.

#include <cstddef>
#include <memory>

#include "continuum/kernels/quadrature_point.h"
#include "continuum/kernels/stored_energy.h"

namespace pseudorigid::continuum {

template <int n_lanes>
class PointLaw {
 public:
  using L = Lanes<n_lanes>;
  virtual ~PointLaw() = default;

  /// Allocates exactly so many points.
  virtual void reserve_points(std::size_t n_points) = 0;
  /// The next points, of the Jacobians ∂X/∂ξ and the weights on the reference cell.
  virtual void add_points(const L* jacobians, const double* unit_weights, int n_points) = 0;

  /// T ← −w ∂(W + U)/∂F (∂X/∂ξ)⁻ᵀ in the place of H = ∂x/∂ξ for points from the first; least ← the least of it, of
  /// det F and of the law's reserve, lane by lane.
  virtual void stress(std::size_t first, const double* unit_weights, int n_points, L* H, L& least) const = 0;
  /// elastic += Σ w W(F), volumetric += Σ w U(J)
  virtual void energy(const L* F, const L* weights, int n_points, L& elastic, L& volumetric) const = 0;
  /// The reserve of the law (materials/law_limits.h) at each point; infinite for a law without limits.
  virtual void reserve(const L* F, int n_points, L* reserve) const = 0;

  /// Bytes held for geometry.
  virtual std::size_t memory() const = 0;
};

/// For vectors of native_lanes or few_lanes.
template <int n_lanes>
std::unique_ptr<PointLaw<n_lanes>> make_point_law(const StoredEnergy& stored);

}  // namespace pseudorigid::continuum
