#pragma once
/// Self-gravity of a body of uniform density from its surface alone. With d = x − y and the area vectors N (outward,
/// N dξdη = n dS) of two points x and y of the surface, and ∂_i∂_j(d_i d_j/|d|) = 6/|d|,
///
///   E = −½Gρ² ∫∫ dV dV/|d| = (Gρ²/12) ∮∮ (d·N_x)(d·N_y)/|d|.
///
/// On a smooth surface d·N = O(|d|²), so the integrand is O(|d|³) where x and y meet, and Gauss points integrate it
/// without special rules; a point with itself adds 0. In E the mass grows with the volume V = ⅓∮x·N. A discrete body
/// keeps its volume only up to the error of its discretisation. For it E is replaced by
///
///   Ê = E (V₀/V)^{5/3},
///
/// which is equal to E if V = V₀ and does not change under dilations: its force has no part that only a pressure
/// could balance. The derivative of Ê, for the sums over points below, is exact:
///
///   ∂Ê/∂x_i = (V₀/V)^{5/3} (Gρ²/6) g_i − (5Ê/9V) N_i,    g_i = Σ_j (N_i b + a N_j)/|d| − a b d/|d|³,
///   ∂Ê/∂N_i = (V₀/V)^{5/3} (Gρ²/6) h_i − (5Ê/9V) x_i,    h_i = Σ_j d b/|d|,        a = d·N_i, b = d·N_j,
///
/// and the sum over j of the energy is e_i = N_i·h_i.
///
/// A pair serves both of its points: the terms of y at x also give those of x at y. If a body is computed in a part of
/// it, the sources are its points and their mirror images.

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

namespace pseudorigid::gravity {

/// Points of a surface with their area vectors, the weights of the quadrature included: [component][point].
struct SurfacePoints {
  std::array<std::vector<double>, 3> x, N;

  std::size_t size() const { return x[0].size(); }
  void add(const Eigen::Vector3d& point, const Eigen::Vector3d& area);
  Eigen::Vector3d point(std::size_t i) const { return {x[0][i], x[1][i], x[2][i]}; }
  Eigen::Vector3d area(std::size_t i) const { return {N[0][i], N[1][i], N[2][i]}; }
};

/// Σ_j over all sources at each target.
struct PairSums {
  std::vector<double> e;  ///< ab/|d|
  std::array<std::vector<double>, 3> g, h;
};
PairSums sum_pairs(const SurfacePoints& targets, const SurfacePoints& sources);
/// The same if the targets are the sources with their images under the reflections x_c ↦ −x_c of the true `mirrors`, at
/// half the work or less.
PairSums sum_own_pairs(const SurfacePoints& points, const std::array<bool, 3>& mirrors);
/// The sums over two sets of sources.
PairSums add(const PairSums& more, PairSums sums);

/// Quantities of moving points, and their rates.
template <class T>
struct Moving {
  T at, rate;
};
Moving<PairSums> sum_pairs(const Moving<SurfacePoints>& targets, const Moving<SurfacePoints>& sources);

/// V = ⅓ Σ x·N
double enclosed_volume(const SurfacePoints& points);

/// Sums over the targets. The sums of several processes are added before they are used.
struct SurfaceTotals {
  double pairs = 0;   ///< Σ_i e_i
  double volume = 0;  ///< V
};
SurfaceTotals totals(const SurfacePoints& targets, const PairSums& sums);

/// Ê of the targets' part of the body. `strength`: Gρ²; `rest_volume`: V₀ of that part.
double surface_energy(const SurfaceTotals& totals, double strength, double rest_volume);

/// The derivative of Ê by the targets' points and area vectors when the sources move with them: the sources are the
/// targets and, where a body is computed in a part of it, their images.
struct SurfaceDerivative {
  std::array<std::vector<double>, 3> by_point, by_area;
};
SurfaceDerivative surface_derivative(const SurfacePoints& targets, const PairSums& sums, const SurfaceTotals& totals,
                                     double strength, double rest_volume);

Moving<SurfaceTotals> totals(const Moving<SurfacePoints>& targets, const Moving<PairSums>& sums);

/// The rate of the derivative, D²Ê applied to the motion.
SurfaceDerivative surface_derivative_rate(const Moving<SurfacePoints>& targets, const Moving<PairSums>& sums,
                                          const Moving<SurfaceTotals>& totals, double strength, double rest_volume);

/// φ(x) = −½Gρ ∮ (y − x)·N_y/|y − x| for points x on the surface or within; `strength`: Gρ.
std::vector<double> potential_at(const std::vector<Eigen::Vector3d>& points, const SurfacePoints& sources,
                                 double strength);

}  // namespace pseudorigid::gravity
