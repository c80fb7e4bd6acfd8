#pragma once
/// Self-gravity of a body of uniform density ρ, computed from its surface alone. For two points x and y of the surface,
/// let d = x − y. Let N be the outward area vector, N dξdη = n dS. Here n is the unit normal, dS the area element, and
/// ξ, η are coordinates of the surface. G is the gravitational constant. Because ∂_i∂_j(d_i d_j/|d|) = 6/|d|, the
/// energy is
///
///   E = −½Gρ² ∫∫ dV dV/|d| = (Gρ²/12) ∮∮ (d·N_x)(d·N_y)/|d|.
///
/// On a smooth surface d·N = O(|d|²), so the integrand is O(|d|³) near x = y. Gauss quadrature therefore needs no
/// special rules, and a pair of a point with itself adds 0. The mass in E is proportional to the volume V = ⅓∮x·N. A
/// discrete body keeps its volume V₀ only up to the discretisation error. Therefore E is replaced by
///
///   Ê = E (V₀/V)^{5/3},
///
/// which is equal to E if V = V₀ and does not change under dilations. The force of Ê has no component that only a
/// pressure could balance. The following derivative of Ê is exact for the sums over points:
///
///   ∂Ê/∂x_i = (V₀/V)^{5/3} (Gρ²/6) g_i − (5Ê/9V) N_i,    g_i = Σ_j [(N_i b + a N_j)/|d| − a b d/|d|³],
///   ∂Ê/∂N_i = (V₀/V)^{5/3} (Gρ²/6) h_i − (5Ê/9V) x_i,    h_i = Σ_j d b/|d|,        a = d·N_i, b = d·N_j,
///
/// Here d = x_i − x_j, and the area vectors N_i include the quadrature weights. The energy is Ê = (V₀/V)^{5/3} (Gρ²/12)
/// Σ_i e_i with e_i = Σ_j ab/|d| = N_i·h_i.
///
/// If the sources are also the targets, each pair is computed once. The terms of y at x then also give the terms of x
/// at y. If only a sector of the body is computed, the sources are the points of the sector and their mirror images.

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

namespace pseudorigid::gravity {

/// Points of a surface with their area vectors, which include the quadrature weights: [component][point].
struct SurfacePoints {
  std::array<std::vector<double>, 3> x, N;

  std::size_t size() const { return x[0].size(); }
  void add(const Eigen::Vector3d& point, const Eigen::Vector3d& area);
  Eigen::Vector3d point(std::size_t i) const { return {x[0][i], x[1][i], x[2][i]}; }
  Eigen::Vector3d area(std::size_t i) const { return {N[0][i], N[1][i], N[2][i]}; }
};

/// The sums e_i, g_i and h_i of the formulas above for every target i. The index j runs over all sources.
struct PairSums {
  std::vector<double> e;  ///< sums e_i = Σ_j ab/|d|
  std::array<std::vector<double>, 3> g, h;
};
/// Returns the sums for any targets and sources. The functions of this file for sums throw NoKernels if no build of the
/// kernels can be chosen (mechanics/core/kernel_builds.h).
PairSums sum_pairs(const SurfacePoints& targets, const SurfacePoints& sources);
/// Returns the sums for sources that are the targets and their mirror images. The reflections are x_c ↦ −x_c for each c
/// with mirrors[c] = true. Except within a block of SIMD lanes, the distance of a pair is computed once for both
/// points. The function therefore computes about half as many distances as `sum_pairs`.
PairSums sum_own_pairs(const SurfacePoints& points, const std::array<bool, 3>& mirrors);
/// Returns the total of the sums over two sets of sources, for the same targets.
PairSums add(const PairSums& more, PairSums sums);

/// A quantity of moving points with its time derivative.
template <class T>
struct Moving {
  T at, rate;
};
/// Returns the sums and their time derivatives for moving targets and sources.
Moving<PairSums> sum_pairs(const Moving<SurfacePoints>& targets, const Moving<SurfacePoints>& sources);

/// Returns the enclosed volume V = ⅓ Σ x·N.
double enclosed_volume(const SurfacePoints& points);

/// Sums over the targets. If the targets are distributed over several processes, the caller must add the totals of all
/// processes.
struct SurfaceTotals {
  double pairs = 0;   ///< sum Σ_i e_i of the pairs
  double volume = 0;  ///< enclosed volume V
};
/// Returns the sums over these targets, for the sums of pairs of the same targets.
SurfaceTotals totals(const SurfacePoints& targets, const PairSums& sums);

/// Returns the energy Ê of the part of the body with these targets. `strength` is Gρ², and `rest_volume` is the volume
/// V₀ of this part at rest. The result is not finite if the volume V is zero or negative.
double surface_energy(const SurfaceTotals& totals, double strength, double rest_volume);

/// The derivative of Ê with respect to the points and area vectors of the targets: [component][target]. The sources
/// must be the targets and, if only a sector is computed, also the images of the targets. The derivative includes the
/// motion of the sources.
struct SurfaceDerivative {
  std::array<std::vector<double>, 3> by_point, by_area;
};
/// Returns the derivative for these targets. `totals` are the sums over the targets of all processes.
SurfaceDerivative surface_derivative(const SurfacePoints& targets, const PairSums& sums, const SurfaceTotals& totals,
                                     double strength, double rest_volume);

/// Returns the sums over the targets and their time derivatives.
Moving<SurfaceTotals> totals(const Moving<SurfacePoints>& targets, const Moving<PairSums>& sums);

/// Returns the time derivative of surface_derivative: D²Ê applied to the rates of the points and of the area vectors.
SurfaceDerivative surface_derivative_rate(const Moving<SurfacePoints>& targets, const Moving<PairSums>& sums,
                                          const Moving<SurfaceTotals>& totals, double strength, double rest_volume);

/// Returns the potential φ(x) = −½Gρ ∮ (y − x)·N_y/|y − x| per mass, at points x on the surface or in the interior. A
/// source at the point x itself adds 0. `strength` is Gρ.
std::vector<double> potential_at(const std::vector<Eigen::Vector3d>& points, const SurfacePoints& sources,
                                 double strength);

}  // namespace pseudorigid::gravity
