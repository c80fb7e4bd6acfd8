#pragma once
/// The explicit Runge–Kutta method DOP853 of order 8 by Dormand and Prince for q̈ = a(t, q, q̇). The method has error
/// estimates of orders 5 and 3 and dense output of order 7. It is described in Hairer, Nørsett, Wanner, Solving
/// Ordinary Differential Equations I, II.5, II.6 and II.10. A step of size h starts at (t, q, v). Since q̇ = v, the
/// stages are accelerations A_j. With the coefficients of dormand_prince_8_tableau.h,
///
///   A_i = a(t + c_i h, q_i, v_i),   v_i = v + h Σ_j a_ij A_j,   q_i = q + c_i h v + h² Σ_j ā_ij A_j
///   v_{n+1} = v + h Σ_j b_j A_j,   q_{n+1} = q + h v + h² Σ_j b̄_j A_j,   projected if the field has `project`
///
/// The embedded formulas of orders p = 5, 3 estimate the errors e_p = (h² Σ ē^p_j A_j, h Σ e^p_j A_j) of (q, v), and
///
///   |e|² = |e_q|²/(1 + |q|)² + |e_v|²/(1 + |v|)²  (Euclidean norms: a rotation of space does not change the steps),
///   error = |e_5|² / √(|e_5|² + |e_3|²/100) ≤ tolerance.
///
/// Thus `tolerance` bounds the estimated local error of one step, relative to 1 + |q| and 1 + |v|. The global error is
/// proportional to the tolerance, with a factor that depends on the motion. The size of the next step is h · min(6,
/// max(1/3, 0.9 (tolerance/error)^{1/8})). If a step was shortened to end at a given time, the next size is at least
/// the size before the shortening. A trial step with error > tolerance is rejected, and the next trial has 0.2 to 0.9
/// of its size. An accepted trial that follows a rejection does not increase the size of the next step.
///
/// If the acceleration or the projection fails in a trial, or the acceleration is not finite, the next trial has a
/// quarter of the size. If the size of the next trial is below the round-off of the time, the step fails. The
/// increments of q and v are added with compensation (vector_space.h).

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "mechanics/core/second_order_field.h"
#include "mechanics/methods/dormand_prince_8_tableau.h"
#include "mechanics/methods/rattle.h"
#include "mechanics/methods/stage_sums.h"

namespace pseudorigid::mechanics {

template <SecondOrderField F>
struct DormandPrince8Workspace {
  using Vector = typename F::Vector;
  explicit DormandPrince8Workspace(const F& field, double tolerance = 1e-12)
      : system(field.make_workspace()),
        tolerance(tolerance),
        q_start(field.make_vector()),
        v_start(field.make_vector()),
        q_end(field.make_vector()),
        v_end(field.make_vector()),
        q_rounding(field.make_vector()),
        v_rounding(field.make_vector()),
        q_rounding_end(field.make_vector()),
        v_rounding_end(field.make_vector()),
        q_stage(field.make_vector()),
        v_stage(field.make_vector()) {
    A.fill(field.make_vector());
    dense_q.fill(field.make_vector());
    dense_v.fill(field.make_vector());
  }

  typename F::Workspace system;
  double tolerance;
  double h = 0;                    // size of the next step, negative backwards in time; 0: not yet chosen
  double h_max = HUGE_VAL;         // largest |h| of a step
  double t_start = 0, h_last = 0;  // start time and size of the last step
  Vector q_start, v_start, q_end, v_end;
  Vector q_rounding, v_rounding;          // remainders of the compensated sums of q and v
  Vector q_rounding_end, v_rounding_end;  // these remainders at the end of a trial step
  Vector q_stage, v_stage;
  std::array<Vector, dop853::n_all_stages> A;  // accelerations at the stages; A[12] is that at the end of the step
  std::array<Vector, 4> dense_q, dense_v;  // F₃ … F₆ of the dense output of q and v (DormandPrince8::evaluate)
  bool acceleration_known = false;  // true if A[12] is the acceleration at the state; clear it if you change the state
  bool dense_known = false;         // true if dense_q and dense_v belong to the last step
  Counters counters;

  /// Passes each member that a checkpoint must contain to `visit`.
  template <class Visit>
  void visit_memory(Visit&& visit) {
    if constexpr (requires { system.visit_memory(visit); }) system.visit_memory(visit);
    visit(h);
    visit(t_start);
    visit(h_last);
    for (Vector* x : {&q_start, &v_start, &q_end, &v_end, &q_rounding, &v_rounding}) visit(*x);
    for (Vector& x : A) visit(x);
    for (Vector& x : dense_q) visit(x);
    for (Vector& x : dense_v) visit(x);
    visit(acceleration_known);
    visit(dense_known);
  }
};

struct DormandPrince8 {
  static constexpr const char* name = "explicit-8";
  static constexpr const char* documentation =
      "explicit Runge-Kutta of order 8 (Dormand, Prince) with error control, projected onto the constraints";
  static constexpr int order = 8;
  static constexpr int n_stages = dop853::n_stages;
  static constexpr bool symplectic = false, symmetric = false;
  static constexpr bool adaptive = true, chosen_by_auto = true;

  template <class F>
  using Workspace = DormandPrince8Workspace<F>;
  template <class F>
  static constexpr bool fits = SecondOrderField<F>;

  /// Returns a failure for systems with internal variables (relaxation.h).
  template <SecondOrderField F>
  static Status accepts(const F& field) {
    if (relaxes(field)) return refuses_relaxation();
    return {};
  }

  /// Makes one accepted step that ends at t_limit at the latest. Does nothing if state.t is t_limit. The step goes
  /// backwards in time if t_limit < state.t. Fails if the acceleration at the start fails or is not finite, if
  /// `tolerance` or `h_max` is below round-off, or if trials fail down to the shortest step. A failure leaves the state
  /// unchanged. Every trial step counts as a substep.
  template <SecondOrderField F>
  static Status step(const F& field, double t_limit, State<F>& state, Workspace<F>& w) {
    if (t_limit == state.t) return {};
    if (Status status = start(field, t_limit, state, w); !status) return status;
    if (w.h_max < shortest_step(state.t, t_limit))
      return Status::failure("the bound of the step is shorter than the least difference of times in double precision");
    const double distance = t_limit - state.t;
    w.h = std::copysign(std::min(std::abs(w.h), w.h_max), distance);
    for (bool rejected = false;; rejected = true) {
      const bool last = std::abs(distance) <= 1.01 * std::abs(w.h);  // avoids a tiny step to t_limit
      const double h = last ? distance : w.h;
      double error = 0;  // estimated error divided by the tolerance
      Status status = try_step(field, h, state, w, error);
      if (status && error <= 1) {
        const double factor = std::clamp(0.9 * std::pow(error, -0.125), 1.0 / 3, rejected ? 1.0 : 6.0);
        w.h = last ? std::copysign(std::max(std::abs(w.h), std::abs(factor * h)), h) : factor * h;
        accept(last ? t_limit : state.t + h, h, state, w);
        return {};
      }
      w.h = h * (status ? std::clamp(0.9 * std::pow(error, -0.125), 0.2, 0.9) : 0.25);
      if (std::abs(w.h) < shortest_step(state.t, t_limit))
        return Status::failure("the motion cannot be continued, its steps shrink below round-off: " +
                               (status ? "their error stays above the tolerance" : status.reason()));
    }
  }

  /// Sets `out` to the state at the time t within the last step, by a polynomial of order 7 in θ = (t −
  /// t_start)/h_last. Projects `out` if the field has `project`. Fails if t is not within the last step, or if an
  /// additional stage or the projection fails.
  template <SecondOrderField F>
  static Status interpolate(const F& field, double t, State<F>& out, Workspace<F>& w) {
    const double theta = (t - w.t_start) / w.h_last;
    if (!(theta > -1e-9 && theta < 1 + 1e-9)) return Status::failure("the time asked for is not within the last step");
    if (Status status = prepare_dense_output(field, w); !status) return status;
    out.t = t;
    evaluate(theta, w.h_last, w.q_start, w.q_end, w.v_start, w.v_end, w.dense_q, out.q);
    evaluate(theta, w.h_last, w.v_start, w.v_end, w.A[0], w.A[dop853::n_stages], w.dense_v, out.v);
    if constexpr (ProjectedField<F>) return field.project(out.q, out.v, w.system);
    return {};
  }

 private:
  /// Returns the size below which a step counts as round-off of the time.
  static double shortest_step(double t, double t_limit) {
    return 16 * std::numeric_limits<double>::epsilon() * std::max(std::abs(t), std::abs(t_limit));
  }

  template <class F>
  static Status acceleration(const F& field, double t, const typename F::Vector& q, const typename F::Vector& v,
                             Workspace<F>& w, typename F::Vector& a) {
    ++w.counters.n_force;
    return field.acceleration(t, q, v, w.system, a);
  }

  /// Computes the acceleration at the state, and the size of the first step if it is not yet chosen. Does nothing if
  /// both are known. Fails if the tolerance is below round-off, or if the acceleration fails or is not finite.
  template <class F>
  static Status start(const F& field, double t_limit, const State<F>& state, Workspace<F>& w) {
    if (w.acceleration_known && w.h != 0) return {};
    if (!(w.tolerance >= std::numeric_limits<double>::epsilon()))
      return Status::failure("the tolerance is below round-off");
    auto& a = w.A[dop853::n_stages];
    Status status = acceleration(field, state.t, state.q, state.v, w, a);
    if (status && !std::isfinite(a.squaredNorm())) status = Status::failure("the acceleration is not finite");
    if (!status) return Status::failure("the motion cannot start: " + status.reason());
    w.acceleration_known = true;
    if (w.h == 0) w.h = first_step(field, t_limit, state, w);
    return {};
  }

  /// Returns the size of the first step by Hairer, Nørsett, Wanner, II.4. The sign of the result is that of t_limit −
  /// t. With the size h, h⁸ times the larger of the norms of (v, a) and (a, ȧ) is a hundredth of the tolerance. Here a
  /// is the acceleration at the start and ȧ an estimate of its rate. The norms are relative to 1 + |q| and 1 + |v|, and
  /// count as at least 1e-10. The size is at most 100 times a first guess and at most the distance to t_limit. If the
  /// acceleration at the first guess fails or is not finite, the size is a hundredth of the guess.
  template <class F>
  static double first_step(const F& field, double t_limit, const State<F>& state, Workspace<F>& w) {
    const auto norm = [&](const auto& x, const auto& y) {
      return std::hypot(x.norm() / (1 + state.q.norm()), y.norm() / (1 + state.v.norm()));
    };
    const auto& a = w.A[dop853::n_stages];
    const double rate = norm(state.v, a), longest = std::abs(t_limit - state.t);
    const double h0 = std::min(longest, 0.01 * norm(state.q, state.v) / std::max(rate, 1e-10) + 1e-6);
    const double direction = std::copysign(h0, t_limit - state.t);
    w.q_stage = state.q + direction * state.v;
    w.v_stage = state.v + direction * a;
    if (!acceleration(field, state.t + direction, w.q_stage, w.v_stage, w, w.A[1])) return 0.01 * direction;
    w.A[1] -= a;
    const double rate_of_rate = norm(direction * a, w.A[1]) / h0;
    if (!std::isfinite(rate_of_rate)) return 0.01 * direction;
    const double h1 = std::pow(0.01 * w.tolerance / std::max({rate, rate_of_rate, 1e-10}), 1.0 / order);
    return std::copysign(std::min({100 * h0, h1, longest}), direction);
  }

  /// Computes the stages of a step of size h, and sets `error` to the error estimate divided by the tolerance. If error
  /// ≤ 1, also computes the projected new state and its acceleration. The state is not changed; the results are in the
  /// workspace. Fails if the acceleration fails or is not finite, or if the projection fails.
  template <class F>
  static Status try_step(const F& field, double h, const State<F>& state, Workspace<F>& w, double& error) {
    ++w.counters.n_substeps;
    if (w.acceleration_known) {
      std::swap(w.A[0], w.A[dop853::n_stages]);
      w.acceleration_known = false;
    }
    if (Status status = evaluate_stages<1, dop853::n_stages>(field, state.t, h, state.q, state.v, w); !status)
      return status;
    error = estimate_error(h, state, w) / w.tolerance;
    if (!std::isfinite(error)) return Status::failure("the acceleration is not finite");
    if (error > 1) return {};
    return finish(field, h, state, w);
  }

  /// Computes the accelerations at the stages first, …, last − 1 of the step from (t, q, v). Fails if an acceleration
  /// fails.
  template <int first, int last, class F>
  static Status evaluate_stages(const F& field, double t, double h, const typename F::Vector& q,
                                const typename F::Vector& v, Workspace<F>& w) {
    if constexpr (first < last) {
      using Stage = dop853::Stage<first>;
      for (Eigen::Index k = 0; k < q.size(); ++k) {
        const double sum_q = detail::stage_sum(Stage::x.q, w.A, k);
        const double sum_v = detail::stage_sum(Stage::x.v, w.A, k);
        w.q_stage.data()[k] = q.data()[k] + h * (Stage::c * v.data()[k] + h * sum_q);
        w.v_stage.data()[k] = v.data()[k] + h * sum_v;
      }
      if (Status status = acceleration(field, t + Stage::c * h, w.q_stage, w.v_stage, w, w.A[first]); !status)
        return status;
      return evaluate_stages<first + 1, last>(field, t, h, q, v, w);
    }
    return {};
  }

  /// Returns the error estimate, `error` in the formulas at the head of this file.
  template <class F>
  static double estimate_error(double h, const State<F>& state, const Workspace<F>& w) {
    double q5 = 0, v5 = 0, q3 = 0, v3 = 0;
    const auto square = [](double x) { return x * x; };
    for (Eigen::Index k = 0; k < state.q.size(); ++k) {
      q5 += square(detail::stage_sum(dop853::Error5::x.q, w.A, k));
      v5 += square(detail::stage_sum(dop853::Error5::x.v, w.A, k));
      q3 += square(detail::stage_sum(dop853::Error3::x.q, w.A, k));
      v3 += square(detail::stage_sum(dop853::Error3::x.v, w.A, k));
    }
    const double q_scale = square(h * h / (1 + state.q.norm())), v_scale = square(h / (1 + state.v.norm()));
    const double e5 = q_scale * q5 + v_scale * v5, e3 = q_scale * q3 + v_scale * v3;
    return e5 == 0 ? 0 : e5 / std::sqrt(e5 + 0.01 * e3);
  }

  /// Computes and projects the new state, and evaluates its acceleration. Fails if the projection or the acceleration
  /// fails, or if the acceleration is not finite.
  template <class F>
  static Status finish(const F& field, double h, const State<F>& state, Workspace<F>& w) {
    using Stage = dop853::Stage<dop853::n_stages>;
    for (Eigen::Index k = 0; k < state.q.size(); ++k) {
      w.q_stage.data()[k] = state.v.data()[k] + h * detail::stage_sum(Stage::x.q, w.A, k);
      w.v_stage.data()[k] = detail::stage_sum(Stage::x.v, w.A, k);
    }
    w.q_end = state.q;
    w.v_end = state.v;
    w.q_rounding_end = w.q_rounding;
    w.v_rounding_end = w.v_rounding;
    add(h, w.q_stage, w.q_end, w.q_rounding_end);
    add(h, w.v_stage, w.v_end, w.v_rounding_end);
    if constexpr (ProjectedField<F>)
      if (Status status = field.project(w.q_end, w.v_end, w.system); !status) return status;
    auto& a = w.A[dop853::n_stages];
    if (Status status = acceleration(field, state.t + h, w.q_end, w.v_end, w, a); !status) return status;
    return std::isfinite(a.squaredNorm()) ? Status() : Status::failure("the acceleration is not finite");
  }

  /// Sets the state to the end of the trial step of size h, and its time to t. Stores the start of the step for the
  /// dense output.
  template <class F>
  static void accept(double t, double h, State<F>& state, Workspace<F>& w) {
    w.t_start = state.t;
    w.h_last = h;
    w.q_start = state.q;
    w.v_start = state.v;
    w.q_rounding = w.q_rounding_end;
    w.v_rounding = w.v_rounding_end;
    state.t = t;
    state.q = w.q_end;
    state.v = w.v_end;
    w.acceleration_known = true;
    w.dense_known = false;
  }

  /// Computes three more stages and F₃ … F₆ of the dense output, at most once per step. Fails if an acceleration fails.
  template <class F>
  static Status prepare_dense_output(const F& field, Workspace<F>& w) {
    if (w.dense_known) return {};
    const double h = w.h_last;
    if (Status status =
            evaluate_stages<dop853::n_stages + 1, dop853::n_all_stages>(field, w.t_start, h, w.q_start, w.v_start, w);
        !status)
      return status;
    set_dense_rows<0>(h, w);
    set_dense_rows<1>(h, w);
    set_dense_rows<2>(h, w);
    set_dense_rows<3>(h, w);
    w.dense_known = true;
    return {};
  }

  template <int i, class Workspace>
  static void set_dense_rows(double h, Workspace& w) {
    using Row = dop853::Dense<i>;
    for (Eigen::Index k = 0; k < w.q_end.size(); ++k) {
      w.dense_q[i].data()[k] = h * h * detail::stage_sum(Row::x.q, w.A, k);
      w.dense_v[i].data()[k] = h * detail::stage_sum(Row::x.v, w.A, k);
    }
  }

  /// Sets y (q or v) to the dense output y(θ) = y₀ + θ(F₀ + (1−θ)(F₁ + θ(F₂ + (1−θ)(F₃ + θ(F₄ + (1−θ)(F₅ + θF₆)))))).
  /// With the values y₀, y₁ and the rates y₀', y₁' at both ends, Hermite's coefficients are F₀ = y₁ − y₀, F₁ = h y₀' −
  /// F₀ and F₂ = 2F₀ − h(y₀' + y₁'). F₃ … F₆ are in `dense`.
  template <class V>
  static void evaluate(double theta, double h, const V& y0, const V& y1, const V& rate0, const V& rate1,
                       const std::array<V, 4>& dense, V& y) {
    const double eta = 1 - theta;
    for (Eigen::Index k = 0; k < y.size(); ++k) {
      const auto at = [k](const V& x) { return x.data()[k]; };
      const double F0 = at(y1) - at(y0), F1 = h * at(rate0) - F0, F2 = 2 * F0 - h * (at(rate0) + at(rate1));
      const double tail = at(dense[0]) + theta * (at(dense[1]) + eta * (at(dense[2]) + theta * at(dense[3])));
      y.data()[k] = at(y0) + theta * (F0 + eta * (F1 + theta * (F2 + eta * tail)));
    }
  }
};

}  // namespace pseudorigid::mechanics
