#pragma once
/// A second-order field with reversed time. If q(t) is a motion of the field q̈ = a(t, q, q̇), then r(s) = q(−s) with
/// r' = −q̇ satisfies
///
///   r'' = a(−s, r, −r').
///
/// A force that dissipates energy in the motion q adds energy in the motion r.

#include <utility>

#include "mechanics/core/second_order_field.h"

namespace pseudorigid::mechanics {

template <SecondOrderField F>
class ReversedField {
 public:
  using Vector = typename F::Vector;
  struct Workspace {
    typename F::Workspace field;
    Vector v;
  };

  explicit ReversedField(F field) : field_(std::move(field)) {}

  Status acceleration(double s, const Vector& r, const Vector& rate, Workspace& w, Vector& a) const {
    w.v = -rate;
    return field_.acceleration(-s, r, w.v, w.field, a);
  }
  Status project(Vector& r, Vector& rate, Workspace& w) const requires ProjectedField<F> {
    w.v = -rate;
    Status status = field_.project(r, w.v, w.field);
    rate = -w.v;
    return status;
  }
  bool velocity_dependent() const { return mechanics::velocity_dependent(field_); }
  bool dissipative() const { return mechanics::dissipative(field_); }
  bool time_dependent() const { return mechanics::time_dependent(field_); }
  Vector make_vector() const { return field_.make_vector(); }
  Workspace make_workspace() const { return {field_.make_workspace(), field_.make_vector()}; }

 private:
  F field_;
};

}  // namespace pseudorigid::mechanics
