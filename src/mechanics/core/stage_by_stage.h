#pragma once
/// Solves for the stages of a Gauss step (gauss_16.h) of any second-order field. A field that evaluates all stages at
/// once in SIMD lanes has a member `solve_stages_in_lanes(stages)`. If this member returns false, it has done nothing,
/// and the stages are evaluated one by one. The stages of all other fields are also evaluated one by one. An AnyField
/// (any_field.h) has a member `solve_stages(stages, workspace)`, which calls solve_stages for the concrete field.

#include <concepts>
#include <cstddef>

#include "mechanics/core/gauss_stages.h"
#include "mechanics/core/second_order_field.h"

namespace pseudorigid::mechanics {

namespace detail {

/// A second-order field as a GaussField, which evaluates the stages one by one. The field and the workspace must exist
/// as long as this object.
template <SecondOrderField F>
class StageByStage final : public GaussField {
  using Vector = typename F::Vector;

 public:
  StageByStage(const F& field, typename F::Workspace& workspace)
      : field_(field), workspace_(workspace), q_(field.make_vector()), v_(q_), a_(q_) {}

  bool evaluate(const GaussStages& s, const OfStages* q, const OfStages* v, OfStages* a) const override {
    for (std::size_t i = 0; i < gauss::n_stages; ++i) {
      for (int k = 0; k < s.n; ++k) {
        q_.data()[k] = q[k][i];
        v_.data()[k] = v[k][i];
      }
      reason_ = field_.acceleration(s.t + s.tables->c[i], q_, v_, workspace_, a_);
      if (!reason_) return false;
      for (int k = 0; k < s.n; ++k) a[k][i] = a_.data()[k];
    }
    return true;
  }
  /// Returns the status of the last evaluation. A failure contains the reason.
  Status reason() const { return reason_; }

 private:
  const F& field_;
  typename F::Workspace& workspace_;
  mutable Vector q_, v_, a_;
  mutable Status reason_;
};

}  // namespace detail

/// Returns true if the field can evaluate its stages in lanes. In measurements the evaluation in lanes took about a
/// quarter of the time of an evaluation one by one.
template <class F>
bool has_stages_in_lanes(const F& field) {
  if constexpr (requires { field.has_stages_in_lanes(); })
    return field.has_stages_in_lanes();
  else
    return requires(GaussStages & stages) { field.solve_stages_in_lanes(stages); };
}

/// Returns the cost of an iteration on the eight stages, which the step search uses. The unit is the cost of one force
/// evaluation of the system. The cost is the result of the field's member `cost_of_iteration()`. Without this member,
/// the cost is 8, the number of stages.
template <class F>
double cost_of_iteration(const F& field) {
  if constexpr (requires { field.cost_of_iteration(); })
    return field.cost_of_iteration();
  else
    return gauss::n_stages;
}

/// Solves for the stages of a field by evaluations at one stage after the other. If an evaluation fails, returns its
/// failure. Otherwise returns success, even if the iteration does not converge. Sets stages.converged to true only if
/// the iteration converges and no evaluation fails. Throws NoKernels in the same cases as solve_gauss_stages
/// (gauss_stages.h).
template <SecondOrderField F>
Status solve_one_by_one(const F& field, GaussStages& stages, typename F::Workspace& w) {
  const detail::StageByStage<F> by_stage(field, w);
  solve_gauss_stages(by_stage, stages);
  return by_stage.reason();
}

/// Solves for the stages in the fastest way that the field supports. Fails if the field cannot be evaluated at a stage.
/// Sets stages.converged to true if the stages are found. If the iteration does not converge, the function succeeds
/// with stages.converged = false. Throws NoKernels in the same cases as solve_gauss_stages (gauss_stages.h).
template <SecondOrderField F>
Status solve_stages(const F& field, GaussStages& stages, typename F::Workspace& w) {
  if constexpr (requires { field.solve_stages(stages, w); }) {
    return field.solve_stages(stages, w);
  } else {
    if constexpr (requires { field.solve_stages_in_lanes(stages); })
      if (field.solve_stages_in_lanes(stages)) return {};
    return solve_one_by_one(field, stages, w);
  }
}

}  // namespace pseudorigid::mechanics
