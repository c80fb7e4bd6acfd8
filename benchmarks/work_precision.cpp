/// Error against run time, all methods and rivals on the same problems in one run:
///
///   work_precision [--quick] [--output FILE.csv] [--problem NAME]
///
/// All jobs are run in turn, round after round, and the median of each one's times is kept: what else the machine does
/// then disturbs all alike. This is done three times, and the medians of each time are the rows of a run: they tell how
/// much a time varies. Columns: run, problem, method, parameter_name, parameter, evaluations, seconds, error,
/// constraint_error, energy_error (docs/benchmarks.md).

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

#include "work_precision.h"

using namespace pseudorigid::benchmarks;

namespace {

/// Runs all jobs in turn, n_rounds times, and writes a row for each.
void measure(const std::vector<Job>& jobs, int run, int n_rounds, std::ostream& file) {
  std::vector<std::vector<Result>> results(jobs.size());
  for (int round = 0; round < n_rounds; ++round)
    for (std::size_t i = 0; i < jobs.size(); ++i) results[i].push_back(jobs[i].run());
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    const auto& [name, method, parameter_name, parameter, _] = jobs[i];
    std::ranges::nth_element(results[i], results[i].begin() + n_rounds / 2, {}, &Result::seconds);
    const Result& r = results[i][n_rounds / 2];
    if (!r.failure.empty()) {
      std::printf("%s, %s, %s %.3g: %s\n", name.c_str(), method.c_str(), parameter_name.c_str(), parameter,
                  r.failure.c_str());
      continue;
    }
    file << run << ',' << name << ',' << method << ',' << parameter_name << ',' << parameter << ',' << r.n_evaluations
         << ',' << r.seconds << ',' << r.error << ',' << r.constraint_error << ',' << r.energy_error << '\n';
  }
}

}  // namespace

int main(int argc, char** argv) {
  int n_runs = 3, n_rounds = 5;
  std::string output = "work_precision.csv", problem;
  for (int i = 1; i < argc; ++i) {
    const std::string option = argv[i];
    if (option == "--quick")
      n_runs = 1, n_rounds = 3;
    else if (option == "--output" && i + 1 < argc)
      output = argv[++i];
    else if (option == "--problem" && i + 1 < argc)
      problem = argv[++i];
    else {
      std::cerr << "work_precision [--quick] [--output FILE.csv] [--problem "
                   "sl3|rigid_body|double_pendulum|gravitating]\n";
      return 2;
    }
  }

  std::vector<Job> jobs;
  for (const auto& [name, jobs_of_problem] :
       {std::pair{"sl3", &sl3_jobs}, std::pair{"rigid_body", &rigid_body_jobs},
        std::pair{"double_pendulum", &double_pendulum_jobs}, std::pair{"gravitating", &gravitating_jobs}})
    if (problem.empty() || problem == name)
      for (auto& job : jobs_of_problem()) jobs.push_back(std::move(job));
  std::ofstream file(output);
  file << "# " << PSEUDORIGID_BENCHMARK_FLAGS << "; " << n_runs << " runs, medians of " << n_rounds << " rounds each\n"
       << "run,problem,method,parameter_name,parameter,evaluations,seconds,error,constraint_error,energy_error\n";
  for (int run = 1; run <= n_runs; ++run) measure(jobs, run, n_rounds, file);
  if (file.flush(); !file) {
    std::cerr << "cannot write " << output << "\n";
    return 3;
  }
  return 0;
}
