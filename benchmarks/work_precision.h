#pragma once
/// One run of one method at one tolerance or step: what it delivers, and how it is judged.

#include <time.h>
#include <Eigen/Core>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "problems.h"

namespace pseudorigid::benchmarks {

/// What a run leaves: its samples, and what it took. The clock runs from the construction of the integrator to the last
/// sample; samples are stored within that time and looked at after it.
template <class System>
struct Recording {
  std::vector<State<System>> samples{};
  double seconds = 0;
  long n_evaluations = 0;
  std::string failure{};  ///< one sentence; empty if all samples were delivered
};

struct Result {
  double seconds = 0;
  long n_evaluations = 0;
  double error = 0, constraint_error = 0, energy_error = 0;  // greatest over the samples; energy relative
  std::string failure;
};

/// A run that can be repeated.
struct Job {
  std::string problem, method, parameter_name;  // parameter: "tolerance …", or "step"
  double parameter;
  std::function<Result()> run;
};

std::vector<Job> sl3_jobs();
std::vector<Job> rigid_body_jobs();
std::vector<Job> double_pendulum_jobs();
std::vector<Job> gravitating_jobs();

/// Rows of a reference: the coordinates at the samples.
using Reference = std::vector<Eigen::VectorXd>;

template <class System>
Result judge(const Form<System>& form, const Reference& reference, const Recording<System>& recording) {
  Result r{recording.seconds, recording.n_evaluations, 0, 0, 0, recording.failure};
  if (!r.failure.empty()) return r;
  const double energy = form.energy(form.initial);
  for (std::size_t k = 0; k < reference.size(); ++k) {
    const auto& s = recording.samples[k];
    const double error = (form.coordinates(s) - reference[k]).cwiseAbs().maxCoeff();
    if (!std::isfinite(error)) return {r.seconds, r.n_evaluations, HUGE_VAL, HUGE_VAL, HUGE_VAL, "not finite"};
    r.error = std::max(r.error, error);
    r.constraint_error = std::max(r.constraint_error, form.constraint_error(s));
    r.energy_error = std::max(r.energy_error, std::abs(form.energy(s) / energy - 1));
  }
  return r;
}

/// Time that the processor has given to this thread: other work on the machine counts little.
class Stopwatch {
 public:
  double seconds() const { return now() - start_; }

 private:
  static double now() {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
  }
  double start_ = now();
};

inline double sample_time(int k) { return end_time * (k + 1.0) / n_samples; }

}  // namespace pseudorigid::benchmarks
