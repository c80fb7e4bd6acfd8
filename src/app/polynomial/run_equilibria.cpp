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
  polynomial::RotationFinder finder(setup, scene.body.incompressible, family);
  const mechanics::FigureFamily found =
      finder.family(parameters_of(scene.equilibria), [&] { return context.interrupted(); });
  const EquilibriumRows rows(setup, scene.body.incompressible, finder.spectrum());
  run.add(
      fmt::format("degree {}", degree), found,
      [&](const mechanics::MotionClass& motions) { return name_of(motions, family.figure); },
      [&](int index, const mechanics::FigureMember& member, const mechanics::SpecialFigure* special,
          std::vector<double>& row) { return rows.row(index, member, special, row); });
}

}  // namespace

std::optional<scene::Refusal> refuses_polynomial_equilibria(const scene::Scene& scene) {
  if (!needs_own_figures(scene)) return {};
  if (auto refusal = refuses_family(scene, "polynomial bodies",
                                    {Family::maclaurin, Family::spheroids, Family::spinning, Family::jacobi},
                                    scene::names_where(scene, [](const auto& model) { return !model.has_nonaffine; })))
    return refusal;
  if (scene.analysis == scene::Analysis::equilibrium && scene.polynomial.degrees.empty())
    return scene::Refusal{"Polynomial/Degree",
                          "equilibria are those of named degrees: expected whole numbers from 1 to 13, as 1, 3, 5"};
  return {};
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
