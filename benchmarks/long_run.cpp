/// Problem (iv): what the geometric methods keep over 10⁶ periods of problem (i), 2·10⁶ units of time.
///
///   long_run [--quick] [--output FILE.csv]
///
/// Columns: method, time, energy_error (relative), J_error, Z_error (relative to their own size), det_error (det Q −
/// 1). The summary names the greatest of each and the slope of the straight line through the energy's error, times the
/// end time. --quick runs 10⁴ periods.

#include <cstdio>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

#include "mechanics/composition.h"
#include "mechanics/energy_momentum.h"
#include "mechanics/symmetric_multistep.h"
#include "mechanics/time_loop.h"
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
    if (Status status = reduced::observe(form.system, state, w.system, {.multiplier = false, .axes = false}, o);
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

/// End value of the straight line through the errors of the energy, by least squares, and three standard deviations of
/// it if the errors about the line were independent.
std::pair<double, double> drift(const std::vector<Row>& rows) {
  double n = 0, t = 0, e = 0, tt = 0, te = 0;
  for (const Row& r : rows) n += 1, t += r.t, e += r.energy;
  for (const Row& r : rows) tt += (r.t - t / n) * (r.t - t / n), te += (r.t - t / n) * (r.energy - e / n);
  const double slope = te / tt;
  double scatter = 0;
  for (const Row& r : rows) {
    const double d = r.energy - e / n - slope * (r.t - t / n);
    scatter += d * d;
  }
  return {slope * rows.back().t, 3 * std::sqrt(scatter / (n - 2) / tt) * rows.back().t};
}

template <class Method>
void run(const Form<Sl3>& form, double end, long steps_per_unit, std::ofstream& file) {
  constexpr long n_intervals = 1000;
  Watch hooks{form, std::lround(end / n_intervals) * steps_per_unit};
  auto state = form.initial;
  typename Method::template Workspace<Sl3> workspace(form.system);
  mechanics::Cursor cursor;
  const Stopwatch watch;
  const auto result =
      mechanics::run_time_loop<Method>(form.system, {end, n_intervals}, state, cursor, workspace, hooks);
  const double seconds = watch.seconds();
  Row greatest{};
  for (const Row& r : hooks.rows) {
    file << Method::name << ',' << r.t << ',' << r.energy << ',' << r.J << ',' << r.Z << ',' << r.det << '\n';
    greatest = {r.t, std::max(greatest.energy, std::abs(r.energy)), std::max(greatest.J, r.J),
                std::max(greatest.Z, r.Z), std::max(greatest.det, std::abs(r.det))};
  }
  const auto [slope, uncertainty] = drift(hooks.rows);
  std::printf(
      "%s, step 1/%ld, %.0f s to t = %.0f: energy %.1e, drift %.1e +- %.1e, J %.1e, Z %.1e, det Q - 1 %.1e%s%s\n",
      Method::name, steps_per_unit, seconds, greatest.t, greatest.energy, slope, uncertainty, greatest.J, greatest.Z,
      greatest.det, result.reason.empty() ? "" : ": ", result.reason.c_str());
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
  run<mechanics::Rattle8>(form, end, 28, file);
  run<mechanics::Symmetric8>(form, end, 128, file);
  run<mechanics::Symmetric12>(form, end, 80, file);
  run<mechanics::EnergyMomentum>(form, end, 20, file);
  if (file.flush(); !file) {
    std::cerr << "cannot write " << output << "\n";
    return 3;
  }
  return 0;
}
