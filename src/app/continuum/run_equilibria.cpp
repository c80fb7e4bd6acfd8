#include "app/continuum/run_equilibria.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <optional>

#include "app/continuum/figure_setup.h"
#include "app/continuum/sector_ranks.h"
#include "app/figures/continuum_figure_columns.h"
#include "continuum/statics/figure_stability.h"
#include "continuum/statics/observe_figure.h"
#include "scene/discretization.h"

namespace pseudorigid::app {
namespace {

using mechanics::FigureFamily, mechanics::FigureMember, mechanics::SpecialFigure;

/// The largest difference |s_a − s_b| between the rates s of small motions about two figures, among the n_slowest_rates
/// rates of a row.
double difference_of_rates(const FigureMember& a, const FigureMember& b) {
  const auto rates = slowest_rates(a), others = slowest_rates(b);
  double largest = 0;
  for (std::size_t i = 0; i < rates.size(); ++i) largest = std::max(largest, std::abs(rates[i] - others[i]));
  return largest;
}

/// The error of the rates of a figure that the finite basis of the small motions causes. The difference from the rates
/// in the smaller basis is regarded as its bound.
double error_of_basis(const FigureMember& member) {
  FigureMember in_smaller_basis = member;
  for (mechanics::ClassStability& of_class : in_smaller_basis.classes) of_class.stability = of_class.in_smaller_basis;
  return difference_of_rates(member, in_smaller_basis);
}

/// The family of the scene on one discretisation.
class FamilyOnMesh {
 public:
  FamilyOnMesh(const RunContext& context, const scene::Discretization& discretization)
      : context_(context),
        family_(family_of_figures(context.scene, context.scene.equilibria.family)),
        figures_(setup(context, discretization, family_.figure), sector_ranks(context)) {}

  /// The family of figures of the scene, as a family of `run`. If the scene requests the figure at rest, the family has
  /// only this figure, for the loads times `factor`. Otherwise `factor` is not used.
  FigureFamily family(double factor, FigureRun& run) const {
    if (scene::finds_static_equilibria(context_.scene)) return mechanics::figure_at_rest(figures_, analysis(), factor);
    return run.next_family([&](const auto&... arguments) { return finder().family(arguments...); });
  }
  /// Computes the numbers of a row for a member. Fails if they cannot be computed.
  mechanics::Status numbers(const FigureMember& member, FigureNumbers& numbers) const {
    if (auto status = observe_figure(figures_, member.figure, numbers.observables, numbers.surface); !status)
      return status;
    numbers.degree = figures_.body().space().degree();
    numbers.spin = figures_.drive() == continuum::Drive::rotation ? std::sqrt(std::max(member.figure.drive, 0.0)) : 0;
    numbers.axes = numbers.observables.Q.diagonal();
    return {};
  }
  const continuum::BallFigures& figures() const { return figures_; }

 private:
  /// The setup of the figures, with a line in the log for each step of Newton's iteration.
  static continuum::FigureSetup setup(const RunContext& context, const scene::Discretization& discretization,
                                      mechanics::Figure figure) {
    auto result = figure_setup(context.scene, discretization.degree, discretization.refinements, figure);
    result.watch = [&context](const continuum::NewtonStep& step) {
      context.log->debug("  Newton's iteration, step {}: residual {:.1e} of the terms, {} iterations of GMRES",
                         step.number, step.residual, step.n_linear_products);
    };
    return result;
  }
  mechanics::FigureFinder finder() const {
    // A special point has the error of the mesh, so it need not be located up to round-off.
    constexpr double resolution = 1e-7;
    return {figures_, analysis(), family_, resolution};
  }
  mechanics::StabilityOfFigure analysis() const {
    return [this](const auto& figure, auto only, auto& classes) {
      if (!context_.scene.equilibria.small_motions) return mechanics::Status();
      return continuum::stability_of(figures_, figure, n_eigenvectors_of_figure, only, classes);
    };
  }

  const RunContext& context_;
  mechanics::FamilyOfFigures family_;
  continuum::BallFigures figures_;
};

/// The members and special points of the family on the companion mesh, from which the errors of the rows are estimated.
/// The errors of both meshes may have the same sign. The error of a number is therefore assumed to be twice the
/// difference between the meshes. This is a bound if the companion mesh has at least 1.5 times the error.
class Companion {
 public:
  /// `factor` is the factor of the loads for the figure at rest. The family is a further one of `run`.
  Companion(const RunContext& context, const scene::Discretization& discretization, double factor, FigureRun& run)
      : mesh_(context, discretization),
        family_(mesh_.family(factor, run)),
        round_off_(mesh_.figures().accepted_residual() + 1e-11 * gravity_to_elasticity(context.scene)) {}

  /// Appends the errors of a row with these numbers: those of the parameter, the spin, the semi-axes, the surface and
  /// the rates. The error of the parameter is 0 for an ordinary member, for which `special` is null. `of_basis` is the
  /// error of the rates that the basis of the small motions causes. If the companion mesh does not have such a figure,
  /// the other errors are at least as large as the values. The errors contain the tolerances of Newton's iteration and
  /// of the eigenvalues, because both meshes may agree to round-off. Fails if the numbers on the companion mesh cannot
  /// be computed.
  mechanics::Status append_errors(const FigureMember& member, const SpecialFigure* special,
                                  const FigureNumbers& numbers, double of_basis, std::vector<double>& row) {
    const FigureMember* other = special ? match(*special) : match(member);
    const double apart = std::abs(member.parameter - (other ? other->parameter : 0));
    FigureNumbers of_other{0, 0, Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), {}};
    if (other)
      if (auto status = mesh_.numbers(*other, of_other); !status) return status;
    constexpr double of_eigenvalues = 1e-9;
    const double largest_rate = std::abs(slowest_rates(member).back());
    row.insert(row.end(), {special ? of_difference * apart : 0,
                           of_difference * std::abs(numbers.spin - of_other.spin) + round_off_ * numbers.spin,
                           error_of(numbers.axes, of_other.axes), error_of(numbers.surface, of_other.surface),
                           of_difference * difference_of_rates(member, other ? *other : FigureMember()) + of_basis +
                               (of_eigenvalues + round_off_) * largest_rate});
    return {};
  }

 private:
  static constexpr double of_difference = 2;  ///< error over difference between the meshes

  /// The largest error of three lengths, with the tolerance of Newton's iteration.
  double error_of(const Eigen::Vector3d& lengths, const Eigen::Vector3d& others) const {
    return of_difference * (lengths - others).cwiseAbs().maxCoeff() + round_off_ * lengths.maxCoeff();
  }
  /// The member with the same parameter; null if there is none.
  const FigureMember* match(const FigureMember& member) const {
    const auto found = std::ranges::find(family_.members, member.parameter, &FigureMember::parameter);
    return found == family_.members.end() ? nullptr : &*found;
  }
  /// The special point of the same kind and class of motions whose parameter is nearest; null if there is none. A mesh
  /// separates points that a spheroid has twice. If several points have nearly this parameter, the farthest of them is
  /// taken, because one copy may be near by chance.
  const FigureMember* match(const SpecialFigure& special) const {
    constexpr double of_copies = 0.01;  // larger than the relative distance of copies
    const double here = special.member.parameter;
    const FigureMember *nearest = nullptr, *farthest_copy = nullptr;
    const auto distance = [&](const FigureMember* member) { return std::abs(member->parameter - here); };
    for (const SpecialFigure& other : family_.special) {
      const FigureMember* at = &other.member;
      if (other.kind != special.kind || other.motions.odd_in_z != special.motions.odd_in_z ||
          other.motions.m != special.motions.m)
        continue;
      if (!nearest || distance(at) < distance(nearest)) nearest = at;
      if (distance(at) <= of_copies * std::abs(here) && (!farthest_copy || distance(at) > distance(farthest_copy)))
        farthest_copy = at;
    }
    return farthest_copy ? farthest_copy : nearest;
  }

  FamilyOnMesh mesh_;
  FigureFamily family_;
  double round_off_;  ///< relative error of a figure from the tolerance of Newton's iteration
};

}  // namespace

ModelOutcome run_continuum_equilibria(const RunContext& context) {
  const scene::Scene& scene = context.scene;
  const scene::Discretization discretization = *scene::fixed_discretization(scene);
  const bool has_companion = scene.continuum.error_estimate == scene::ErrorEstimate::automatic;
  FigureRun run(context, "equilibria-continuum", continuum_figure_columns(), has_companion ? 2 : 1);
  FamilyOnMesh mesh(context, discretization);
  const FigureFamily family = mesh.family(1, run);
  const double factor = family.members.empty() ? 1 : family.members.front().parameter;
  std::optional<Companion> companion;
  if (has_companion) companion.emplace(context, scene::companion(discretization), factor, run);
  run.add(
      "elements of " + scene::describe(discretization), family,
      [](const mechanics::MotionClass& motions) { return name_of(motions, mechanics::Figure::ellipsoid); },
      [&](int index, const FigureMember& member, const SpecialFigure* special, std::vector<double>& row) {
        FigureNumbers numbers{};
        if (auto status = mesh.numbers(member, numbers); !status) return status;
        row = figure_row(index, member, special, numbers);
        if (companion) return companion->append_errors(member, special, numbers, error_of_basis(member), row);
        row.resize(row.size() + n_error_columns);
        return mechanics::Status();
      });
  if (context.interrupted() && run.goes_on())
    run.end(mechanics::Outcome::interrupted, "interrupted while the errors of equilibria were estimated");
  const continuum::FigureCounts& counts = mesh.figures().counts();
  auto& counters = run.outcome().statistics.counters;
  counters["cells"] = mesh.figures().body().space().n_cells();
  counters["unknowns"] = 3.0 * mesh.figures().body().space().n_nodes();
  counters["newton_steps"] = static_cast<double>(counts.newton);
  counters["factorizations"] = static_cast<double>(counts.factorizations);
  counters["gmres_iterations"] = static_cast<double>(counts.linear_products);
  return run.finish();
}

}  // namespace pseudorigid::app
