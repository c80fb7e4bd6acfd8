/// Error against run time of the lowest spheroidal frequency of the ball, S2, x = ωr/c = 2.665622189236 (Lamb 1882):
///
///   ball_frequency [--quick] > ball_frequency.csv
///
/// Two ways: of the octant's motion alone, where S2 is the lowest mode, and as Analysis = modes finds it, of all
/// parities with kind and degree. Everything from mesh to eigenvalue is timed, in turn, and the medians of seven rounds
/// are given, or of as many as 8 seconds hold. Columns:
///
///   way                    octant, or all parities
///   degree, refinements, unknowns
///   seconds                processor time
///   error                  |x/2.665622189236 - 1|, of the mean of the copies that are found

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <numeric>
#include <string_view>
#include <vector>

#include "continuum/modes/block_lanczos.h"
#include "continuum/modes/modes.h"
#include "materials/law_table.h"
#include "measuring.h"

namespace {

using namespace pseudorigid;
using namespace pseudorigid::continuum;
using benchmarks::cpu_seconds;
using benchmarks::require;

constexpr double exact = 2.665622189236;  // its next digits are below 2e-13 of it

/// What both ways need.
struct Rest {
  Rest(int degree, int n_refinements)
      : space(BallMesh({{true, true, true}}, n_refinements), degree),
        law(materials::make_law("neo-hookean", {})),
        kernels(make_cell_kernels(space, law)),
        problem(space, *kernels, law, true) {}
  BallSpace space;
  materials::AnyLaw law;
  std::unique_ptr<CellKernels> kernels;
  RestProblem problem;
};

double octant_frequency(const Rest& rest) {
  ParitySector sector(rest.problem, parity_of_sector(0));
  require(sector.factorize());
  BlockLanczos lanczos([&](const auto& y, auto& z) { return sector.apply(y, z); },
                       static_cast<Eigen::Index>(sector.n_unknowns()));
  require(lanczos.find(1, 1e-7));
  ParitySector::Modes modes;
  require(sector.modes_of(lanczos.vectors(), modes));
  return std::sqrt(modes.omega_squared[0]);
}

double frequency_among_all(const Rest& rest) {
  std::vector<BallFrequency> frequencies;
  ModesReport report;
  require(ball_modes(rest.problem, 2, frequencies, report));
  for (const BallFrequency& f : frequencies)
    if (f.kind == ModeKind::spheroidal && f.degree == 2) return f.omega;
  std::fprintf(stderr, "ball_frequency: S2 is not among the two lowest frequencies\n");
  std::exit(1);
}

struct Job {
  const char* way;
  double (*frequency)(const Rest&);
  int degree, n_refinements;
  std::size_t n_unknowns = 0;
  double error = 0;
  std::vector<double> seconds{};

  void run() {
    const double start = cpu_seconds();
    const Rest rest(degree, n_refinements);
    const double omega = frequency(rest);
    seconds.push_back(cpu_seconds() - start);
    error = std::abs(omega / exact - 1);
    n_unknowns = 3 * rest.space.n_global_nodes();
  }
};

}  // namespace

int main(int argc, char** argv) {
  const bool quick = argc > 1 && std::string_view(argv[1]) == "--quick";
  if (argc > 1 + quick) {
    std::fprintf(stderr, "ball_frequency [--quick]\n");
    return 2;
  }
  std::printf("way,degree,refinements,unknowns,seconds,error\n");
  constexpr int combinations[][2] = {{2, 0}, {3, 0}, {4, 0}, {5, 0}, {6, 0}, {7, 0},
                                     {2, 1}, {3, 1}, {4, 1}, {2, 2}, {3, 2}};
  std::vector<Job> jobs;
  for (const auto& [degree, n_refinements] : combinations) {
    if (quick && (degree > 6 || n_refinements > 1)) continue;
    jobs.push_back({"octant", octant_frequency, degree, n_refinements});
    jobs.push_back({"all parities", frequency_among_all, degree, n_refinements});
  }
  const int n_rounds = quick ? 3 : 7;
  const double enough = quick ? 1 : 8;
  for (int round = 0; round < n_rounds; ++round)
    for (Job& job : jobs)
      if (std::accumulate(job.seconds.begin(), job.seconds.end(), 0.0) < enough) job.run();
  for (const Job& job : jobs)
    std::printf("%s,%d,%d,%zu,%.4g,%.3g\n", job.way, job.degree, job.n_refinements, job.n_unknowns,
                benchmarks::median(job.seconds), job.error);
}
