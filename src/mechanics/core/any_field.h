#pragma once
/// One type for any second-order field q̈ = a(t, q, q̇). With this type the compiler compiles each adaptive method once
/// and not once per system. The corresponding type for systems in constrained form is in any_system.h.

#include <memory>
#include <type_traits>
#include <utility>

#include "mechanics/core/any_workspace.h"
#include "mechanics/core/dynamic_vectors.h"
#include "mechanics/core/second_order_field.h"
#include "mechanics/core/stage_by_stage.h"

namespace pseudorigid::mechanics {

namespace detail {

template <SecondOrderField F>
requires(!ConstrainedSystem<F>) typename F::Workspace& own_workspace(AnyWorkspace& w) {
  return w.as<typename F::Workspace>();
}

/// Functions of a field that methods call, with vectors of dynamic size. The derived class HeldField converts these
/// vectors to the vectors of the concrete field (dynamic_vectors.h). `project` moves (q, v) to the invariant manifold
/// of the field. If the field has no such manifold, `project` succeeds without any change.
struct FieldInterface {
  using Vector = Eigen::VectorXd;
  virtual ~FieldInterface() = default;
  virtual Status acceleration(double t, const Vector& q, const Vector& v, AnyWorkspace& w, Vector& a) const = 0;
  virtual Status project(Vector& q, Vector& v, AnyWorkspace& w) const = 0;
  virtual Status solve_stages(GaussStages& stages, AnyWorkspace& w) const = 0;
  virtual AnyWorkspace make_workspace() const = 0;
};

template <SecondOrderField F>
class HeldField final : public FieldInterface {
  using Own = typename F::Vector;

 public:
  explicit HeldField(F field) : field_(std::move(field)) {}

  Status acceleration(double t, const Vector& q, const Vector& v, AnyWorkspace& w, Vector& a) const override {
    return field_.acceleration(t, read_as<Own>(q), read_as<Own>(v), own_workspace<F>(w), WriteAs<Own>(a));
  }
  Status project(Vector& q, Vector& v, AnyWorkspace& w) const override {
    if constexpr (ProjectedField<F>) return field_.project(WriteAs<Own>(q), WriteAs<Own>(v), own_workspace<F>(w));
    return {};
  }
  Status solve_stages(GaussStages& stages, AnyWorkspace& w) const override {
    return mechanics::solve_stages(field_, stages, own_workspace<F>(w));
  }
  AnyWorkspace make_workspace() const override { return AnyWorkspace(field_.make_workspace()); }

 private:
  F field_;
};

}  // namespace detail

/// A second-order field whose concrete type is known only at run time. The constructor stores the given field, and
/// copies of an AnyField share the stored field. `project` succeeds without any change if the stored field has no
/// invariant manifold.
class AnyField {
 public:
  using Vector = Eigen::VectorXd;
  using Workspace = AnyWorkspace;

  template <SecondOrderField F>
  requires(!std::is_same_v<F, AnyField>) explicit AnyField(F field)
      : velocity_dependent_(mechanics::velocity_dependent(field)),
        dissipative_(mechanics::dissipative(field)),
        time_dependent_(mechanics::time_dependent(field)),
        stages_in_lanes_(mechanics::has_stages_in_lanes(field)),
        cost_of_iteration_(mechanics::cost_of_iteration(field)),
        zero_(detail::flat(field.make_vector())),
        held_(std::make_shared<detail::HeldField<F>>(std::move(field))) {}

  Status acceleration(double t, const Vector& q, const Vector& v, Workspace& w, Vector& a) const {
    return held_->acceleration(t, q, v, w, a);
  }
  Status project(Vector& q, Vector& v, Workspace& w) const { return held_->project(q, v, w); }
  Status solve_stages(GaussStages& stages, Workspace& w) const { return held_->solve_stages(stages, w); }
  Vector make_vector() const { return zero_; }
  Workspace make_workspace() const { return held_->make_workspace(); }

  bool velocity_dependent() const { return velocity_dependent_; }
  bool dissipative() const { return dissipative_; }
  bool time_dependent() const { return time_dependent_; }
  bool has_stages_in_lanes() const { return stages_in_lanes_; }
  double cost_of_iteration() const { return cost_of_iteration_; }

 private:
  bool velocity_dependent_, dissipative_, time_dependent_, stages_in_lanes_;
  double cost_of_iteration_;
  Vector zero_;
  std::shared_ptr<const detail::FieldInterface> held_;
};

}  // namespace pseudorigid::mechanics
