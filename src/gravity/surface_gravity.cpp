#include "gravity/surface_gravity.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>

#include "gravity/pair_kernels.h"

namespace pseudorigid::gravity {
namespace {

/// Returns the factor (V₀/V)^{5/3} of the energy E in Ê (surface_gravity.h), with the current volume V and the volume
/// V₀ = `rest_volume` at rest.
double gauge(const SurfaceTotals& totals, double rest_volume) { return std::pow(rest_volume / totals.volume, 5.0 / 3); }

}  // namespace

void SurfacePoints::add(const Eigen::Vector3d& point, const Eigen::Vector3d& area) {
  for (int c = 0; c < 3; ++c) {
    x[c].push_back(point[c]);
    N[c].push_back(area[c]);
  }
}

PairSums add(const PairSums& more, PairSums sums) {
  const auto add_to = [](std::vector<double>& to, const std::vector<double>& from) {
    std::ranges::transform(to, from, to.begin(), std::plus());
  };
  add_to(sums.e, more.e);
  for (int c = 0; c < 3; ++c) {
    add_to(sums.g[c], more.g[c]);
    add_to(sums.h[c], more.h[c]);
  }
  return sums;
}

namespace {
const PairKernels& pair_kernels() {
  static const PairKernels& kernels = *mechanics::choose_build(builds_of_pair_kernels()).table;
  return kernels;
}
}  // namespace

PairSums sum_pairs(const SurfacePoints& targets, const SurfacePoints& sources) {
  return pair_kernels().sum(targets, sources);
}

PairSums sum_own_pairs(const SurfacePoints& points, const std::array<bool, 3>& mirrors) {
  return pair_kernels().sum_own(points, mirrors);
}

Moving<PairSums> sum_pairs(const Moving<SurfacePoints>& targets, const Moving<SurfacePoints>& sources) {
  return pair_kernels().sum_moving(targets, sources);
}

double enclosed_volume(const SurfacePoints& points) {
  double sum = 0;
  for (std::size_t i = 0; i < points.size(); ++i) sum += points.point(i).dot(points.area(i));
  return sum / 3;
}

SurfaceTotals totals(const SurfacePoints& targets, const PairSums& sums) {
  return {std::accumulate(sums.e.begin(), sums.e.end(), 0.0), enclosed_volume(targets)};
}

double surface_energy(const SurfaceTotals& totals, double strength, double rest_volume) {
  return gauge(totals, rest_volume) * strength / 12 * totals.pairs;
}

mechanics::Status judge_energy(double energy, double strength, double rest_volume) {
  constexpr double excess = 1.05;
  const double of_ball = -0.6 * strength * std::cbrt(4 * std::numbers::pi / 3) * std::pow(rest_volume, 5.0 / 3);
  if (energy >= excess * of_ball) return {};  // a volume that is not positive has an energy that is not a number
  return mechanics::Status::failure("the surface passes through itself, and its self-gravity is not that of a body");
}

SurfaceDerivative surface_derivative(const SurfacePoints& targets, const PairSums& sums, const SurfaceTotals& totals,
                                     double strength, double rest_volume) {
  const double pair = gauge(totals, rest_volume) * strength / 6,
               dilation = 5 * surface_energy(totals, strength, rest_volume) / (9 * totals.volume);
  SurfaceDerivative derivative;
  for (int c = 0; c < 3; ++c)
    for (std::size_t i = 0; i < targets.size(); ++i) {
      derivative.by_point[c].push_back(pair * sums.g[c][i] - dilation * targets.N[c][i]);
      derivative.by_area[c].push_back(pair * sums.h[c][i] - dilation * targets.x[c][i]);
    }
  return derivative;
}

Moving<SurfaceTotals> totals(const Moving<SurfacePoints>& targets, const Moving<PairSums>& sums) {
  double growth = 0;
  for (std::size_t i = 0; i < targets.at.size(); ++i)
    growth += targets.rate.point(i).dot(targets.at.area(i)) + targets.at.point(i).dot(targets.rate.area(i));
  return {totals(targets.at, sums.at), {std::accumulate(sums.rate.e.begin(), sums.rate.e.end(), 0.0), growth / 3}};
}

SurfaceDerivative surface_derivative_rate(const Moving<SurfacePoints>& targets, const Moving<PairSums>& sums,
                                          const Moving<SurfaceTotals>& totals, double strength, double rest_volume) {
  const auto& [at, rate] = totals;
  const double growth = rate.volume / at.volume;
  const double pair = gauge(at, rest_volume) * strength / 6, pair_rate = -5.0 / 3 * growth * pair;
  const double dilation = 5 * surface_energy(at, strength, rest_volume) / (9 * at.volume),
               energy_rate = (pair * rate.pairs + pair_rate * at.pairs) / 2,
               dilation_rate = 5 * energy_rate / (9 * at.volume) - growth * dilation;
  SurfaceDerivative derivative;
  for (int c = 0; c < 3; ++c)
    for (std::size_t i = 0; i < targets.at.size(); ++i) {
      derivative.by_point[c].push_back(pair_rate * sums.at.g[c][i] + pair * sums.rate.g[c][i] -
                                       dilation_rate * targets.at.N[c][i] - dilation * targets.rate.N[c][i]);
      derivative.by_area[c].push_back(pair_rate * sums.at.h[c][i] + pair * sums.rate.h[c][i] -
                                      dilation_rate * targets.at.x[c][i] - dilation * targets.rate.x[c][i]);
    }
  return derivative;
}

std::vector<double> potential_at(const std::vector<Eigen::Vector3d>& points, const SurfacePoints& sources,
                                 double strength) {
  std::vector<double> potential;
  for (const Eigen::Vector3d& x : points) {
    double sum = 0;
    for (std::size_t j = 0; j < sources.size(); ++j) {
      const Eigen::Vector3d d = sources.point(j) - x;
      const double distance = d.norm();
      if (distance > 0) sum += d.dot(sources.area(j)) / distance;
    }
    potential.push_back(-strength / 2 * sum);
  }
  return potential;
}

}  // namespace pseudorigid::gravity
