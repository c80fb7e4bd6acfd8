/// The cell kernels against the machine's limits and against dealii::FEEvaluation, on one core (docs/kernels.md):
///
///     kernels [first degree] [last degree] [least unknowns] > kernels.csv
///
/// on the octant, refined to at least 10⁵ unknowns (components of positions), each kernel for each degree. Calls are
/// interleaved, times are CPU times. Lines with # are the machine's limits and accounts of memory. Columns:
///
///   degree, refinements, unknowns   of the mesh
///   kernel                          force, constraint, rate, reaction, gram (S = G M⁻¹ Gᵀ), stiffness (the product
///                                   with the tangent), or the force by FEEvaluation, with its number of lanes: 1 in
///                                   the installed library, or our number
///   per_second, best_per_second     unknowns per second: median and best of the rounds
///   over_fe_evaluation              median against that of FEEvaluation's force with our number of lanes, or with one lane
///                                   without PSEUDORIGID_NATIVE or AVX
///   difference                      of |f|₂ from FEEvaluation's, relative (0 where there is nothing to compare)
///   flops, bytes                    of one unknown, counted (kernel_cost.h; 0 for the last row, FEEvaluation with the
///                                   installed lanes). FEEvaluation clears the force in the cache
///   roofline                        unknowns per second that the machine's limits allow with them

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "allocated_memory.h"
#include "continuum/kernels/cell_kernels.h"
#include "fe_evaluation_force.h"
#include "kernel_cost.h"
#include "machine_limits.h"
#include "measuring.h"

namespace {

using namespace pseudorigid;
using namespace pseudorigid::benchmarks;
using continuum::BallMesh;
using continuum::BallSpace;
using continuum::Vector;

constexpr continuum::Sector octant{{true, true, true}};
constexpr materials::CiarletGeymonat neo_hookean{1, 0};
constexpr int n_rounds = 25;
constexpr double least_seconds = 0.01;  // of one timing

struct Job {
  std::string kernel;
  std::function<void()> call;
  double flops = 0, bytes = 0;  ///< of one unknown
  double difference = 0;
  int n_calls = 1;
  std::vector<double> seconds{};  ///< of one call

  double timed() const {
    const double all = cpu_seconds([&] {
      for (int i = 0; i < n_calls; ++i) call();
    });
    return all / n_calls;
  }
};

void time_interleaved(std::vector<Job>& jobs) {
  for (Job& job : jobs) {
    job.call();
    job.n_calls = 1 + static_cast<int>(least_seconds / job.timed());
  }
  for (int round = 0; round < n_rounds; ++round)
    for (Job& job : jobs) job.seconds.push_back(job.timed());
}

/// Positions `placement`, a velocity and a multiplier without meaning, results.
struct Fields {
  explicit Fields(const BallSpace& space)
      : x(space.make_vector()), v(x), f(x), multiplier(space.make_multiplier()), g(multiplier) {
    const Vector& X = space.reference_positions();
    for (unsigned int i = 0; i < x.locally_owned_size(); i += 3) {
      const auto placed = placement({X.local_element(i), X.local_element(i + 1), X.local_element(i + 2)});
      for (unsigned int c = 0; c < 3; ++c) x.local_element(i + c) = placed[c];
    }
    for (unsigned int i = 0; i < v.locally_owned_size(); ++i) v.local_element(i) = std::sin(i);
    for (unsigned int i = 0; i < multiplier.locally_owned_size(); ++i) multiplier.local_element(i) = std::cos(i);
  }
  Vector x, v, f, multiplier, g;
};

void measure(int degree, unsigned int least_unknowns, const MachineLimits& limits) {
  int n_refinements = 1;
  double before = allocated_bytes();
  auto space = std::make_unique<BallSpace>(BallMesh(octant, n_refinements), degree);
  while (3 * space->n_nodes() < least_unknowns) {
    space.reset();
    before = allocated_bytes();
    space = std::make_unique<BallSpace>(BallMesh(octant, ++n_refinements), degree);
  }
  const double n_unknowns = 3.0 * space->n_nodes();
  const auto kernels = continuum::make_cell_kernels(*space, neo_hookean);
  std::printf(
      "# degree %d: %.0f bytes of each unknown for geometry, indices and basis, %.0f with mesh, nodes and masses\n",
      degree, static_cast<double>(kernels->memory()) / n_unknowns, (allocated_bytes() - before) / n_unknowns);
  const BallMesh& mesh = space->mesh();
  const Placement position = [&mesh](const auto& cell, const auto& xi) { return mesh.position(cell, xi); };
  const auto installed = make_installed_fe_evaluation(mesh.triangulation(), position, degree, neo_hookean);
#ifdef PSEUDORIGID_HAS_WIDE_FE_EVALUATION
  const auto rival = make_wide_fe_evaluation(mesh.triangulation(), position, degree, neo_hookean);
  if (rival->n_lanes() != limits.lanes) {
    std::fprintf(stderr, "error: FEEvaluation has %d lanes, the kernels have %d\n", rival->n_lanes(), limits.lanes);
    std::exit(1);
  }
#else
  const auto rival = make_installed_fe_evaluation(mesh.triangulation(), position, degree, neo_hookean);
#endif
  Fields y(*space);
  const FEEvaluationForce::Vector installed_x = installed->placed(), rival_x = rival->placed();
  FEEvaluationForce::Vector installed_f = installed_x, rival_f = rival_x;

  std::vector<Job> jobs;
  const auto add_job = [&](const std::string& kernel, const CellCost& cost, double vector_bytes,
                           const std::function<void()>& call) {
    jobs.push_back({kernel, call, cost.flops * space->n_cells() / n_unknowns,
                    cost.cell_bytes * space->n_cells() / n_unknowns + vector_bytes});
  };
  const auto add = [&](const char* kernel, double vector_bytes, const std::function<void()>& call) {
    add_job(kernel, cell_cost(kernel, degree), vector_bytes, call);
  };
  const auto of_width = [](int n_lanes) { return "FEEvaluation/" + std::to_string(n_lanes); };
  add_job(of_width(rival->n_lanes()), fe_evaluation_cost(degree), 8 + 16, [&] { rival->force(rival_x, rival_f); });
  add("force", 8 + 24, [&] { kernels->force(y.x, y.f); });
  add("constraint", 8, [&] { kernels->constraint(y.x, y.g); });
  add("rate", 16, [&] { kernels->constraint_rate(y.x, y.v, y.g); });
  add("reaction", 8 + 16, [&] { kernels->add_reaction(y.x, y.multiplier, y.f); });
  jobs.push_back({"gram",
                  [&] {
                    y.f = 0.0;
                    kernels->add_reaction(y.x, y.multiplier, y.f);
                    y.f.scale(space->inverse_mass());
                    kernels->constraint_rate(y.x, y.f, y.g);
                  },
                  jobs[3].flops + jobs[4].flops + 1, jobs[3].bytes + jobs[4].bytes + 32});
  const auto stiffness =
      kernels->make_stiffness([](unsigned int, std::span<double> values) { std::ranges::fill(values, 1.0); });
  add("stiffness", 8 + 24, [&] { kernels->stiffness_product(*stiffness, y.v, y.f); });
  jobs.push_back({of_width(installed->n_lanes()), [&] { installed->force(installed_x, installed_f); }});
  for (Job* job : {&jobs[0], &jobs[1], &jobs.back()}) job->call();
  jobs[1].difference = std::abs(y.f.l2_norm() / rival_f.l2_norm() - 1);
  jobs.back().difference = std::abs(installed_f.l2_norm() / rival_f.l2_norm() - 1);
  time_interleaved(jobs);
  const double median_of_rival = median(jobs[0].seconds);
  for (Job& job : jobs) {
    const double median_seconds = median(job.seconds), best = *std::min_element(job.seconds.begin(), job.seconds.end());
    const double least_time = std::max(job.flops / limits.flops_per_second, job.bytes / limits.bytes_per_second);
    std::printf("%d,%d,%.0f,%s,%.4g,%.4g,%.3f,%.1e,%.0f,%.0f,%.4g\n", degree, n_refinements, n_unknowns,
                job.kernel.c_str(), n_unknowns / median_seconds, n_unknowns / best, median_of_rival / median_seconds,
                job.difference, job.flops, job.bytes, least_time > 0 ? 1 / least_time : 0);
  }
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  const int first = argc > 1 ? std::atoi(argv[1]) : 2, last = argc > 2 ? std::atoi(argv[2]) : argc > 1 ? first : 8;
  const unsigned int least_unknowns = argc > 3 ? static_cast<unsigned int>(std::atoi(argv[3])) : 100'000;
  const MachineLimits limits = measure_machine_limits();
  std::printf("# one core: %.4g flops/s (fused multiply-adds, %d lanes), %.4g bytes/s (triad)\n",
              limits.flops_per_second, limits.lanes, limits.bytes_per_second);
  std::printf(
      "degree,refinements,unknowns,kernel,per_second,best_per_second,over_fe_evaluation,difference,"
      "flops,bytes,roofline\n");
  for (int degree = first; degree <= last; ++degree) measure(degree, least_unknowns, limits);
}
