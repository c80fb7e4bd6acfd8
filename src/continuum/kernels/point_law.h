#pragma once
/// The only part of the kernels that knows the law: what happens at the quadrature points of a batch of cells between
/// the derivatives of the shape functions and the sums over them. All laws are compiled in one file, without the
/// degree, and all degrees without the law.
///
/// A tensor at every point is 9 · n_points numbers, entry (i, j) of point q at (3i + j) n_points + q. Wide vectors
/// cross this interface in memory only.

#include <memory>

#include "continuum/kernels/quadrature_point.h"
#include "continuum/kernels/stored_energy.h"

namespace pseudorigid::continuum {

template <int n_lanes>
class PointLaw {
 public:
  using L = Lanes<n_lanes>;
  using Point = QuadraturePoint<n_lanes>;
  virtual ~PointLaw() = default;

  /// T ← −w ∂(W + U)/∂F (∂X/∂ξ)⁻ᵀ in the place of H = ∂x/∂ξ; least ← the least of it, of det F and of the law's
  /// reserve, lane by lane.
  virtual void stress(const Point* points, int n_points, L* H, L& least) const = 0;
  /// elastic += Σ w W(F), volumetric += Σ w U(J)
  virtual void energy(const Point* points, int n_points, const L* H, L& elastic, L& volumetric) const = 0;
  /// The reserve of the law (materials/law_limits.h) at each point; infinite for a law without limits.
  virtual void reserve(const Point* points, int n_points, const L* H, L* reserve) const = 0;
};

/// For vectors of native_lanes or few_lanes.
template <int n_lanes>
std::unique_ptr<PointLaw<n_lanes>> make_point_law(const StoredEnergy& stored);

}  // namespace pseudorigid::continuum
