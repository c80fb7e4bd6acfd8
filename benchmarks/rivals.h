#pragma once
/// Runs of other libraries' integrators on the same right-hand side, as y = (q, v), ẏ = (v, a(t, q, v)).

#include <algorithm>
#include <array>
#include <cstring>
#include <stdexcept>

#include "work_precision.h"

#ifdef PSEUDORIGID_HAS_GSL
#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>
#endif
#ifdef PSEUDORIGID_HAS_ODEINT
#include <boost/numeric/odeint.hpp>
#endif
#ifdef PSEUDORIGID_HAS_SUNDIALS
#include <arkode/arkode_arkstep.h>
#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>
#endif

namespace pseudorigid::benchmarks {

/// The right-hand side in the shape of these libraries. Vectors without alignment of their own are used in place.
template <class System>
class FirstOrder {
 public:
  using Vector = typename System::Vector;
  static constexpr std::size_t n = Vector::SizeAtCompileTime;
  using Y = std::array<double, 2 * n>;

  explicit FirstOrder(const Form<System>& form) : system_(form.system), workspace_(form.system.make_workspace()) {}

  bool operator()(double t, const double* y, double* rate) {
    ++n_evaluations;
    std::memcpy(rate, y + n, n * sizeof(double));
    if constexpr (alignof(Vector) <= alignof(double)) {
      const auto& q = *reinterpret_cast<const Vector*>(y);
      const auto& v = *reinterpret_cast<const Vector*>(y + n);
      return system_.acceleration(t, q, v, workspace_, *reinterpret_cast<Vector*>(rate + n)).ok();
    } else {
      const Vector q(y), v(y + n);
      Vector a;
      const bool ok = system_.acceleration(t, q, v, workspace_, a).ok();
      std::memcpy(rate + n, a.data(), n * sizeof(double));
      return ok;
    }
  }
  static Y pack(const State<System>& s) {
    Y y;
    std::copy_n(s.q.data(), n, y.begin());
    std::copy_n(s.v.data(), n, y.begin() + n);
    return y;
  }
  static State<System> unpack(double t, const double* y) { return {t, Vector(y), Vector(y + n)}; }

  long n_evaluations = 0;

 private:
  const System& system_;
  typename System::Workspace workspace_;
};

inline constexpr double first_step = 0.01;

#ifdef PSEUDORIGID_HAS_GSL
/// GNU Scientific Library: rk8pd (Prince, Dormand 8(7)) with its step control, evolution functions (level 2). The step
/// that a sample cuts short is remembered by the library.
template <class System>
Recording<System> run_gsl(const Form<System>& form, double tolerance) {
  using Ode = FirstOrder<System>;
  Recording<System> r;
  r.samples.reserve(n_samples);
  const Stopwatch watch;
  Ode ode(form);
  gsl_odeiv2_system system{[](double t, const double* y, double* rate, void* ode) -> int {
                             return (*static_cast<Ode*>(ode))(t, y, rate) ? GSL_SUCCESS : GSL_EBADFUNC;
                           },
                           nullptr, 2 * Ode::n, &ode};
  auto* step = gsl_odeiv2_step_alloc(gsl_odeiv2_step_rk8pd, 2 * Ode::n);
  auto* control = gsl_odeiv2_control_y_new(tolerance, tolerance);
  auto* evolve = gsl_odeiv2_evolve_alloc(2 * Ode::n);
  auto y = Ode::pack(form.initial);
  double t = 0, h = first_step;
  for (int k = 0; k < n_samples && r.failure.empty(); ++k) {
    while (t < sample_time(k))
      if (const int code = gsl_odeiv2_evolve_apply(evolve, control, step, &system, &t, sample_time(k), &h, y.data());
          code != GSL_SUCCESS) {
        r.failure = gsl_strerror(code);
        break;
      }
    r.samples.push_back(Ode::unpack(t, y.data()));
  }
  gsl_odeiv2_evolve_free(evolve);
  gsl_odeiv2_control_free(control);
  gsl_odeiv2_step_free(step);
  r.seconds = watch.seconds();
  r.n_evaluations = ode.n_evaluations;
  return r;
}
#endif

#ifdef PSEUDORIGID_HAS_ODEINT
/// Boost.odeint on std::array (array_algebra: loops of known length). Stepper: a controlled or a dense-output stepper.
template <class System, class MakeStepper>
Recording<System> run_odeint(const Form<System>& form, MakeStepper make_stepper) {
  using Ode = FirstOrder<System>;
  Recording<System> r;
  r.samples.reserve(n_samples);
  const Stopwatch watch;
  Ode ode(form);
  auto y = Ode::pack(form.initial);
  std::array<double, n_samples + 1> times{};
  for (int k = 0; k < n_samples; ++k) times[k + 1] = sample_time(k);
  try {
    boost::numeric::odeint::integrate_times(
        make_stepper(),
        [&](const typename Ode::Y& y, typename Ode::Y& rate, double t) {
          if (!ode(t, y.data(), rate.data())) throw std::runtime_error("the right-hand side fails");
        },
        y, times.begin(), times.end(), first_step,
        [&](const typename Ode::Y& y, double t) {
          if (t > 0) r.samples.push_back(Ode::unpack(t, y.data()));
        });
  } catch (const std::exception& e) {
    r.failure = e.what();
  }
  r.seconds = watch.seconds();
  r.n_evaluations = ode.n_evaluations;
  return r;
}

template <class System>
Recording<System> run_odeint_rkf78(const Form<System>& form, double tolerance) {
  using Y = typename FirstOrder<System>::Y;
  return run_odeint(form, [=] {
    return boost::numeric::odeint::make_controlled<boost::numeric::odeint::runge_kutta_fehlberg78<Y>>(tolerance,
                                                                                                      tolerance);
  });
}
template <class System>
Recording<System> run_odeint_bulirsch_stoer(const Form<System>& form, double tolerance) {
  using Y = typename FirstOrder<System>::Y;
  return run_odeint(form, [=] { return boost::numeric::odeint::bulirsch_stoer<Y>(tolerance, tolerance); });
}
template <class System>
Recording<System> run_odeint_bulirsch_stoer_dense(const Form<System>& form, double tolerance) {
  using Y = typename FirstOrder<System>::Y;
  return run_odeint(form, [=] { return boost::numeric::odeint::bulirsch_stoer_dense_out<Y>(tolerance, tolerance); });
}
#endif

#ifdef PSEUDORIGID_HAS_SUNDIALS
/// What the integrators of SUNDIALS share: context, the vector y, the right-hand side.
template <class System>
struct SundialsRun {
  using Ode = FirstOrder<System>;
  Ode ode;
  typename Ode::Y values;
  SUNContext context = nullptr;
  N_Vector y = nullptr;

  explicit SundialsRun(const Form<System>& form) : ode(form), values(Ode::pack(form.initial)) {
    SUNContext_Create(nullptr, &context);
    y = N_VMake_Serial(2 * Ode::n, values.data(), context);
  }
  ~SundialsRun() {
    N_VDestroy(y);
    SUNContext_Free(&context);
  }
  SundialsRun(const SundialsRun&) = delete;
  SundialsRun& operator=(const SundialsRun&) = delete;

  static int rate(double t, N_Vector y, N_Vector rate, void* ode) {
    return (*static_cast<Ode*>(ode))(t, N_VGetArrayPointer(y), N_VGetArrayPointer(rate)) ? 0 : 1;
  }
};

inline constexpr long sundials_max_steps = 10'000'000;

/// CVODE: Adams with functional iteration or BDF with Newton's (dense difference Jacobian), interpolating the samples.
template <class System>
Recording<System> run_cvode(const Form<System>& form, double tolerance, int family) {
  Recording<System> r;
  r.samples.reserve(n_samples);
  const Stopwatch watch;
  SundialsRun<System> run(form);
  using Ode = FirstOrder<System>;
  void* cvode = CVodeCreate(family, run.context);
  CVodeInit(cvode, run.rate, 0, run.y);
  CVodeSetUserData(cvode, &run.ode);
  CVodeSStolerances(cvode, tolerance, tolerance);
  CVodeSetMaxNumSteps(cvode, sundials_max_steps);
  CVodeSetErrFile(cvode, nullptr);
  SUNNonlinearSolver iteration = nullptr;
  SUNMatrix jacobian = nullptr;
  SUNLinearSolver linear = nullptr;
  if (family == CV_ADAMS) {
    iteration = SUNNonlinSol_FixedPoint(run.y, 0, run.context);
    CVodeSetNonlinearSolver(cvode, iteration);
  } else {
    jacobian = SUNDenseMatrix(2 * Ode::n, 2 * Ode::n, run.context);
    linear = SUNLinSol_Dense(run.y, jacobian, run.context);
    CVodeSetLinearSolver(cvode, linear, jacobian);
  }
  double t = 0;
  for (int k = 0; k < n_samples && r.failure.empty(); ++k) {
    if (const int code = CVode(cvode, sample_time(k), run.y, &t, CV_NORMAL); code < 0)
      r.failure = "CVode returns " + std::to_string(code);
    r.samples.push_back(Ode::unpack(t, run.values.data()));
  }
  CVodeFree(&cvode);
  if (iteration) SUNNonlinSolFree(iteration);
  if (linear) SUNLinSolFree(linear);
  if (jacobian) SUNMatDestroy(jacobian);
  r.seconds = watch.seconds();
  r.n_evaluations = run.ode.n_evaluations;
  return r;
}

/// ARKODE: explicit Runge–Kutta of order 8 (its highest). Its interpolation is of order 5 at most, so steps end at the
/// samples.
template <class System>
Recording<System> run_arkode(const Form<System>& form, double tolerance) {
  Recording<System> r;
  r.samples.reserve(n_samples);
  const Stopwatch watch;
  SundialsRun<System> run(form);
  void* arkode = ARKStepCreate(run.rate, nullptr, 0, run.y, run.context);
  ARKStepSetUserData(arkode, &run.ode);
  ARKStepSetOrder(arkode, 8);
  ARKStepSStolerances(arkode, tolerance, tolerance);
  ARKStepSetMaxNumSteps(arkode, sundials_max_steps);
  ARKStepSetErrFile(arkode, nullptr);
  double t = 0;
  for (int k = 0; k < n_samples && r.failure.empty(); ++k) {
    ARKStepSetStopTime(arkode, sample_time(k));
    if (const int code = ARKStepEvolve(arkode, sample_time(k), run.y, &t, ARK_NORMAL); code < 0)
      r.failure = "ARKStepEvolve returns " + std::to_string(code);
    r.samples.push_back(FirstOrder<System>::unpack(t, run.values.data()));
  }
  ARKStepFree(&arkode);
  r.seconds = watch.seconds();
  r.n_evaluations = run.ode.n_evaluations;
  return r;
}
#endif

}  // namespace pseudorigid::benchmarks
