#pragma once
/// The jobs of a problem: every method at a range of tolerances or steps. Each problem is a translation unit of its
/// own, so that the compiler's limits on inlining meet own methods and rivals alike and not the last of a long list.

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "mechanics/methods/composition.h"
#include "mechanics/methods/dormand_prince_8.h"
#include "mechanics/methods/energy_momentum.h"
#include "mechanics/methods/symmetric_multistep.h"
#include "own_methods.h"
#include "rivals.h"

namespace pseudorigid::benchmarks {

inline Reference read_reference(const std::string& problem) {
  const std::string name = std::string(PSEUDORIGID_REFERENCES) + "/" + problem + ".csv";
  std::ifstream file(name);
  std::string line;
  Reference reference;
  std::getline(file, line);  // source
  std::getline(file, line);  // columns
  while (std::getline(file, line)) {
    std::istringstream cells(line);
    std::vector<double> row;
    for (std::string cell; std::getline(cells, cell, ',');) row.push_back(std::strtod(cell.c_str(), nullptr));
    reference.push_back(Eigen::Map<Eigen::VectorXd>(row.data() + 1, static_cast<Eigen::Index>(row.size()) - 1));
  }
  if (reference.size() != n_samples) {
    std::cerr << name << " does not hold " << n_samples << " samples; make_references writes it\n";
    std::exit(2);
  }
  return reference;
}

class JobList {
 public:
  explicit JobList(std::string problem) : problem_(std::move(problem)), reference_(read_reference(problem_)) {}

  /// run(form, parameter) → Recording, for every parameter; a parameter that is not a tolerance is the number of steps
  /// between two samples.
  template <class System, class Run>
  void add(const Form<System>& form, const std::string& method, bool tolerance, const std::vector<double>& parameters,
           Run run, const std::string& name_of_tolerance = "tolerance") {
    for (const double p : parameters)
      jobs.push_back({problem_, form.name.empty() ? method : method + " (" + form.name + ")",
                      tolerance ? name_of_tolerance : "step", tolerance ? p : end_time / n_samples / p,
                      [form, run, p, reference = reference_] { return judge(form, reference, run(form, p)); }});
  }
  template <class Method, class System>
  void add_own(const Form<System>& form, const std::vector<double>& parameters) {
    add(form, Method::name, Method::adaptive, parameters, run_own<Method, System>);
  }
  template <class System>
  void add_rivals(const Form<System>& form) {
    // The tightest ones are below round-off: they show the least error of a library.
    [[maybe_unused]] const auto tolerances = powers(1e-6, 1e-14), down_to_round_off = powers(1e-6, 1e-16);
#ifdef PSEUDORIGID_HAS_GSL
    add(form, "GSL rk8pd", true, down_to_round_off, run_gsl<System>);
#endif
#ifdef PSEUDORIGID_HAS_ODEINT
    add(form, "odeint rkf78", true, down_to_round_off, run_odeint_rkf78<System>);
    add(form, "odeint Bulirsch-Stoer", true, down_to_round_off, run_odeint_bulirsch_stoer<System>);
    add(form, "odeint Bulirsch-Stoer dense", true, tolerances, run_odeint_bulirsch_stoer_dense<System>);
#endif
#ifdef PSEUDORIGID_HAS_SUNDIALS
    add(form, "CVODE Adams", true, tolerances, [](const auto& f, double p) { return run_cvode(f, p, CV_ADAMS); });
    add(form, "CVODE BDF", true, tolerances, [](const auto& f, double p) { return run_cvode(f, p, CV_BDF); });
    add(form, "ARKODE order 8", true, tolerances, run_arkode<System>);
#endif
  }

  /// a, a/√10, … b
  static std::vector<double> powers(double a, double b) {
    std::vector<double> p;
    for (int i = 0; a * std::pow(10, -0.5 * i) > 0.9 * b; ++i) p.push_back(a * std::pow(10, -0.5 * i));
    return p;
  }

  std::vector<Job> jobs;

 private:
  std::string problem_;
  Reference reference_;
};

inline const std::vector<double> steps_of_order_2{40, 160, 640}, steps_of_order_4{8, 16, 32, 64, 128, 256},
    steps_of_order_6{4, 6, 8, 12, 16, 24, 32, 48, 64}, steps_of_order_8{4, 6, 8, 12, 16, 20, 24, 32, 40},
    steps_of_multistep{20, 24, 28, 32, 36, 40, 48, 56, 64, 72, 80, 96, 112, 128, 160, 192, 256};

/// The stages iterated to round-off, which keeps momenta, and to a tolerance.
template <class System>
void add_gauss(JobList& list, const Form<System>& form) {
  const std::vector<double> n_steps{1, 2, 3, 4, 5, 6, 8};
  const std::string name = mechanics::Gauss16::name;
  list.add(form, name, false, n_steps, [](const auto& f, double n) { return run_gauss(f, n, 0); });
  for (const double n : n_steps)
    list.add(
        form, name, true, JobList::powers(1e-5, 1e-13),
        [n](const auto& f, double tolerance) { return run_gauss(f, n, tolerance); },
        "tolerance with step 1/" + std::to_string(std::lround(n)));
}

template <class System>
void add_constrained(JobList& list, const Form<System>& form) {
  list.add_own<mechanics::Rattle>(form, steps_of_order_2);
  list.add_own<mechanics::Rattle4>(form, steps_of_order_4);
  list.add_own<mechanics::Rattle6>(form, steps_of_order_6);
  list.add_own<mechanics::Rattle8>(form, steps_of_order_8);
  list.add_own<mechanics::Symmetric8>(form, steps_of_multistep);
  list.add_own<mechanics::Symmetric12>(form, steps_of_multistep);
  if constexpr (mechanics::EnergyMomentum::fits<System>)
    list.add_own<mechanics::EnergyMomentum>(form, steps_of_order_2);
}

template <class System>
void add_explicit(JobList& list, const Form<System>& form) {
  list.add_own<mechanics::DormandPrince8>(form, JobList::powers(1e-6, 1e-15));
  list.add_rivals(form);
}

}  // namespace pseudorigid::benchmarks
