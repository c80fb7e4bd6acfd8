/// Iterations that a solve with the Gram operator S = G M⁻¹ Gᵀ takes with two levels, over degrees and refinements.
///
///   gram_iterations [FINEST]      default 3: up to 1.4 million unknowns, 2 GB
///
/// CSV: refinements, degree, unknowns, multipliers, shear (of the deformation in tests/continuum/sheared.h),
/// iterations (until the residual of a random right-hand side has fallen by GramSolver::reduction), solve_per_action
/// (processor time of the solve over that of one action of S), renewal_per_action.

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <random>

#include "continuum/body/elastic_ball.h"
#include "continuum/sheared.h"
#include "measuring.h"

namespace {

using namespace pseudorigid;
using benchmarks::cpu_seconds;
using continuum::ElasticBall;
using continuum::Vector;

void solve(const ElasticBall& ball, double shear) {
  const Vector x = testing::sheared(ball, shear);
  auto workspace = ball.make_workspace();
  Vector r = ball.make_multiplier(), lambda = r, f = ball.make_vector(), product = r;
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (double& value : mechanics::local_values(r)) value = uniform(generator);

  mechanics::SolveReport report;
  const double first = cpu_seconds([&] { report = ball.solve_gram(x, x, r, workspace, lambda); });
  const double again = cpu_seconds([&] { report = ball.solve_gram(x, x, r, workspace, lambda); });
  if (!report.status) {
    std::fprintf(stderr, "gram_iterations: %s\n", report.status.reason().c_str());
    std::exit(1);
  }
  double action = HUGE_VAL;
  for (int round = 0; round < 7; ++round)
    action = std::min(action, cpu_seconds([&] {
                        f = 0.0;
                        ball.add_reaction(x, lambda, f);
                        ball.apply_inverse_mass(f, f);
                        ball.constraint_rate(x, f, product);
                      }));
  const auto& space = ball.space();
  std::printf("%u,%zu,%zu,%g,%d,%.1f,%.1f\n", space.degree(), 3 * space.n_global_nodes(),
              space.n_global_cells() * space.n_pressure(), shear, report.iterations, again / action,
              (first - again) / action);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  const int finest = argc > 1 ? std::atoi(argv[1]) : 3;
  std::printf("refinements,degree,unknowns,multipliers,shear,iterations,solve_per_action,renewal_per_action\n");
  for (int degree = 2; degree <= 6; ++degree)
    for (int n_refinements = 1; n_refinements <= finest; ++n_refinements) {
      const ElasticBall ball({{true, true, true}}, degree, n_refinements, materials::CiarletGeymonat{1, 0}, {},
                             MPI_COMM_SELF, continuum::GramMethod::two_level);
      for (const double shear : {0.0, 0.4}) {
        std::printf("%d,", n_refinements);
        solve(ball, shear);
      }
    }
}
