#pragma once
/// Accurate solutions for tests, by the explicit method of order 8. The method is compiled once (integrate.cpp), for
/// fields whose vectors have a dynamic size.

#include <Eigen/Core>
#include <algorithm>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "mechanics/core/second_order_field.h"
#include "mechanics/core/vector_space.h"

namespace pseudorigid::testing {

namespace detail {

/// A second-order field by its functions. If it has no invariant manifold, `project_onto` is empty.
struct FlatField {
  using Vector = Eigen::VectorXd;
  struct Workspace {};
  std::function<mechanics::Status(double, const Vector&, const Vector&, Vector&)> acceleration_at;
  std::function<mechanics::Status(Vector&, Vector&)> project_onto;
  Vector zero;

  mechanics::Status acceleration(double t, const Vector& q, const Vector& v, Workspace&, Vector& a) const {
    return acceleration_at(t, q, v, a);
  }
  mechanics::Status project(Vector& q, Vector& v, Workspace&) const {
    return project_onto ? project_onto(q, v) : mechanics::Status();
  }
  Vector make_vector() const { return zero; }
  Workspace make_workspace() const { return {}; }
};
using FlatState = mechanics::State<FlatField>;

std::vector<FlatState> integrate_to(const FlatField& field, FlatState state, const std::vector<double>& times,
                                    double tolerance);
FlatState integrate(const FlatField& field, FlatState state, double t_end, double tolerance);

template <class Vector>
void copy_entries(Vector& from, Eigen::VectorXd& to) {
  const auto entries = mechanics::local_values(from);
  to = Eigen::Map<const Eigen::VectorXd>(entries.data(), static_cast<Eigen::Index>(entries.size()));
}
template <class Vector>
void set_entries(const Eigen::VectorXd& from, Vector& to) {
  std::copy_n(from.data(), from.size(), mechanics::local_values(to).begin());
}

/// The field as a FlatField, which refers to it.
template <mechanics::SecondOrderField F>
FlatField flat_field(const F& field) {
  struct Own {
    explicit Own(const F& f)
        : workspace(f.make_workspace()), q(f.make_vector()), v(f.make_vector()), a(f.make_vector()) {}
    typename F::Workspace workspace;
    typename F::Vector q, v, a;
  };
  const auto own = std::make_shared<Own>(field);
  FlatField flat;
  copy_entries(own->a, flat.zero);
  flat.acceleration_at = [&field, own](double t, const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                                       Eigen::VectorXd& a) -> mechanics::Status {
    set_entries(q, own->q);
    set_entries(v, own->v);
    auto status = field.acceleration(t, own->q, own->v, own->workspace, own->a);
    copy_entries(own->a, a);
    return status;
  };
  if constexpr (mechanics::ProjectedField<F>)
    flat.project_onto = [&field, own](Eigen::VectorXd& q, Eigen::VectorXd& v) -> mechanics::Status {
      set_entries(q, own->q);
      set_entries(v, own->v);
      auto status = field.project(own->q, own->v, own->workspace);
      copy_entries(own->q, q);
      copy_entries(own->v, v);
      return status;
    };
  return flat;
}

template <class State>
FlatState flat_state(State state) {
  FlatState flat{state.t, {}, {}};
  copy_entries(state.q, flat.q);
  copy_entries(state.v, flat.v);
  return flat;
}
/// The state `like` with the time and the entries of `flat`.
template <class State>
State own_state(const FlatState& flat, State like) {
  like.t = flat.t;
  set_entries(flat.q, like.q);
  set_entries(flat.v, like.v);
  return like;
}

}  // namespace detail

/// The states of a second-order field at the given rising times, the first of which is not before the state's. Times
/// between steps are interpolated.
template <mechanics::SecondOrderField F>
std::vector<mechanics::State<F>> integrate_to(const F& field, const mechanics::State<F>& state,
                                              const std::vector<double>& times, double tolerance = 1e-13) {
  std::vector<mechanics::State<F>> samples;
  for (const auto& flat : detail::integrate_to(detail::flat_field(field), detail::flat_state(state), times, tolerance))
    samples.push_back(detail::own_state(flat, state));
  return samples;
}

/// The states at n + 1 equidistant times from the state's to t_end.
template <mechanics::SecondOrderField F>
std::vector<mechanics::State<F>> integrate_samples(const F& field, const mechanics::State<F>& state, double t_end,
                                                   int n, double tolerance = 1e-13) {
  std::vector<double> times;
  for (int k = 0; k <= n; ++k) times.push_back(k == n ? t_end : state.t + (t_end - state.t) * k / n);
  return integrate_to(field, state, times, tolerance);
}

/// The state at t_end (before state.t: backwards).
template <mechanics::SecondOrderField F>
mechanics::State<F> integrate(const F& field, const mechanics::State<F>& state, double t_end,
                              double tolerance = 1e-13) {
  return detail::own_state(detail::integrate(detail::flat_field(field), detail::flat_state(state), t_end, tolerance),
                           state);
}

}  // namespace pseudorigid::testing
