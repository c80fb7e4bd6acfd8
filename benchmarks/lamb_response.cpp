/// Error against run time of the response to an affine release, ẋ(0) = εHX, H = diag(1, 1, −2), on the octant, t ≤ 5:
/// the odd part in ε of Q_M − Id per εH against the exact Σ f_k sin(x_k t)/x_k of the incompressible sphere (Lamb
/// 1882).
///
///   lamb_response [--quick]
///
/// CSV: degree, refinements, unknowns, step, steps, error (largest over 100 samples, relative to the largest response),
/// seconds (processor time of one run, set-up included: the median of the runs with ε and −ε, four of them where they
/// are short).

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string_view>
#include <vector>

#include "continuum/body/elastic_ball.h"
#include "continuum/lamb_modes.h"
#include "measuring.h"
#include "mechanics/methods/methods.h"
#include "mechanics/steps/largest_frequency.h"

namespace {

using namespace pseudorigid;
using benchmarks::cpu_seconds;
using benchmarks::require;
using continuum::ElasticBall;

constexpr double epsilon = 1e-4, end = 5;
constexpr double part_of_limit = 0.8;  // half of it changes no error by 1 %: all of it is the discretisation's
constexpr int n_samples = 100;

struct Run {
  std::array<double, n_samples + 1> Q{1};  ///< Q_M,11 at the samples
  double step = 0, seconds = 0;
  long n_steps = 0;
  std::size_t n_unknowns = 0;
};

/// One release with the velocity ±εHX, from the mesh on.
Run release(int degree, int n_refinements, double sign) {
  const double start = cpu_seconds();
  const ElasticBall ball({{true, true, true}}, degree, n_refinements, materials::CiarletGeymonat{1, 0});
  const Eigen::Matrix3d H = Eigen::Vector3d(1, 1, -2).asDiagonal();
  mechanics::State<ElasticBall> state{0, ball.affine_field(Eigen::Matrix3d::Identity()),
                                      ball.affine_field(sign * epsilon * H)};
  mechanics::RattleWorkspace<ElasticBall> w(ball);
  const auto frequency = mechanics::largest_frequency(ball, state, w.system, 24);
  require(frequency.status);
  const double limit = part_of_limit * mechanics::Rattle4::stability_limit / frequency.omega;
  const long steps_per_sample = std::lround(std::ceil(end / n_samples / limit));
  Run run;
  run.n_steps = n_samples * steps_per_sample;
  run.step = end / static_cast<double>(run.n_steps);
  run.n_unknowns = 3 * ball.space().n_global_nodes();
  for (int k = 1; k <= n_samples; ++k) {
    for (long i = 0; i < steps_per_sample; ++i) require(mechanics::Rattle4::advance(ball, run.step, state, w));
    require(mechanics::Rattle4::project_velocity(ball, state, w));
    run.Q[k] = ball.mass_moment(state.q)(0, 0);
  }
  run.seconds = cpu_seconds() - start;
  return run;
}

/// Largest difference of the odd part in ε from the exact response, relative to the largest response.
double error(const Run& plus, const Run& minus, const std::vector<testing::LambMode>& modes) {
  double difference = 0, largest = 0;
  for (int k = 0; k <= n_samples; ++k) {
    const double exact = testing::lamb_response(modes, k * end / n_samples);
    difference = std::max(difference, std::abs((plus.Q[k] - minus.Q[k]) / (2 * epsilon) - exact));
    largest = std::max(largest, std::abs(exact));
  }
  return difference / largest;
}

void measure(int degree, int n_refinements, const std::vector<testing::LambMode>& modes) {
  std::vector<Run> runs;
  double total = 0;
  while (runs.size() < 2 || (runs.size() < 4 && total < 10)) {
    runs.push_back(release(degree, n_refinements, runs.size() % 2 ? -1 : 1));
    total += runs.back().seconds;
  }
  const double worst = error(runs[0], runs[1], modes);
  std::ranges::sort(runs, {}, &Run::seconds);
  const std::size_t n = runs.size();
  const double median = (runs[(n - 1) / 2].seconds + runs[n / 2].seconds) / 2;
  const Run& run = runs.front();
  std::printf("%d,%d,%zu,%.4g,%ld,%.3g,%.3f\n", degree, n_refinements, run.n_unknowns, run.step, run.n_steps, worst,
              median);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  const bool quick = argc > 1 && std::string_view(argv[1]) == "--quick";
  if (argc > 1 + quick) {
    std::fprintf(stderr, "lamb_response [--quick]\n");
    return 2;
  }
  const auto modes = testing::lamb_modes(60);  // fractions fall like 1/x⁴: what is left out is below 1e-8
  constexpr int combinations[][2] = {{2, 1}, {3, 0}, {4, 0}, {5, 0}, {2, 2}, {3, 1},
                                     {6, 0}, {4, 1}, {7, 0}, {5, 1}, {8, 0}, {6, 1}};
  std::printf("degree,refinements,unknowns,step,steps,error,seconds\n");
  for (const auto& [degree, n_refinements] : combinations) {
    if (quick && degree + 2 * n_refinements > 6) continue;
    measure(degree, n_refinements, modes);
  }
}
