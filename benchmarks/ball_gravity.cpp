/// What self-gravity costs in a step of the ball by symmetric-4, and how fast its sums over pairs of surface points
/// are.
///
///   ball_gravity DEGREE REFINEMENTS [STEPS]
///
/// The octant is released with the velocity 0.3 (x, y, −2z), neo-Hookean, μ = ρ = r = 1, γ = 5, and moves with 0.8 of
/// the stability limit; steps meet the constraint to 1e-9. One line of CSV (and a header): degree, refinements,
/// unknowns, points (in a direction of a face), targets, sources (their images included), gravity_s (of one evaluation,
/// with the geometry), pairs_s (the sums over pairs alone, each of which serves both its points), step_s, share (of
/// gravity in a step), flops_per_s (of the pairs, counted as 45 a target and source), lanes and fma_per_s (the
/// machine's limit, two operations each). Times are medians of processor time; STEPS (default 40) are taken after 10
/// that are not timed.

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <numbers>
#include <vector>

#include "continuum/body/elastic_ball.h"
#include "machine_limits.h"
#include "measuring.h"
#include "mechanics/methods/methods.h"
#include "mechanics/steps/largest_frequency.h"

namespace {

using namespace pseudorigid;
using benchmarks::require;
using continuum::ElasticBall;

constexpr double flops_of_a_pair = 45;

double median_seconds(int n, const std::function<void()>& work) {
  std::vector<double> times;
  for (int i = 0; i < n; ++i) times.push_back(benchmarks::cpu_seconds(work));
  return benchmarks::median(std::move(times));
}

/// Points on an octant of the sphere; their places do not matter for the time.
gravity::SurfacePoints points_on_an_octant(std::size_t n) {
  gravity::SurfacePoints points;
  for (std::size_t i = 0; i < n; ++i) {
    const double z = 1 - (2.0 * static_cast<double>(i) + 1) / static_cast<double>(n), s = std::sqrt(1 - z * z),
                 angle = 2.399963229728653 * static_cast<double>(i);
    const Eigen::Vector3d x(s * std::abs(std::cos(angle)), s * std::abs(std::sin(angle)), std::abs(z));
    points.add(x, x);
  }
  return points;
}

void run(int degree, int n_refinements, int n_steps) {
  loads::Loads loads;
  loads.get<loads::SelfGravity>().constant = 15 / (4 * std::numbers::pi);
  const ElasticBall ball(continuum::Sector{{true, true, true}}, degree, n_refinements, materials::CiarletGeymonat{1, 0},
                         loads);
  const Eigen::Matrix3d velocity = Eigen::Vector3d(0.3, 0.3, -0.6).asDiagonal();
  mechanics::State<ElasticBall> state{0, ball.affine_field(Eigen::Matrix3d::Identity()), ball.affine_field(velocity)};
  using Method = mechanics::Symmetric4;
  Method::Workspace<ElasticBall> w(ball);
  w.constraint_tolerance = 1e-9 * ball.multiplier_scale();
  const auto frequency = mechanics::largest_frequency(ball, state, w.system, 24);
  require(frequency.status);
  const double h = 0.8 * Method::stability_limit / frequency.omega;
  const auto step = [&] { require(Method::advance(ball, h, state, w)); };
  for (int i = 0; i < 10; ++i) step();
  const double step_s = median_seconds(n_steps, step);

  auto f = ball.make_vector();
  const double gravity_s = median_seconds(15, [&] { require(ball.gravity()->add(state.q, f)); });
  const int n_points = continuum::n_gravity_points(ball.space(), false);
  const std::size_t n_targets = continuum::free_surface(ball.space()).size() * n_points * n_points,
                    n_sources = 8 * n_targets;
  const gravity::SurfacePoints targets = points_on_an_octant(n_targets);
  const double pairs_s = median_seconds(15, [&] { sum_own_pairs(targets, {true, true, true}); });
  const benchmarks::MachineLimits limits = benchmarks::measure_machine_limits();
  std::printf(
      "degree,refinements,unknowns,points,targets,sources,gravity_s,pairs_s,step_s,share,flops_per_s,lanes,fma_per_"
      "s\n");
  std::printf("%d,%d,%zu,%d,%zu,%zu,%.3g,%.3g,%.4g,%.3f,%.3g,%d,%.3g\n", degree, n_refinements,
              3 * ball.space().n_global_nodes(), n_points, n_targets, n_sources, gravity_s, pairs_s, step_s,
              gravity_s / step_s,
              flops_of_a_pair * static_cast<double>(n_targets) * static_cast<double>(n_sources) / pairs_s, limits.lanes,
              limits.flops_per_second);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "usage: ball_gravity DEGREE REFINEMENTS [STEPS]\n");
    return 2;
  }
  run(std::atoi(argv[1]), std::atoi(argv[2]), argc > 3 ? std::atoi(argv[3]) : 40);
}
