#include "continuum/constraint/gram_solver.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "continuum/constraint/dense_gram.h"
#include "continuum/constraint/two_level_gram.h"
#include "continuum/parallel/ranks.h"
#include "mechanics/core/conjugate_residuals.h"

namespace pseudorigid::continuum {

class GramSolver::Impl {
 public:
  Impl(const BallSpace& space, const CellKernels& kernels, GramMethod method)
      : space_(space),
        kernels_(kernels),
        method_(method),
        of_q0_(kernels, precision_of(method)),
        of_q1_(kernels, precision_of(method)),
        reaction_(space.make_vector()) {
    history_.renewed_at = space.make_vector();
    if (method == GramMethod::dense)
      preconditioner_ = std::make_unique<DenseGram>(space, kernels);
    else
      preconditioner_ = std::make_unique<TwoLevelGram>(space, kernels);
  }

  mechanics::SolveReport solve(const Vector& q1, const Vector& q0, const Vector& r, double enough, double shift,
                               Vector& lambda) {
    shift_ = shift;
    if (mechanics::Status status = history_.stale ? renew(q0) : restore(); !status) return {std::move(status), 0};
    if (shift > 0 && method_ == GramMethod::dense && inverse_suffices(q0, r)) {
      history_.n_iterations_fresh = 0;  // a renewed inverse suffices
      ++statistics_.n_solves;
      preconditioner_->apply(lambda, r);
      return {};
    }
    mechanics::SolveReport report = iterate(q1, q0, r, enough, lambda);
    if (!report.status) {
      if (mechanics::Status status = renew(q1); !status) return {std::move(status), report.iterations};
      mechanics::SolveReport second = iterate(q1, q0, r, enough, lambda);
      second.iterations += report.iterations;
      report = std::move(second);
    } else if (shift > 0 || history_.renewed_for == 0) {  // the other preconditioner is not for these solves
      if (history_.n_iterations_fresh < 0) history_.n_iterations_fresh = report.iterations;
      history_.n_iterations_lost += std::max(0, report.iterations - history_.n_iterations_fresh);
      history_.stale = history_.n_iterations_lost > preconditioner_->renewal_cost();
    }
    ++statistics_.n_solves;
    statistics_.n_iterations += report.iterations;
    statistics_.n_iterations_at_most = std::max<long>(statistics_.n_iterations_at_most, report.iterations);
    return report;
  }

  void add_reaction(const Vector& x, const Vector& lambda, Vector& f) {
    if (method_ != GramMethod::dense) return kernels_.add_reaction(x, lambda, f);
    of_q0_.move_to(x);
    kernels_.add_reaction(of_q0_.tangent(), lambda, f);
  }

  double force_with_reaction(const Vector& x, const Vector& lambda, Vector& f) {
    return kernels_.force_with_reaction(x, lambda, of_q0_.to_be_set_at(x), f);
  }

  History& history() { return history_; }

  Statistics statistics() const {
    Statistics statistics = statistics_;
    statistics.memory = preconditioner_->memory();
    return statistics;
  }

 private:
  /// True if the dense inverse alone gives a step of Newton's iteration for a compliant constraint. Its shift must be
  /// nearly σ, and the last step with it must have reduced the residual enough.
  bool inverse_suffices(const Vector& q0, const Vector& r) {
    constexpr double enough = 0.2, nearly = 0.05;
    if (std::abs(shift_ - history_.renewed_for) > nearly * shift_) return false;
    const double norm = r.l2_norm(), before = std::exchange(inverse_.norm, norm);
    const std::span<const double> values(q0.begin(), q0.locally_owned_size());
    if (std::ranges::equal(values, inverse_.q0))
      history_.contracts = norm <= enough * before;
    else
      inverse_.q0.assign(values.begin(), values.end());
    return history_.contracts && std::isfinite(norm);
  }

  mechanics::Status renew(const Vector& x) {
    mechanics::Status status = preconditioner_->renew(x, shift_);
    ++statistics_.n_renewals;
    is_made_ = true;
    history_.renewed_at = x;
    history_.renewed_for = shift_;
    history_.n_iterations_fresh = -1;
    history_.n_iterations_lost = 0;
    history_.stale = !status;
    history_.contracts = true;
    return status;
  }
  /// If this process has not yet computed a preconditioner, computes it at the positions history_.renewed_at. This is
  /// necessary after a restart from a checkpoint. Fails if the preconditioner cannot be computed.
  mechanics::Status restore() {
    if (std::exchange(is_made_, true)) return {};
    mechanics::Status status = preconditioner_->renew(history_.renewed_at, history_.renewed_for);
    history_.stale = !status;
    return status;
  }

  /// result = (G(q₁) M⁻¹ G(q₀)ᵀ + σ) λ, with the derivative G of the constraint and the mass M.
  void multiply(Vector& result, const Vector& lambda) {
    reaction_ = 0.0;
    kernels_.add_reaction(of_q0_.tangent(), lambda, reaction_);
    scale_by(space_.inverse_mass(), reaction_);
    kernels_.constraint_rate((is_symmetric_ ? of_q0_ : of_q1_).tangent(), reaction_, result);
    if (shift_ != 0) result.add(shift_, lambda);
  }

  mechanics::SolveReport iterate(const Vector& q1, const Vector& q0, const Vector& r, double enough, Vector& lambda) {
    const double norm = r.l2_norm();
    if (norm == 0) {
      lambda = 0.0;
      return {};
    }
    if (!std::isfinite(norm)) return {mechanics::Status::failure("the constraint's residual is not finite"), 0};
    is_symmetric_ = &q1 == &q0;
    of_q0_.move_to(q0);
    if (!is_symmetric_) of_q1_.move_to(q1);
    residual_ = r;
    constexpr int max_iterations = 200;
    const auto [n_iterations, converged] =
        iteration_.solve([&](const Vector& multiplier, Vector& result) { multiply(result, multiplier); },
                         [&](const Vector& residual, Vector& result) { preconditioner_->apply(result, residual); },
                         norm, std::max(reduction * norm, enough), max_iterations, residual_, lambda);
    if (converged) return {{}, n_iterations};
    return {mechanics::Status::failure("the multiplier's Gram system does not converge; use a smaller step"),
            n_iterations};
  }

  /// The precision of the tangents of the constraint. For small problems a tangent remains in the cache. It also gives
  /// the reactions, and therefore needs double precision. For large problems only the iterations use the tangent, and
  /// the methods check the constraint after each solve. Single precision then halves the memory that an iteration
  /// reads.
  static Precision precision_of(GramMethod method) {
    return method == GramMethod::dense ? Precision::double_precision : Precision::single_precision;
  }

  /// The tangent of the constraint at the positions of the last call of move_to or to_be_set_at. In double precision,
  /// move_to computes the tangent only if the positions differ from those of the last call. In single precision, every
  /// call of move_to computes the tangent.
  class TangentAt {
   public:
    TangentAt(const CellKernels& kernels, Precision precision)
        : kernels_(&kernels), tangent_(kernels.make_tangent(precision)) {}
    const ConstraintTangent& tangent() const { return *tangent_; }
    void move_to(const Vector& x) {
      if (tangent_->precision() == Precision::double_precision) {
        const std::span<const double> values(x.begin(), x.locally_owned_size());
        if (std::equal(values.begin(), values.end(), positions_.begin(), positions_.end())) return;
        positions_.assign(values.begin(), values.end());
      }
      kernels_->set_tangent(x, *tangent_);
    }
    /// Returns the tangent, whose values the caller must then set to those at x. Returns null if the tangent has single
    /// precision, because the caller needs double precision.
    ConstraintTangent* to_be_set_at(const Vector& x) {
      if (tangent_->precision() != Precision::double_precision) return nullptr;
      positions_.assign(x.begin(), x.begin() + x.locally_owned_size());
      return tangent_.get();
    }

   private:
    const CellKernels* kernels_;
    std::unique_ptr<ConstraintTangent> tangent_;
    std::vector<double> positions_;
  };

  const BallSpace& space_;
  const CellKernels& kernels_;
  const GramMethod method_;
  std::unique_ptr<GramPreconditioner> preconditioner_;
  TangentAt of_q0_, of_q1_;
  double shift_ = 0;           // σ of the present solve
  bool is_symmetric_ = false;  // true if q₁ and q₀ are the same object
  mechanics::ConjugateResiduals<Vector> iteration_;
  Vector reaction_, residual_;
  History history_;
  struct {
    std::vector<double> q0;
    double norm = 0;      // |r|
  } inverse_;             // of the last call of inverse_suffices
  bool is_made_ = false;  // true after the first attempt of this process to compute the preconditioner
  Statistics statistics_;
};

GramMethod fitting_gram_method(const BallSpace& space) {
  const bool alone = n_ranks(space.communicator()) == 1;
  const std::size_t n_multipliers = space.n_global_cells() * space.n_pressure();
  return alone && n_multipliers <= GramSolver::n_dense ? GramMethod::dense : GramMethod::two_level;
}

GramSolver::GramSolver(const BallSpace& space, const CellKernels& kernels, GramMethod method)
    : impl_(std::make_unique<Impl>(space, kernels, method)) {}
GramSolver::~GramSolver() = default;
GramSolver::GramSolver(GramSolver&&) noexcept = default;

mechanics::SolveReport GramSolver::solve(const Vector& q1, const Vector& q0, const Vector& r, double enough,
                                         double shift, Vector& lambda) {
  return impl_->solve(q1, q0, r, enough, shift, lambda);
}

double GramSolver::force_with_reaction(const Vector& x, const Vector& lambda, Vector& f) {
  return impl_->force_with_reaction(x, lambda, f);
}

void GramSolver::add_reaction(const Vector& x, const Vector& lambda, Vector& f) { impl_->add_reaction(x, lambda, f); }

GramSolver::History& GramSolver::history() { return impl_->history(); }

GramSolver::Statistics GramSolver::statistics() const { return impl_->statistics(); }

}  // namespace pseudorigid::continuum
