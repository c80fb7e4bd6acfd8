#pragma once
/// Self-gravity of a body of uniform density ρ, computed from its surface alone. For two points x and y of the surface,
/// let d = x − y. Let N be the outward area vector, N dξdη = n dS. Here n is the unit normal, dS the current area
/// element, and ξ, η are coordinates of the surface. G is the gravitational constant. Because ∂_i∂_j(d_i
/// d_j/|d|) = 6/|d| (sum over i and j), the energy is
///
///   E = −½Gρ² ∫∫ dV dV/|d| = (Gρ²/12) ∮∮ (d·N_x)(d·N_y)/|d|.
///
/// On a smooth surface d·N = O(|d|²), so the integrand is O(|d|³) near x = y. Gauss quadrature therefore needs no
/// special rules, and a pair of a point with itself adds 0. The mass in E is proportional to the current volume
/// V = ⅓∮x·N. The volume of a discrete body differs from the volume V₀ at rest by the discretisation error. Therefore E
/// is replaced by
///
///   Ê = E (V₀/V)^{5/3},
///
/// which is equal to E if V = V₀. Ê does not change under dilations, so its force does no work in a dilation. If the
/// integrals are sums over points x_i with area vectors N_i, the derivative of Ê is exactly
///
///   ∂Ê/∂x_i = (V₀/V)^{5/3} (Gρ²/6) g_i − (5Ê/9V) N_i,    g_i = Σ_j [(N_i b + a N_j)/|d| − a b d/|d|³],
///   ∂Ê/∂N_i = (V₀/V)^{5/3} (Gρ²/6) h_i − (5Ê/9V) x_i,    h_i = Σ_j d b/|d|,        a = d·N_i, b = d·N_j.
///
/// Here d = x_i − x_j, and the area vectors N_i include the quadrature weights. The energy is Ê = (V₀/V)^{5/3} (Gρ²/12)
/// Σ_i e_i with e_i = Σ_j ab/|d| = N_i·h_i.
///
/// The points i for which sums are computed are the targets, and the points j in these sums are the sources. If the
/// sources are also the targets, each pair is computed once for both of its points. If only a sector of the body
/// between symmetry planes is computed, the sources are the points of the sector and their mirror images.

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

#include "mechanics/core/status.h"

namespace pseudorigid::gravity {

/// Points x of a surface with their area vectors N, which include the quadrature weights. The first index is the
/// component, and the second index the point.
struct SurfacePoints {
  std::array<std::vector<double>, 3> x, N;

  std::size_t size() const { return x[0].size(); }
  void add(const Eigen::Vector3d& point, const Eigen::Vector3d& area);
  Eigen::Vector3d point(std::size_t i) const { return {x[0][i], x[1][i], x[2][i]}; }
  Eigen::Vector3d area(std::size_t i) const { return {N[0][i], N[1][i], N[2][i]}; }
};

/// The sums e_i, g_i and h_i of the head of this file for every target i. The index j runs over all sources. The first
/// index of `g` and `h` is the component.
struct PairSums {
  std::vector<double> e;  ///< sums e_i = Σ_j ab/|d|
  std::array<std::vector<double>, 3> g, h;
};
/// Returns the sums for any targets and sources. The functions sum_pairs and sum_own_pairs throw NoKernels if this
/// process cannot choose a build of the kernels (mechanics/core/kernel_builds.h).
PairSums sum_pairs(const SurfacePoints& targets, const SurfacePoints& sources);
/// Returns the sums if the sources are the targets `points` and their mirror images. The images are those under all
/// combinations of the reflections x_c ↦ −x_c with mirrors[c] = true. Except within a block of SIMD lanes, the distance
/// of a pair is computed once for both points. The function therefore computes about half as many distances as
/// `sum_pairs`.
PairSums sum_own_pairs(const SurfacePoints& points, const std::array<bool, 3>& mirrors);
/// Returns `more` + `sums`, entry by entry: the sums over both of two sets of sources, for the same targets.
PairSums add(const PairSums& more, PairSums sums);

/// A quantity `at` of moving points, and its time derivative `rate`.
template <class T>
struct Moving {
  T at, rate;
};
/// Returns the sums and their time derivatives for moving targets and sources.
Moving<PairSums> sum_pairs(const Moving<SurfacePoints>& targets, const Moving<SurfacePoints>& sources);

/// Returns the enclosed volume V = ⅓ Σ x·N.
double enclosed_volume(const SurfacePoints& points);

/// Sums over targets. If the targets are distributed over several processes, each process computes the totals of its
/// targets, and the caller must add the totals of all processes.
struct SurfaceTotals {
  double pairs = 0;   ///< sum Σ_i e_i
  double volume = 0;  ///< part ⅓ Σ_i x_i·N_i of the enclosed volume V
};
/// Returns the totals of the given targets. `sums` are the sums of these targets over the sources.
SurfaceTotals totals(const SurfacePoints& targets, const PairSums& sums);

/// Returns the energy Ê of the part of the body to which the targets of `totals` belong: the whole body or a sector.
/// `strength` is Gρ², and `rest_volume` is the volume V₀ of this part at rest. The result is not finite if the volume V
/// is zero or negative.
double surface_energy(const SurfaceTotals& totals, double strength, double rest_volume);
/// Let E_b be the energy of the ball with the volume V₀ of a whole body at rest and with the radius R,
///
///   E_b = −(3/5)Gρ²V₀²/R,   4πR³/3 = V₀.
///
/// The function fails if the energy Ê of the body is below 1.05 E_b or not a number.
/// No body of this density has a lower energy than the ball (Riesz 1930). If Ê < 1.05 E_b, the surface passes through
/// itself. The sums count an overlap more than once, and Ê then has no lower bound. The factor 1.05 admits the error of
/// the quadrature. This error is at most 4 % for a ball with six faces and two points in each direction of a face.
mechanics::Status judge_energy(double energy, double strength, double rest_volume);

/// The derivative of Ê with respect to the positions and area vectors of the targets: [component][target]. The sources
/// must be the targets of all processes and, if only a sector is computed, also their images. The derivative takes into
/// account that the sources move with the targets.
struct SurfaceDerivative {
  std::array<std::vector<double>, 3> by_point, by_area;
};
/// Returns the derivative for the given targets. `totals` are the sums over the targets of all processes. `strength`
/// and `rest_volume` are those of surface_energy.
SurfaceDerivative surface_derivative(const SurfacePoints& targets, const PairSums& sums, const SurfaceTotals& totals,
                                     double strength, double rest_volume);

/// Returns the totals of the given targets and their time derivatives.
Moving<SurfaceTotals> totals(const Moving<SurfacePoints>& targets, const Moving<PairSums>& sums);

/// Returns the time derivative of surface_derivative: the second derivative of Ê, applied to the rates of the positions
/// and of the area vectors. The arguments are those of surface_derivative, with their rates.
SurfaceDerivative surface_derivative_rate(const Moving<SurfacePoints>& targets, const Moving<PairSums>& sums,
                                          const Moving<SurfaceTotals>& totals, double strength, double rest_volume);

/// Returns the potential φ(x) = −½Gρ ∮ (y − x)·N_y/|y − x| per mass at each of the given points x, on the surface or in
/// the interior. The sources y must cover the whole surface. A source at the point x itself adds 0. `strength` is Gρ.
std::vector<double> potential_at(const std::vector<Eigen::Vector3d>& points, const SurfacePoints& sources,
                                 double strength);

}  // namespace pseudorigid::gravity
