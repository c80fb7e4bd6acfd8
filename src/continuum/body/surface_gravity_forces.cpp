#include "continuum/body/surface_gravity_forces.h"

#include <algorithm>
#include <array>
#include <functional>
#include <span>

#include "continuum/parallel/gather.h"
#include "continuum/parallel/ghost_values.h"
#include "continuum/parallel/ranks.h"

namespace pseudorigid::continuum {
namespace {

using Field = SurfaceInterpolation::Field;
/// Component c of w (a × b) at every point. w has a weight for each point.
std::vector<double> cross(const Field& a, const Field& b, int c, const std::vector<double>& w) {
  const int d = (c + 1) % 3, e = (c + 2) % 3;
  std::vector<double> product(w.size());
  for (std::size_t i = 0; i < w.size(); ++i) product[i] = w[i] * (a[d][i] * b[e][i] - a[e][i] * b[d][i]);
  return product;
}

/// The points with the numbers from `begin` to end − 1.
gravity::SurfacePoints points_of(const gravity::SurfacePoints& points, std::size_t begin, std::size_t end) {
  gravity::SurfacePoints part;
  for (std::size_t i = begin; i < end; ++i) part.add(points.point(i), points.area(i));
  return part;
}

/// The sums e, g and h of a point, and their derivatives.
using SumsOfPoint = std::array<double, 14>;

std::vector<SumsOfPoint> sums_of_points(const gravity::Moving<gravity::PairSums>& sums) {
  const auto& [at, rate] = sums;
  std::vector<SumsOfPoint> result;
  for (std::size_t i = 0; i < at.e.size(); ++i)
    result.push_back({at.e[i], at.g[0][i], at.g[1][i], at.g[2][i], at.h[0][i], at.h[1][i], at.h[2][i], rate.e[i],
                      rate.g[0][i], rate.g[1][i], rate.g[2][i], rate.h[0][i], rate.h[1][i], rate.h[2][i]});
  return result;
}

gravity::Moving<gravity::PairSums> from_sums_of_points(std::span<const SumsOfPoint> points) {
  gravity::Moving<gravity::PairSums> sums;
  auto& [at, rate] = sums;
  const std::array<std::vector<double>*, 14> parts{&at.e,      &at.g[0],   &at.g[1],   &at.g[2],   &at.h[0],
                                                   &at.h[1],   &at.h[2],   &rate.e,    &rate.g[0], &rate.g[1],
                                                   &rate.g[2], &rate.h[0], &rate.h[1], &rate.h[2]};
  for (std::size_t k = 0; k < parts.size(); ++k)
    for (const SumsOfPoint& of_point : points) parts[k]->push_back(of_point[k]);
  return sums;
}

}  // namespace

std::vector<SurfaceGravityForces::Entry> SurfaceGravityForces::entries_of(const gravity::SurfacePoints& points) {
  const auto& [x, N] = points;
  std::vector<Entry> entries;
  for (std::size_t i = 0; i < points.size(); ++i)
    entries.push_back({x[0][i], x[1][i], x[2][i], N[0][i], N[1][i], N[2][i]});
  return entries;
}

int n_gravity_points(const BallSpace& space, bool is_fluid) {
  const bool refined = space.mesh().triangulation().n_global_levels() > 1;
  return static_cast<int>(space.degree()) + (refined && !is_fluid ? 1 : 2);
}

SurfaceGravityForces::SurfaceGravityForces(double gravity_constant, const BallSpace& space, int n_points)
    : constant_(gravity_constant), space_(space), surface_(space, n_points) {
  rest_volume_ =
      sum_over_ranks(enclosed_volume(own_points(jets_at(space.reference_positions()))), space.communicator());
}

SurfaceInterpolation::Jets SurfaceGravityForces::jets_at(const Vector& x) const {
  const GhostValues of_x(x);
  return surface_.jets(x);
}

gravity::SurfacePoints SurfaceGravityForces::own_points(const Jets& x) const {
  gravity::SurfacePoints points{x.u, {}};
  for (int c = 0; c < 3; ++c) points.N[c] = cross(x.by_p, x.by_q, c, surface_.weights());
  return points;
}

gravity::SurfacePoints SurfaceGravityForces::own_rates(const Jets& x, const Jets& u) const {
  gravity::SurfacePoints rates{u.u, {}};
  for (int c = 0; c < 3; ++c) {
    rates.N[c] = cross(u.by_p, x.by_q, c, surface_.weights());
    std::ranges::transform(rates.N[c], cross(x.by_p, u.by_q, c, surface_.weights()), rates.N[c].begin(), std::plus());
  }
  return rates;
}

gravity::SurfacePoints SurfaceGravityForces::with_images(const std::vector<Entry>& points, const Signs& s) const {
  std::vector<Entry> entries = points;
  for (int c = 0; c < 3; ++c) {
    if (!space_.mesh().sector().reflect[c]) continue;
    const std::size_t n = entries.size();
    for (std::size_t i = 0; i < n; ++i) {
      Entry image = entries[i];
      for (double& component : image) component *= s[c];
      image[c] = -image[c];
      image[3 + c] = -image[3 + c];
      entries.push_back(image);
    }
  }
  gravity::SurfacePoints all;
  for (const auto& [x0, x1, x2, N0, N1, N2] : entries) all.add({x0, x1, x2}, {N0, N1, N2});
  return all;
}

gravity::SurfacePoints SurfaceGravityForces::sources(const gravity::SurfacePoints& own, const Signs& s) const {
  return with_images(gather_on_all(space_.communicator(), entries_of(own)), s);
}

gravity::PairSums SurfaceGravityForces::sums_at(const gravity::SurfacePoints& own) const {
  const gravity::PairSums sums = sum_own_pairs(own, space_.mesh().sector().reflect);
  if (n_ranks(space_.communicator()) == 1) return sums;
  const std::vector<Entry> others = gather_from_others(space_.communicator(), entries_of(own));
  return gravity::add(sum_pairs(own, with_images(others, {1, 1, 1})), sums);
}

gravity::Moving<gravity::PairSums> SurfaceGravityForces::sums_at(const gravity::Moving<gravity::SurfacePoints>& own,
                                                                 const Signs& s) const {
  const MPI_Comm communicator = space_.communicator();
  const gravity::Moving all{sources(own.at), sources(own.rate, s)};
  const std::size_t n_own = own.at.size(), n = n_ranks(communicator), rank = this_rank(communicator);
  if (n == 1) return sum_pairs(own, all);
  // The points of all ranks are the first sources, in the order of the ranks.
  const std::size_t n_points = all.at.size() / static_cast<std::size_t>(space_.mesh().sector().n_images());
  const std::size_t begin = rank * n_points / n, end = (rank + 1) * n_points / n;
  const auto part = sum_pairs(gravity::Moving{points_of(all.at, begin, end), points_of(all.rate, begin, end)}, all);
  const std::vector<SumsOfPoint> sums = gather_on_all(communicator, sums_of_points(part));
  const std::vector<int> offsets = counts_of_ranks(communicator, std::vector<char>(n_own)).offsets;
  return from_sums_of_points(std::span(sums).subspan(static_cast<std::size_t>(offsets[rank]), n_own));
}

gravity::SurfaceTotals SurfaceGravityForces::over_ranks(const gravity::SurfaceTotals& own) const {
  const auto [pairs, volume] = sum_over_ranks(std::array{own.pairs, own.volume}, space_.communicator());
  return {pairs, volume};
}

void SurfaceGravityForces::spread(const Jets& x, const gravity::SurfaceDerivative& derivative, Vector& f) const {
  const auto& [by_x, by_N] = derivative;
  Jets by_jets{by_x, {}, {}};
  for (int c = 0; c < 3; ++c) {
    by_jets.by_p[c] = cross(x.by_q, by_N, c, surface_.weights());
    by_jets.by_q[c] = cross(by_N, x.by_p, c, surface_.weights());
  }
  surface_.subtract_derivative(by_jets, f);
}

mechanics::Status SurfaceGravityForces::add(const Vector& x, Vector& f) const {
  const Jets at = jets_at(x);
  const gravity::SurfacePoints own = own_points(at);
  const gravity::PairSums sums = sums_at(own);
  const gravity::SurfaceTotals of_all = over_ranks(totals(own, sums));
  spread(at, surface_derivative(own, sums, of_all, constant_, rest_volume_), f);
  add_to_owners(f);
  const int n_images = space_.mesh().sector().n_images();
  return gravity::judge_energy(n_images * surface_energy(of_all, constant_, rest_volume_), constant_,
                               n_images * rest_volume_);
}

void SurfaceGravityForces::add_rate(const Vector& x, const Vector& u, const Signs& s, Vector& f) const {
  const Jets jets = jets_at(x), jet_rates = jets_at(u);
  const gravity::Moving own{own_points(jets), own_rates(jets, jet_rates)};
  const auto sums = sums_at(own, s);
  const auto [at, rate] = totals(own, sums);
  gravity::Moving of_all{over_ranks(at), over_ranks(rate)};
  for (int c = 0; c < 3; ++c)  // if u is odd, the rates of a point and of its image cancel in the totals
    if (space_.mesh().sector().reflect[c] && s[c] < 0) of_all.rate = {};
  spread(jets, surface_derivative_rate(own, sums, of_all, constant_, rest_volume_), f);
  gravity::SurfaceDerivative of_areas = surface_derivative(own.at, sums.at, of_all.at, constant_, rest_volume_);
  for (auto& component : of_areas.by_point) std::ranges::fill(component, 0.0);
  spread(jet_rates, of_areas, f);  // the area vectors also depend on x; they are bilinear in ∂x/∂ξ_p and ∂x/∂ξ_q
  add_to_owners(f);
}

double SurfaceGravityForces::energy(const Vector& x) const {
  const gravity::SurfacePoints own = own_points(jets_at(x));
  return surface_energy(over_ranks(totals(own, sums_at(own))), constant_, rest_volume_);
}

std::vector<double> SurfaceGravityForces::potential(const Vector& x, const std::vector<Eigen::Vector3d>& points) const {
  return potential_at(points, sources(own_points(jets_at(x))), constant_);
}

}  // namespace pseudorigid::continuum
