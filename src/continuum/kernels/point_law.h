#pragma once
/// The part of the kernels that depends on the law: the operations at the quadrature points of a batch of cells. One
/// source file contains all laws, and the source files of the degrees do not depend on the laws. A law is therefore not
/// compiled again for each degree. The class PointLaw stores the geometry that the stress needs (stress_points.h). The
/// points of all batches have consecutive numbers. W + U is the stored energy (stored_energy.h). The weight w of a
/// point is its weight on the reference cell times det ∂X/∂ξ.
///
/// A tensor at n_points points has 9 · n_points numbers, with the entry (i, j) of point q at (3i + j) n_points + q.
/// SIMD vectors are passed only in memory.

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

  /// Allocates memory for n_points points, which is the number of points of all batches together.
  virtual void reserve_points(std::size_t n_points) = 0;
  /// Appends n_points points with the Jacobians ∂X/∂ξ and the weights `unit_weights` on the reference cell.
  virtual void add_points(const L* jacobians, const double* unit_weights, int n_points) = 0;

  /// Replaces H = ∂x/∂ξ by T = −w ∂(W + U)/∂F (∂X/∂ξ)⁻ᵀ at n_points points from number `first` on. Lowers each lane of
  /// `least` to the least det F and the least reserve of the law (materials/law_limits.h) in this lane.
  virtual void stress(std::size_t first, const double* unit_weights, int n_points, L* H, L& least) const = 0;
  /// elastic += Σ w W(F), volumetric += Σ w U(J)
  virtual void energy(const L* F, const L* weights, int n_points, L& elastic, L& volumetric) const = 0;
  /// Sets `reserve` to the reserve of the law (materials/law_limits.h) at each point. It is infinite for a law without
  /// limits.
  virtual void reserve(const L* F, int n_points, L* reserve) const = 0;

  /// Memory for the geometry in bytes.
  virtual std::size_t memory() const = 0;
};

/// Makes the implementation for the law of `stored`. n_lanes is native_lanes or few_lanes.
template <int n_lanes>
std::unique_ptr<PointLaw<n_lanes>> make_point_law(const StoredEnergy& stored);

}  // namespace pseudorigid::continuum
