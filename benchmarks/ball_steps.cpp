/// What a step of the ball by symmetric-4 costs, in evaluations of the force.
///
///   ball_steps DEGREE REFINEMENTS [dense|two-level|auto] [STEPS] [TOLERANCE]      also under mpirun
///
/// The octant is released with the velocity 0.3 (x, y, −2z), neo-Hookean, μ = ρ = r = 1, and moves with 0.8 of the
/// stability limit; steps meet the constraint to TOLERANCE (1e-9, which Time/Tolerance = 1e-5 asks for). One line of
/// CSV (and a header): degree, refinements, ranks, unknowns, multipliers, gram (the preconditioner), force_s (seconds
/// of a force evaluation), constraint_s, rate_s, reaction_s, step_s, step_per_force (the ratio), forces, newton,
/// solves, gram_iterations (each per step), iterations_per_solve, iterations_at_most, renewals, gram_MB
/// (preconditioner, this rank), kernel_MB, allocated_MB (all of the ball and the method, this rank), setup_s. Times are
/// medians of processor time; STEPS (default 40) are taken after 10 that are not timed.

#include <deal.II/base/mpi.h>
#include <deal.II/base/multithread_info.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "allocated_memory.h"
#include "continuum/body/elastic_ball.h"
#include "continuum/parallel/ranks.h"
#include "measuring.h"
#include "mechanics/methods/methods.h"
#include "mechanics/steps/largest_frequency.h"

namespace {

using namespace pseudorigid;
using benchmarks::require;
using continuum::ElasticBall;

double median_seconds(int n, const std::function<void()>& work) {
  std::vector<double> times;
  for (int i = 0; i < n; ++i) times.push_back(benchmarks::cpu_seconds(work));
  return benchmarks::median(std::move(times));
}

struct Arguments {
  int degree, n_refinements, n_steps;
  std::string gram;
  double constraint_tolerance;
};

void run(const Arguments& arguments, MPI_Comm communicator) {
  std::optional<ElasticBall> made;
  std::optional<continuum::GramMethod> method;
  if (arguments.gram == "dense") method = continuum::GramMethod::dense;
  if (arguments.gram == "two-level") method = continuum::GramMethod::two_level;
  const double allocated_before = benchmarks::allocated_bytes();
  const double setup = benchmarks::cpu_seconds([&] {
    made.emplace(continuum::Sector{{true, true, true}}, arguments.degree, arguments.n_refinements,
                 materials::CiarletGeymonat{1, 0}, loads::Loads{}, communicator, method);
  });
  const ElasticBall& ball = *made;
  const Eigen::Matrix3d velocity = Eigen::Vector3d(0.3, 0.3, -0.6).asDiagonal();
  mechanics::State<ElasticBall> state{0, ball.affine_field(Eigen::Matrix3d::Identity()), ball.affine_field(velocity)};
  using Method = mechanics::Symmetric4;
  Method::Workspace<ElasticBall> w(ball);
  w.constraint_tolerance = arguments.constraint_tolerance * ball.multiplier_scale();
  const auto frequency = mechanics::largest_frequency(ball, state, w.system, 24);
  require(frequency.status);
  const double h = 0.8 * Method::stability_limit / frequency.omega;
  const auto step = [&] { require(Method::advance(ball, h, state, w)); };
  for (int i = 0; i < 10; ++i) step();
  const auto before = w.system.gram.statistics();
  const mechanics::Counters counted = w.counters;
  const double step_s = median_seconds(arguments.n_steps, step);
  const auto after = w.system.gram.statistics();

  auto f = ball.make_vector();
  auto g = ball.make_multiplier();
  const int n = 15;
  const double force_s = median_seconds(n, [&] { require(ball.force(0, state.q, state.v, w.system, f)); });
  const double constraint_s = median_seconds(n, [&] { require(ball.constraint(state.q, g)); });
  const double rate_s = median_seconds(n, [&] { ball.constraint_rate(state.q, state.v, g); });
  const double reaction_s = median_seconds(n, [&] { ball.add_reaction(state.q, g, f); });

  const double n_steps = arguments.n_steps;
  const double n_solves = static_cast<double>(after.n_solves - before.n_solves);
  const double n_iterations = static_cast<double>(after.n_iterations - before.n_iterations);
  if (continuum::this_rank(communicator) != 0) return;
  const auto& space = ball.space();
  std::printf(
      "degree,refinements,ranks,unknowns,multipliers,gram,force_s,constraint_s,rate_s,reaction_s,step_s,"
      "step_per_force,forces,newton,solves,gram_iterations,iterations_per_solve,iterations_at_most,renewals,gram_MB,"
      "kernel_MB,allocated_MB,setup_s\n");
  std::printf(
      "%d,%d,%u,%zu,%zu,%s,%.3g,%.3g,%.3g,%.3g,%.4g,%.1f,%.2f,%.2f,%.2f,%.1f,%.1f,%ld,%ld,%.1f,%.1f,%.0f,%.2f\n",
      arguments.degree, arguments.n_refinements, continuum::n_ranks(communicator), 3 * space.n_global_nodes(),
      space.n_global_cells() * space.n_pressure(), arguments.gram.c_str(), force_s, constraint_s, rate_s, reaction_s,
      step_s, step_s / force_s, static_cast<double>(w.counters.n_force - counted.n_force) / n_steps,
      static_cast<double>(w.counters.n_position_iterations - counted.n_position_iterations) / n_steps,
      n_solves / n_steps, n_iterations / n_steps, n_solves > 0 ? n_iterations / n_solves : 0,
      after.n_iterations_at_most, after.n_renewals, static_cast<double>(after.memory) / 1e6,
      static_cast<double>(ball.kernels().memory()) / 1e6, (benchmarks::allocated_bytes() - allocated_before) / 1e6,
      setup);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "usage: ball_steps DEGREE REFINEMENTS [dense|two-level|auto] [STEPS] [TOLERANCE]\n");
    return 2;
  }
  dealii::MultithreadInfo::set_thread_limit(1);
  const Arguments arguments{std::atoi(argv[1]), std::atoi(argv[2]), argc > 4 ? std::atoi(argv[4]) : 40,
                            argc > 3 ? argv[3] : "auto", argc > 5 ? std::atof(argv[5]) : 1e-9};
  std::optional<dealii::Utilities::MPI::MPI_InitFinalize> mpi;
  if (std::getenv("OMPI_COMM_WORLD_SIZE")) mpi.emplace(argc, argv, 1);
  run(arguments, mpi ? MPI_COMM_WORLD : MPI_COMM_SELF);
}
