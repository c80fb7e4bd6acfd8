/// The second derivative of the energy Ê of self-gravity as a matrix of displacements of the surface. Let z_i = (x_i,
/// N_i) be a point of the surface with its area vector, and s_i = (e_i, g_i, h_i) its sums over all sources
/// (gravity/surface_gravity.h). The sums depend on z_i and on the points z_j with their mirror images,
///
///   ds_i = A_i dz_i + Σ_j B_ij dz_j.
///
/// A_i is the derivative for fixed sources, without the source at the point itself. B_ij is the derivative with respect
/// to the source j and its images, in which the pair of the point i with itself is omitted. If a point moves, its
/// distance from itself remains 0. Therefore this pair does not contribute to the sum of the derivatives.

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "continuum/body/surface_gravity_forces.h"

namespace pseudorigid::continuum {
namespace {

using gravity::Moving, gravity::PairSums, gravity::SurfacePoints;

constexpr std::size_t n_components = 6;  ///< of (x, N)

SurfacePoints zeros(std::size_t n) {
  const std::vector<double> none(n);
  return {{none, none, none}, {none, none, none}};
}

std::vector<double>& component(SurfacePoints& points, int a) { return a < 3 ? points.x[a] : points.N[a - 3]; }

/// Adds the sums of one target of `from` to those of another target of `to`.
void add_sums(const PairSums& from, std::size_t of, PairSums& to, std::size_t at) {
  to.e[at] += from.e[of];
  for (int c = 0; c < 3; ++c) {
    to.g[c][at] += from.g[c][of];
    to.h[c][at] += from.h[c][of];
  }
}
void clear(PairSums& sums, std::size_t at) {
  sums.e[at] = 0;
  for (int c = 0; c < 3; ++c) sums.g[c][at] = sums.h[c][at] = 0;
}

/// Several copies of one point.
SurfacePoints copies(const SurfacePoints& points, std::size_t of, std::size_t n) {
  SurfacePoints result;
  for (std::size_t i = 0; i < n; ++i) result.add(points.point(of), points.area(of));
  return result;
}

/// The derivatives A_j of the sums of point j, with one target for each component of z_j. `sources` are unchanged after
/// the call.
PairSums own_derivatives(const SurfacePoints& points, std::size_t j, Moving<SurfacePoints>& sources) {
  Moving<SurfacePoints> targets{copies(points, j, n_components), zeros(n_components)};
  for (int a = 0; a < int{n_components}; ++a) component(targets.rate, a)[static_cast<std::size_t>(a)] = 1;
  // The source at the point itself is replaced by a distant source without area, which does not contribute.
  const Eigen::Vector3d x = sources.at.point(j), N = sources.at.area(j);
  for (int c = 0; c < 3; ++c) {
    sources.at.x[c][j] += 1 + 2 * x.norm();
    sources.at.N[c][j] = 0;
  }
  PairSums sums = sum_pairs(targets, sources).rate;
  for (int c = 0; c < 3; ++c) {
    sources.at.x[c][j] = x[c];
    sources.at.N[c][j] = N[c];
  }
  return sums;
}

/// The points without the first one.
SurfacePoints without_first(SurfacePoints points) {
  for (int a = 0; a < int{n_components}; ++a) component(points, a).erase(component(points, a).begin());
  return points;
}

/// The rates of the sums of all points if the source j and its images move, a column of B_ij for each point i. `moving`
/// has the source and then its images.
PairSums derivatives_by_source(const SurfacePoints& points, std::size_t j, const Moving<SurfacePoints>& moving) {
  PairSums rates = sum_pairs(Moving<SurfacePoints>{points, zeros(points.size())}, moving).rate;
  clear(rates, j);  // contains the pair of the point with itself
  const Moving<SurfacePoints> images{without_first(moving.at), without_first(moving.rate)};
  add_sums(sum_pairs(Moving<SurfacePoints>{copies(points, j, 1), zeros(1)}, images).rate, 0, rates, j);
  return rates;
}

}  // namespace

Eigen::MatrixXd SurfaceGravityForces::hessian(const Vector& x, const Signs& s,
                                              const std::vector<unsigned int>& entries) const {
  const Jets jets = jets_at(x);
  const SurfacePoints own = own_points(jets);
  const std::size_t n = own.size();
  const PairSums at = sums_at(own);
  const gravity::SurfaceTotals of_all = totals(own, at);
  gravity::SurfaceDerivative of_areas = surface_derivative(own, at, of_all, constant_, rest_volume_);
  for (auto& component : of_areas.by_point) std::ranges::fill(component, 0.0);
  Vector f = space_.make_vector();
  const auto derivative_by_entries = [&](const Jets& of, const gravity::SurfaceDerivative& derivative) {
    f = 0;
    spread(of, derivative, f);
    Eigen::VectorXd by_entries(static_cast<Eigen::Index>(entries.size()));
    for (std::size_t i = 0; i < entries.size(); ++i)
      by_entries[static_cast<Eigen::Index>(i)] = -f.local_element(entries[i]);
    return by_entries;
  };
  // Component a of the rate of z_j along the displacement k, for the displacements that move the point. The area
  // vectors are bilinear in ∂x/∂ξ_p and ∂x/∂ξ_q, so the matrix also contains the rates of the derivatives ∂N_i/∂x.
  std::vector<std::vector<std::pair<Eigen::Index, double>>> rates_of(n_components * n);
  const auto size = static_cast<Eigen::Index>(entries.size());
  Eigen::MatrixXd result(size, size);
  for (Eigen::Index k = 0; k < size; ++k) {
    Vector unit = space_.make_vector();
    unit.local_element(entries[static_cast<std::size_t>(k)]) = 1;
    const Jets jet_rates = jets_at(unit);
    result.col(k) = derivative_by_entries(jet_rates, of_areas);
    const std::vector<Entry> rates = entries_of(own_rates(jets, jet_rates));
    for (std::size_t j = 0; j < n; ++j)
      for (std::size_t a = 0; a < n_components; ++a)
        if (rates[j][a] != 0) rates_of[n_components * j + a].emplace_back(k, rates[j][a]);
  }
  bool is_odd = false;
  for (int c = 0; c < 3; ++c) is_odd = is_odd || (space_.mesh().sector().reflect[c] && s[c] < 0);
  Moving<SurfacePoints> all{sources(own), {}};
  all.rate = zeros(all.at.size());
  for (std::size_t j = 0; j < n; ++j) {
    const PairSums of_own = own_derivatives(own, j, all);
    const SurfacePoints images = with_images(entries_of(copies(own, j, 1)), {1, 1, 1});
    for (int a = 0; a < int{n_components}; ++a) {
      SurfacePoints unit = zeros(1);
      component(unit, a)[0] = 1;
      const Moving<SurfacePoints> moving{images, with_images(entries_of(unit), s)};
      PairSums rates = derivatives_by_source(own, j, moving);
      add_sums(of_own, static_cast<std::size_t>(a), rates, j);
      SurfacePoints rate_of_points = zeros(n);
      component(rate_of_points, a)[j] = 1;
      const Moving<SurfacePoints> points{own, rate_of_points};
      const Moving<PairSums> sums{at, rates};
      Moving<gravity::SurfaceTotals> moving_totals = totals(points, sums);
      if (is_odd) moving_totals.rate = {};  // the rates of a point and of its image cancel in the totals
      const Eigen::VectorXd column =
          derivative_by_entries(jets, surface_derivative_rate(points, sums, moving_totals, constant_, rest_volume_));
      for (const auto& [k, rate] : rates_of[n_components * j + static_cast<std::size_t>(a)])
        result.col(k) += rate * column;
    }
  }
  return result;
}

}  // namespace pseudorigid::continuum
