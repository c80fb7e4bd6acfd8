#include "app/polynomial/run_equilibria.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <memory>

#include "app/figures/figure_families.h"
#include "app/polynomial/body_setup.h"
#include "app/polynomial/equilibrium_rows.h"
#include "polynomial/body_gravity.h"
#include "scene/models.h"

namespace pseudorigid::app {
namespace {

using scene::Family;

/// Warns if the quadrature of gravity of a fluid has a large error. Nearly round figures have such an error, because it
/// is relative to the centrifugal force. The fluid has small motions without stiffness, whose rates the error changes.
/// The measure of the error is the force on the ball.
void warn_of_quadrature(const polynomial::BodySetup& setup, const mechanics::FigureFamily& family,
                        const RunContext& context) {
  constexpr double large = 3e-4;  // errors from 4e-4 on gave Maclaurin's family false special points
  if (!scene::is_fluid(context.scene) || setup.degree == 1) return;
  const auto space = std::make_shared<const polynomial::PolynomialSpace>(setup.degree, std::array{true, true, true});
  const polynomial::BodyGravity gravity(setup.loads.get<loads::SelfGravity>().constant, space, setup.n_gravity_points);
  const mechanics::FigureMember* slowest = nullptr;
  for (const mechanics::FigureMember& member : family.members)
    if (member.figure.drive > 0 && (!slowest || member.figure.drive < slowest->figure.drive)) slowest = &member;
  if (!slowest) return;
  const double centrifugal = slowest->figure.drive * std::sqrt(space->inertia()[0]);
  if (gravity.error_of_ball() > large * centrifugal)
    context.log->warn(
        "degree {}: at {} = {:.6g} the quadrature of gravity gives the ball a force of {:.1g} of the centrifugal "
        "force. "
        "The forces are corrected for it, but not their derivatives. Special points of slow motions may be wrong "
        "there; "
        "raise Polynomial/Gravity points",
        setup.degree, parameter_name(context.scene.equilibria.family), slowest->parameter,
        gravity.error_of_ball() / centrifugal);
}

/// Computes the family of one degree, and writes its rows and results. After an interrupt, writes the figures that were
/// found before it.
void add_degree(int degree, const RunContext& context, FigureRun& run) {
  const scene::Scene& scene = context.scene;
  const polynomial::BodySetup setup = body_setup(scene, {}, degree);
  const mechanics::FamilyOfFigures family = family_of_figures(scene, scene.equilibria.family);
  const bool is_at_rest = scene::finds_static_equilibria(scene);
  polynomial::BodyFigureFinder finder(setup, scene.body.incompressible, family,
                                      is_at_rest ? mechanics::Drive::loads : mechanics::Drive::rotation,
                                      scene.equilibria.small_motions);
  const mechanics::FigureFamily found =
      is_at_rest ? finder.at_rest()
                 : run.next_family([&](const auto&... arguments) { return finder.family(arguments...); });
  if (!is_at_rest) warn_of_quadrature(setup, found, context);
  const EquilibriumRows rows(finder.setup(), finder.spectrum());
  run.add(
      fmt::format("degree {}", degree), found,
      [&](const mechanics::MotionClass& motions) { return name_of(motions, family.figure); },
      [&](int index, const mechanics::FigureMember& member, const mechanics::SpecialFigure* special,
          std::vector<double>& row) { return rows.row(index, member, special, row); });
}

/// Refuses bodies whose figures at rest, or their stability, polynomial bodies do not have. Rotations of the undeformed
/// body are symmetries of a ball alone. A fluid needs gravity, which holds the ball from which the loads rise. Under a
/// dead traction its figure is not an ellipsoid.
std::optional<scene::Refusal> refuses_body_at_rest(const scene::Scene& scene) {
  if (scene.body.semi_axes != std::vector<double>{1, 1, 1})
    return scene::Refusal{
        "Body/Semi-axes", "static for a reference body that is not a ball is", {}, affine_models(scene)};
  if (!scene::is_fluid(scene)) return {};
  if (!loads::constant_forcing(scene.loads).nominal_traction.isZero(0))
    return scene::Refusal{"Loads/Nominal traction", "static for a fluid under a traction is", {}, affine_models(scene)};
  if (!loads::present(scene.loads.get<loads::SelfGravity>()))
    return scene::Refusal{"Equilibrium/Family",
                          "static for a fluid without self-gravity, for which the ball is no start, is",
                          {},
                          affine_models(scene)};
  return {};
}

}  // namespace

std::optional<scene::Refusal> refuses_polynomial_equilibria(const scene::Scene& scene) {
  if (!needs_own_figures(scene)) return {};
  if (auto refusal =
          refuses_family(scene, "polynomial bodies",
                         {Family::maclaurin, Family::spheroids, Family::spinning, Family::jacobi, Family::at_rest}))
    return refusal;
  if (scene.analysis != scene::Analysis::equilibrium) return {};
  if (scene.polynomial.degrees.empty())
    return scene::Refusal{"Polynomial/Degree",
                          "equilibria are those of named degrees: expected whole numbers from 1 to 13, as 1, 3, 5"};
  if (scene::finds_static_equilibria(scene))
    if (auto refusal = refuses_body_at_rest(scene)) return refusal;
  return refuses_loads_at_rest(scene, "polynomial bodies");
}

ModelOutcome run_polynomial_equilibria(const RunContext& context) {
  FigureRun run(context, "equilibria-polynomial", polynomial_equilibria_columns(),
                context.scene.polynomial.degrees.size());
  for (const int degree : context.scene.polynomial.degrees) {
    if (context.interrupted() && run.goes_on())
      run.end(mechanics::Outcome::interrupted, fmt::format("equilibria interrupted before degree {}", degree));
    if (!run.goes_on()) break;
    add_degree(degree, context, run);
  }
  return run.finish();
}

}  // namespace pseudorigid::app
