#include "app/polynomial/run_equilibria.h"

#include <fmt/format.h>

#include "app/figures/figure_families.h"
#include "app/polynomial/body_setup.h"
#include "app/polynomial/equilibrium_rows.h"
#include "scene/models.h"

namespace pseudorigid::app {
namespace {

using scene::Family;

/// Computes the family of one degree, and writes its rows and results. After an interrupt, writes the figures that were
/// found before it.
void add_degree(int degree, const RunContext& context, FigureRun& run) {
  const scene::Scene& scene = context.scene;
  const polynomial::BodySetup setup = body_setup(scene, {}, degree);
  const mechanics::FamilyOfFigures family = family_of_figures(scene, scene.equilibria.family);
  const bool is_at_rest = scene::finds_static_equilibria(scene);
  polynomial::BodyFigureFinder finder(setup, scene.body.incompressible, family,
                                      is_at_rest ? mechanics::Drive::loads : mechanics::Drive::rotation);
  const mechanics::FigureFamily found =
      is_at_rest ? finder.at_rest()
                 : finder.family(parameters_of(scene.equilibria), [&] { return context.interrupted(); });
  const EquilibriumRows rows(finder.setup(), finder.spectrum());
  run.add(
      fmt::format("degree {}", degree), found,
      [&](const mechanics::MotionClass& motions) { return name_of(motions, family.figure); },
      [&](int index, const mechanics::FigureMember& member, const mechanics::SpecialFigure* special,
          std::vector<double>& row) { return rows.row(index, member, special, row); });
}

}  // namespace

std::optional<scene::Refusal> refuses_polynomial_equilibria(const scene::Scene& scene) {
  if (!needs_own_figures(scene)) return {};
  if (auto refusal =
          refuses_family(scene, "polynomial bodies",
                         {Family::maclaurin, Family::spheroids, Family::spinning, Family::jacobi, Family::at_rest},
                         scene::names_where(scene, [](const auto& model) { return !model.has_nonaffine; })))
    return refusal;
  if (scene.analysis != scene::Analysis::equilibrium) return {};
  if (scene.polynomial.degrees.empty())
    return scene::Refusal{"Polynomial/Degree",
                          "equilibria are those of named degrees: expected whole numbers from 1 to 13, as 1, 3, 5"};
  const auto pseudo_rigid = scene::names_where(scene, [](const auto& model) { return !model.has_nonaffine; });
  if (scene::finds_static_equilibria(scene) && scene::is_fluid(scene) &&
      !loads::present(scene.loads.get<loads::SelfGravity>()))
    return scene::Refusal{"Equilibrium/Family",
                          "static for a fluid without self-gravity, for which the ball is no start, is",
                          {},
                          pseudo_rigid};
  return refuses_loads_at_rest(scene, "polynomial bodies", pseudo_rigid);
}

ModelOutcome run_polynomial_equilibria(const RunContext& context) {
  FigureRun run(context, "equilibria-polynomial", polynomial_equilibria_columns());
  for (const int degree : context.scene.polynomial.degrees) {
    add_degree(degree, context, run);
    if (!run.goes_on()) break;
  }
  return run.finish();
}

}  // namespace pseudorigid::app
