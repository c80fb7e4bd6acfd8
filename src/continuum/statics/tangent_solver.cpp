#include "continuum/statics/tangent_solver.h"

#include <algorithm>

#include "continuum/parallel/ranks.h"
#include "continuum/statics/multigrid.h"
#include "materials/rest_moduli.h"
#include "mechanics/equilibria/figure_solver_limits.h"

namespace pseudorigid::continuum {

bool uses_cycles(const FigureState& state) {
  const auto [shear, lame] = materials::moduli_at_rest(state.stored.law, state.incompressible);
  const double most = mechanics::largest_ratio_of_cycles * shear;
  return weight_of_surface(state) <= most && (state.incompressible || lame + state.stored.volumetric_stiffness <= most);
}

bool is_small(const BallSpace& space) { return 3 * space.n_global_nodes() <= mechanics::most_factorized_unknowns; }

namespace {

class Factorization final : public TangentSolver {
 public:
  Factorization(const FigureState& state, const HeldDirection* held)
      : problem_(state, 0, held), sector_(problem_, parity_of_sector(0)) {}

  mechanics::Status factorize() override { return sector_.factorize(); }
  bool factors_are_cheap() const override { return false; }
  mechanics::SolveReport solve(const Vector& f, const Vector& h, double tolerance, Vector& u, Vector& lambda) override {
    Eigen::VectorXd displacement, multiplier;
    const Eigen::VectorXd of_constraint =
        Eigen::Map<const Eigen::VectorXd>(h.begin(), static_cast<Eigen::Index>(h.locally_owned_size()));
    // Under strong gravity, a larger tolerance leads the iteration for figures astray.
    const auto report =
        sector_.solve(sector_.entries_of(f), of_constraint, std::min(tolerance, 1e-8), displacement, multiplier);
    if (!report.status) return report;
    u = sector_.field_of(displacement);
    std::ranges::copy(multiplier, lambda.begin());
    return report;
  }

 private:
  TangentProblem problem_;
  ParitySector sector_;
};

/// V-cycles, or a factorisation if they fail and the body is not too large.
class CyclesFirst final : public TangentSolver {
 public:
  CyclesFirst(const FigureState& state, const HeldDirection* held, int n_refinements)
      : state_(state), held_(held), solver_(std::make_unique<Multigrid>(state, held, n_refinements)) {}

  mechanics::Status factorize() override {
    const auto status = solver_->factorize();
    return status || !may_factorize() ? status : use_factorization();
  }
  bool factors_are_cheap() const override { return solver_->factors_are_cheap(); }
  mechanics::SolveReport solve(const Vector& f, const Vector& h, double tolerance, Vector& u, Vector& lambda) override {
    const auto report = solver_->solve(f, h, tolerance, u, lambda);
    if (report.status || !may_factorize()) return report;
    if (auto status = use_factorization(); !status) return {status};
    return solver_->solve(f, h, tolerance, u, lambda);
  }

 private:
  bool may_factorize() const { return factors_are_cheap() && is_small(state_.body.space()); }
  mechanics::Status use_factorization() {
    solver_ = std::make_unique<Factorization>(state_, held_);
    return solver_->factorize();
  }

  FigureState state_;
  const HeldDirection* held_;
  std::unique_ptr<TangentSolver> solver_;
};

}  // namespace

std::unique_ptr<TangentSolver> make_tangent_solver(const FigureState& state, const HeldDirection* held,
                                                   int n_refinements) {
  if (uses_cycles(state) || n_ranks(state.body.space().communicator()) > 1)
    return std::make_unique<CyclesFirst>(state, held, n_refinements);
  return std::make_unique<Factorization>(state, held);
}

}  // namespace pseudorigid::continuum
