/// Problem (iv): what the geometric methods keep over 10⁶ periods of problem (i), 2·10⁶ units of time.
///
///   long_run [--quick] [--output FILE.csv] > SUMMARY.csv
///
/// Columns of the file: method, time, energy_error (relative), J_error, Z_error (relative to their own size), det_error
/// (det Q − 1). The summary has the greatest of each, the drift of the energy with its standard error and the seconds
/// of processor time; rattle-8 is run with two further steps, which are only in the summary. --quick runs 10⁴ periods.

#include <cmath>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

#include "mechanics/methods/composition.h"
#include "mechanics/methods/energy_momentum.h"
#include "mechanics/methods/gauss_16.h"
#include "mechanics/methods/symmetric_multistep.h"
#include "mechanics/methods/time_loop.h"
#include "reduced/observe.h"
#include "work_precision.h"

namespace {

using namespace pseudorigid;
using namespace pseudorigid::benchmarks;

struct Row {
  double t, energy, J, Z, det;
};

/// Momenta and energy against those of the first sample.
struct Watch {
  const Form<Sl3>& form;
  long n_steps;
  std::vector<Row> rows{};
  mechanics::ReducedObservables start{};

  template <class Workspace>
  Status sample(long k, const State<Sl3>& state, Workspace& w) {
    mechanics::ReducedObservables o;
    auto& of_system = [&w]() -> auto& {
      if constexpr (requires { w.system.system; })
        return w.system.system;
      else
        return w.system;
    }
    ();
    if (Status status = reduced::observe(form.system, state, of_system, {.multiplier = false, .axes = false}, o);
        !status)
      return status;
    if (k == 0) start = o;
    rows.push_back({state.t, o.energy() / start.energy() - 1,
                    (o.angular_momentum - start.angular_momentum).norm() / start.angular_momentum.norm(),
                    (o.circulation - start.circulation).norm() / start.circulation.norm(), o.volume_ratio - 1});
    return {};
  }
  template <class Workspace>
  long steps_per_interval(long, const State<Sl3>&, const Workspace&) {
    return n_steps;
  }
  template <class Workspace>
  bool step_done(mechanics::Cursor, const State<Sl3>&, const Workspace&) {
    return true;
  }
};

/// Drift of the energy's error over the run, and its standard error. Of 20 blocks of samples the means change from one
/// to the next by d_k: the drift is 20 times their mean, as for a straight line, and its error that of a random walk,
/// whose d_k are correlated by 1/4 with their neighbours (1 + 2/4 = 1.5). A fit of a straight line would take a random
/// walk for a slope.
std::pair<double, double> drift(const std::vector<Row>& rows) {
  constexpr std::size_t n_blocks = 20;
  std::vector<double> change;
  double before = 0;
  for (std::size_t b = 0; b < n_blocks; ++b) {
    const std::size_t begin = rows.size() * b / n_blocks, end = rows.size() * (b + 1) / n_blocks;
    double mean = 0;
    for (std::size_t k = begin; k < end; ++k) mean += rows[k].energy / static_cast<double>(end - begin);
    if (b > 0) change.push_back(mean - before);
    before = mean;
  }
  const double n = static_cast<double>(change.size());
  double mean = 0, scatter = 0;
  for (const double d : change) mean += d / n;
  for (const double d : change) scatter += (d - mean) * (d - mean) / (n - 1);
  return {n_blocks * mean, n_blocks * std::sqrt(1.5 * scatter / n)};
}

template <class Method>
void run(const Form<Sl3>& form, double end, long steps_per_unit, std::ostream* file = nullptr) {
  constexpr long n_intervals = 1000;
  Watch hooks{form, std::lround(end / n_intervals) * steps_per_unit};
  auto state = form.initial;
  typename Method::template Workspace<Sl3> workspace(form.system);
  mechanics::Cursor cursor;
  const std::clock_t start = std::clock();
  const auto result =
      mechanics::run_time_loop<Method>(form.system, {end, n_intervals}, state, cursor, workspace, hooks);
  const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  Row greatest{};
  for (const Row& r : hooks.rows) {
    if (file)
      *file << Method::name << ',' << r.t << ',' << r.energy << ',' << r.J << ',' << r.Z << ',' << r.det << '\n';
    greatest = {r.t, std::max(greatest.energy, std::abs(r.energy)), std::max(greatest.J, r.J),
                std::max(greatest.Z, r.Z), std::max(greatest.det, std::abs(r.det))};
  }
  const auto [slope, uncertainty] = drift(hooks.rows);
  std::printf("%s,%ld,%.0f,%.2e,%.2e,%.2e,%.2e,%.2e,%.2e,%.4g,%s\n", Method::name, steps_per_unit, greatest.t,
              greatest.energy, slope, uncertainty, greatest.J, greatest.Z, greatest.det, seconds,
              result.reason.c_str());
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  double end = 2e6;
  std::string output = "long_run.csv";
  for (int i = 1; i < argc; ++i) {
    const std::string option = argv[i];
    if (option == "--quick")
      end = 2e4;
    else if (option == "--output" && i + 1 < argc)
      output = argv[++i];
    else {
      std::cerr << "long_run [--quick] [--output FILE.csv]\n";
      return 2;
    }
  }
  const auto form = sl3_form();
  std::ofstream file(output);
  file << "method,time,energy_error,J_error,Z_error,det_error\n";
  std::printf(
      "method,steps_per_unit,end,energy_error,energy_drift,drift_error,J_error,Z_error,det_error,seconds,failure\n");
  for (const long steps : {20, 32}) run<mechanics::Rattle8>(form, end, steps);  // that no step is a lucky one
  run<mechanics::Rattle8>(form, end, 28, &file);
  run<mechanics::Symmetric8>(form, end, 128, &file);
  run<mechanics::Symmetric12>(form, end, 80, &file);
  run<mechanics::Gauss16>(form, end, 4, &file);
  run<mechanics::EnergyMomentum>(form, end, 20, &file);
  if (file.flush(); !file) {
    std::cerr << "cannot write " << output << "\n";
    return 3;
  }
  return 0;
}
