#include "continuum/statics/multigrid.h"

#include <algorithm>
#include <span>

#include "continuum/modes/krylov.h"
#include "materials/rest_moduli.h"

namespace pseudorigid::continuum {
namespace {

constexpr std::size_t n_direct = 400;
constexpr int n_iterations_of_cycles = 200;

}  // namespace

/// The factorised stiffness of the coarsest level.
struct Multigrid::Coarsest {
  struct Problem final : LinearProblem {
    Problem(const MultigridLevel& level, const StiffnessCoefficients& c) : LinearProblem(level.space(), false, 0, 1) {
      set_stiffness([&](unsigned int cell) { return level.cells().cell_matrix(c[cell]); });
      add_springs(level.springs());
    }
  };

  Coarsest(const MultigridLevel& level, const StiffnessCoefficients& c)
      : problem(level, c), sector(problem, parity_of_sector(0)) {}

  Problem problem;
  ParitySector sector;
};

Multigrid::Multigrid(const FigureState& state, const HeldDirection* held, int n_refinements)
    : state_(state),
      held_(held),
      bulk_(2 * materials::moduli_at_rest(state.stored.law, state.incompressible).shear +
            state.stored.volumetric_stiffness) {
  const BallSpace& space = state.body.space();
  levels_.push_back(std::make_unique<MultigridLevel>(state.body));
  std::size_t n_cells = space.n_global_cells();
  MPI_Comm communicator = space.communicator();
  for (int degree = space.degree(); degree > 1 || n_refinements > 0;) {
    if (degree > 1)
      degree = (degree + 1) / 2;
    else
      --n_refinements, n_cells /= 8, communicator = MPI_COMM_SELF;
    const std::size_t n_unknowns = n_cells * static_cast<std::size_t>(3 * degree * degree * degree);
    const bool is_last = n_unknowns <= n_direct || (degree == 1 && n_refinements == 0);
    if (is_last) communicator = MPI_COMM_SELF;
    levels_.push_back(std::make_unique<MultigridLevel>(space.mesh().sector(), state.stored, n_refinements, degree,
                                                       !is_last, communicator));
    transfers_.emplace_back(levels_.end()[-2]->space(), levels_.back()->space());
    if (is_last) break;
  }
}

Multigrid::~Multigrid() = default;

mechanics::Status Multigrid::factorize() {
  const MultigridLevel& finest = *levels_.front();
  const auto coefficients = [&](Balance balance) {
    StiffnessCoefficients c;
    for (unsigned int cell = 0; cell < finest.space().n_cells(); ++cell)
      c.push_back(tangent_coefficients(finest.cells(), state_, cell, balance));
    return c;
  };
  const double weight = weight_of_surface(state_);
  StiffnessCoefficients c = coefficients(Balance::multiplier);
  if (weight > 0) {
    whole_ = make_stiffness(state_.body.kernels(), c);
    c = coefficients(Balance::mean_stress);
  }
  Vector x = state_.x;
  for (std::size_t l = 0; l < levels_.size(); ++l) {
    if (l > 0) c = transfers_[l - 1].at_coarser_points(c);
    std::vector<FaceSprings> springs;
    if (weight > 0) {
      if (l > 0) x = transfers_[l - 1].at_coarser_nodes(x);
      springs = springs_of_weight(levels_[l]->space(), x, weight);
    }
    if (auto status = levels_[l]->set(c, std::move(springs)); !status) return status;
  }
  coarsest_ = std::make_unique<Coarsest>(*levels_.back(), c);
  if (state_.incompressible) {
    constraint_ = state_.body.kernels().make_tangent(Precision::single_precision);
    state_.body.kernels().set_tangent(state_.x, *constraint_);
  }
  return coarsest_->sector.factorize();
}

void Multigrid::product(const Vector& u, Vector& f) const {
  if (whole_) {
    state_.body.kernels().stiffness_product(*whole_, u, f);
    if (state_.body.gravity()) f += rate_of_gravity(state_, u, parity_of_sector(0));
  } else {
    levels_.front()->product(u, f);
  }
  add_rate_beyond_cells(state_, held_, u, f);
}

void Multigrid::cycle(std::size_t l, const Vector& f, Vector& u) const {
  const MultigridLevel& level = *levels_[l];
  if (l + 1 == levels_.size()) {
    Eigen::VectorXd entries = coarsest_->sector.entries_of(f);
    coarsest_->sector.solve_penalized<1>(entries);
    u = coarsest_->sector.field_of(entries);
    return;
  }
  u = 0.0;
  Vector r = f;
  level.smooth(f, r, u);
  level.residual(f, u, r);
  const MultigridLevel& coarser = *levels_[l + 1];
  Vector of_coarser = coarser.make_vector(), correction = coarser.make_vector();
  transfers_[l].restrict_to_coarser(r, of_coarser);
  cycle(l + 1, of_coarser, correction);
  transfers_[l].add_interpolated(correction, u);
  level.residual(f, u, r);
  level.smooth(f, r, u);
}

mechanics::SolveReport Multigrid::solve(const Vector& f, const Vector& h, double tolerance, Vector& u, Vector& lambda) {
  const CellKernels& kernels = state_.body.kernels();
  const bool incompressible = state_.incompressible;
  const std::size_t n = f.locally_owned_size(), n_all = n + (incompressible ? h.locally_owned_size() : 0);
  Vector displacement = state_.body.make_vector(), force = displacement, corrected = displacement;
  Vector multiplier = state_.body.space().make_multiplier(), rate = multiplier;
  // The unknowns of GMRES are u and λ/(2μ + κ), which have no unit.
  const auto precondition = [&](const Vector& of_force, const Vector& of_constraint, std::span<double> out) {
    cycle(of_force, corrected);
    std::copy_n(corrected.begin(), n, out.begin());
    if (!incompressible) return;
    kernels.constraint_rate(*constraint_, corrected, rate);
    for (std::size_t i = n; i < n_all; ++i) out[i] = of_constraint.begin()[i - n] - rate.begin()[i - n];
  };
  const LinearOperator preconditioned = [&](std::span<const double> in, std::span<double> out) -> mechanics::Status {
    std::copy_n(in.begin(), n, displacement.begin());
    product(displacement, force);
    if (incompressible) {
      for (std::size_t i = n; i < n_all; ++i) multiplier.begin()[i - n] = -bulk_ * in[i];
      kernels.add_reaction(*constraint_, multiplier, force);
      kernels.constraint_rate(*constraint_, displacement, multiplier);
    }
    state_.body.space().clear_fixed(force);
    precondition(force, multiplier, out);
    return {};
  };
  std::vector<double> right(n_all), solution;
  precondition(f, h, right);
  const mechanics::SolveReport report = solve_by_gmres(preconditioned, right, tolerance, 0, n_iterations_of_cycles,
                                                       solution, state_.body.space().communicator());
  if (!report.status) return report;
  std::copy_n(solution.begin(), n, u.begin());
  for (std::size_t i = n; i < n_all; ++i) lambda.begin()[i - n] = bulk_ * solution[i];
  return report;
}

}  // namespace pseudorigid::continuum
