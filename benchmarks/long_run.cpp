/// Problem (iv): what the geometric methods keep over 10⁶ periods of problems (i) and (ii), 2·10⁶ units of time.
///
///   long_run [--quick] [--output FILE.csv] > SUMMARY.csv
///
/// Columns of the file: problem, method, time, energy_error (relative), J_error, Z_error (relative to their own size),
/// constraint_error (det Q − 1; the greatest entry of RᵀR − Id; |q| − 1), error (of the coordinates). The error is the
/// difference from gauss-16 with 8 steps a unit of time on problem (i) and 2 on problem (ii), where energy drifts by
/// some 1e-13 with more. This reference has round-off of its own, like that of gauss-16 in the table. The motion of
/// problem (i) is chaotic: its error is that of any two motions long before the end. The summary has the greatest of
/// each, the drift of the energy with its standard error, the exponents with which energy and error grow with time, and
/// the seconds of processor time. Runs with further steps are only in the summary.
/// --quick runs 10⁴ periods.

#include <cmath>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

#include "mechanics/core/axial_vectors.h"
#include "mechanics/methods/composition.h"
#include "mechanics/methods/energy_momentum.h"
#include "mechanics/methods/gauss_16.h"
#include "mechanics/methods/symmetric_multistep.h"
#include "mechanics/methods/time_loop.h"
#include "own_methods.h"
#include "work_precision.h"

namespace {

using namespace pseudorigid;
using namespace pseudorigid::benchmarks;

constexpr long n_intervals = 1000;

struct Row {
  double t, energy, J, Z, constraint, error;
};

/// J and Z of the body of problem (i), whose E₀ is a multiple of the identity; J of problem (ii) in space, and no Z.
struct Momenta {
  Eigen::Vector3d J, Z;
};
Momenta momenta_of_body(const Eigen::VectorXd& x) {
  using Rows = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
  const Rows Q = Eigen::Map<const Rows>(x.data()), V = Eigen::Map<const Rows>(x.data() + 9);
  return {mechanics::axial_vector(Q * V.transpose()), mechanics::axial_vector(V.transpose() * Q)};
}
Momenta momenta_of_rigid_body(const Eigen::VectorXd& x) {
  using Rows = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
  const Eigen::Vector3d A(rigid_body::A.data());
  return {Eigen::Map<const Rows>(x.data()) * A.cwiseProduct(x.tail<3>()), Eigen::Vector3d::Zero()};
}

/// Coordinates at the samples.
using Path = std::vector<Eigen::VectorXd>;

struct Problem {
  const char* name;
  Momenta (*momenta)(const Eigen::VectorXd& coordinates);
  Path reference{};
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

/// Exponent of a power of the time, by least squares in logarithms; 0 where nothing is seen to change.
double exponent(const std::vector<std::pair<double, double>>& time_and_size) {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (const auto& [time, size] : time_and_size) {
    if (!(size > 0)) continue;
    const double log_time = std::log(time), log_size = std::log(size);
    n += 1, x += log_time, y += log_size, xx += log_time * log_time, xy += log_time * log_size;
  }
  return n > 1 ? (n * xy - x * y) / (n * xx - x * x) : 0;
}

/// Of the root mean square of the changes of the energy over a time: ½ for a random walk, 0 if it only oscillates.
double growth_of_energy(const std::vector<Row>& rows) {
  std::vector<std::pair<double, double>> changes;
  for (std::size_t lag = 1; lag <= rows.size() / 8; lag *= 2) {
    double sum = 0;
    for (std::size_t k = lag; k < rows.size(); ++k)
      sum += (rows[k].energy - rows[k - lag].energy) * (rows[k].energy - rows[k - lag].energy);
    changes.emplace_back(lag, std::sqrt(sum / static_cast<double>(rows.size() - lag)));
  }
  return exponent(changes);
}

/// Of the greatest error so far, over the last two decades of the run; 0 if the motion is lost.
double growth_of_error(const std::vector<Row>& rows) {
  constexpr double lost = 0.1;
  std::vector<std::pair<double, double>> errors;
  double greatest = 0;
  for (const Row& row : rows) {
    greatest = std::max(greatest, row.error);
    if (row.t >= 0.01 * rows.back().t) errors.emplace_back(row.t, greatest);
  }
  return greatest < lost ? exponent(errors) : 0;
}

std::vector<Row> compare(const Problem& problem, const auto& form, const auto& samples) {
  const Momenta start = problem.momenta(form.coordinates(form.initial));
  const double energy = form.energy(form.initial), Z = start.Z.norm();
  std::vector<Row> rows;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const Eigen::VectorXd x = form.coordinates(samples[k]);
    const auto [J_now, Z_now] = problem.momenta(x);
    rows.push_back({samples[k].t, form.energy(samples[k]) / energy - 1, (J_now - start.J).norm() / start.J.norm(),
                    Z > 0 ? (Z_now - start.Z).norm() / Z : 0, form.constraint_error(samples[k]),
                    k < problem.reference.size() ? (x - problem.reference[k]).cwiseAbs().maxCoeff() : 0});
  }
  return rows;
}

template <class Method, class System>
mechanics::RunResult make_run(const Form<System>& form, double end, long steps_per_unit,
                              std::vector<State<System>>& samples) {
  KeepSamples<System> hooks{samples, std::lround(end / n_intervals) * steps_per_unit};
  auto state = form.initial;
  typename Method::template Workspace<System> workspace(form.system);
  mechanics::Cursor cursor;
  return mechanics::run_time_loop<Method>(form.system, {end, n_intervals}, state, cursor, workspace, hooks);
}

template <class Method, class System>
void run(const Problem& problem, const Form<System>& form, double end, long steps_per_unit,
         std::ostream* file = nullptr) {
  std::vector<State<System>> samples;
  const Stopwatch watch;
  const auto result = make_run<Method>(form, end, steps_per_unit, samples);
  const double seconds = watch.seconds();
  const std::vector<Row> rows = compare(problem, form, samples);
  Row greatest{};
  for (const Row& r : rows) {
    if (file)
      *file << problem.name << ',' << Method::name << ',' << r.t << ',' << r.energy << ',' << r.J << ',' << r.Z << ','
            << r.constraint << ',' << r.error << '\n';
    greatest = {r.t,
                std::max(greatest.energy, std::abs(r.energy)),
                std::max(greatest.J, r.J),
                std::max(greatest.Z, r.Z),
                std::max(greatest.constraint, r.constraint),
                std::max(greatest.error, r.error)};
  }
  const auto [slope, uncertainty] = drift(rows);
  std::printf("%s,%s,%ld,%.0f,%.2e,%.2e,%.2e,%.2f,%.2e,%.2e,%.2e,%.2e,%.2f,%.4g,%s\n", problem.name, Method::name,
              steps_per_unit, greatest.t, greatest.energy, slope, uncertainty, growth_of_energy(rows), greatest.J,
              greatest.Z, greatest.constraint, greatest.error, growth_of_error(rows), seconds, result.reason.c_str());
  std::fflush(stdout);
}

template <class System>
Path reference(const Form<System>& form, double end, long steps_per_unit) {
  std::vector<State<System>> samples;
  (void)make_run<mechanics::Gauss16>(form, end, steps_per_unit, samples);
  Path path;
  for (const auto& state : samples) path.push_back(form.coordinates(state));
  return path;
}

void run_body(double end, std::ostream& file) {
  const auto form = sl3_form();
  const Problem problem{"sl3", momenta_of_body, reference(form, end, 8)};
  for (const long steps : {3, 4}) run<mechanics::Gauss16>(problem, form, end, steps);  // that no step is a lucky one
  run<mechanics::Gauss16>(problem, form, end, 6, &file);
  run<mechanics::Symmetric8>(problem, form, end, 128, &file);
  run<mechanics::Symmetric12>(problem, form, end, 80, &file);
  run<mechanics::Rattle8>(problem, form, end, 20);
  run<mechanics::Rattle8>(problem, form, end, 28, &file);
  run<mechanics::EnergyMomentum>(problem, form, end, 20, &file);
}

/// Gauss collocation on Euler's equation, the others on the constrained form.
void run_rigid_body(double end, std::ostream& file) {
  const auto form = rigid_body_form();
  const auto of_euler = euler_form();
  const Problem problem{"rigid_body", momenta_of_rigid_body, reference(of_euler, end, 2)};
  for (const long steps : {4, 8}) run<mechanics::Gauss16>(problem, of_euler, end, steps);
  run<mechanics::Gauss16>(problem, of_euler, end, 1, &file);
  run<mechanics::Symmetric8>(problem, form, end, 64, &file);
  run<mechanics::Rattle8>(problem, form, end, 12, &file);
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
  std::ofstream file(output);
  file << "problem,method,time,energy_error,J_error,Z_error,constraint_error,error\n";
  std::printf(
      "problem,method,steps_per_unit,end,energy_error,energy_drift,drift_error,energy_growth,J_error,Z_error,"
      "constraint_error,error,error_growth,seconds,failure\n");
  run_rigid_body(end, file);
  run_body(end, file);
  if (file.flush(); !file) {
    std::cerr << "cannot write " << output << "\n";
    return 3;
  }
  return 0;
}
