#include "app/models/ball_models.h"
#include "app/reduced/ball_equilibria.h"
#include "app/reduced/reduced_in_lanes.h"
#include "app/reduced/reduced_scene.h"
#include "app/reduced/static_equilibria.h"
#include "app/run/refuses_method.h"
#include "app/run/run_models.h"
#include "io/trajectory.h"
#include "materials/eigen_tensor.h"

namespace pseudorigid::app {
namespace {

/// Refuses an initial deformation that the law does not admit. Also refuses a method that cannot integrate the form of
/// the pseudo-rigid body that the scene requires (app/reduced/reduced_scene.h).
template <bool incompressible>
std::optional<scene::Refusal> refuses_body(const scene::Scene& scene) {
  const ReducedScene s = reduced_scene(scene);
  if (!materials::admits(s.law, materials::to_tensor(s.start.q)))
    return scene::Refusal{"Initial state/Deformation", materials::beyond_limit(materials::limit_of(s.law))};
  switch (form_of(s)) {
    case ReducedForm::elastic:
    case ReducedForm::general:
      return refuses_method(scene, general_body<incompressible>(s));
    case ReducedForm::diagonal:
      return refuses_method(scene, system_of<ReducedForm::diagonal, incompressible>(s));
    case ReducedForm::dissipative:
      return refuses_method(scene, system_of<ReducedForm::dissipative, incompressible>(s));
    case ReducedForm::loaded:
      return refuses_method(scene, system_of<ReducedForm::loaded, incompressible>(s));
  }
  return {};
}

std::string reduced_needed(const scene::Scene&) { return "reduced model: the pseudo-rigid body, 9 unknowns"; }

std::string reduced_skipped(const scene::Scene& scene) {
  return scene.analysis == scene::Analysis::modes
             ? "reduced model: its frequencies are known in closed form (modes.csv)"
             : "reduced model: not among Models";
}

}  // namespace

std::optional<scene::Refusal> refuses_motion(const scene::Scene& scene) {
  return scene.body.incompressible ? refuses_body<true>(scene) : refuses_body<false>(scene);
}

BallModel reduced_model() {
  using Observables = mechanics::ReducedObservables;
  return {{.name = "reduced",
           .adjective = "pseudo-rigid",
           .documentation = "The pseudo-rigid body x = QX, nine unknowns; det Q = 1 if it is incompressible.",
           .by_default = true,
           .discretized = false,
           .has_nonaffine = false,
           .has_love_numbers = true,
           .has_equilibria = true,
           .equilibria = {"equilibria",
                          "This is a family of relative equilibria of the ball (Equilibrium/Family), a row each.",
                          ball_equilibria_columns()},
           .static_equilibria = [](int n_modes) -> scene::EquilibriaTable {
             return {"equilibria",
                     "These are the equilibria at rest (Equilibrium/Family = static), the critical points of the "
                     "potential energy, a row each.",
                     static_equilibria_columns(n_modes)};
           },
           .columns = io::documented_columns<Observables>(),
           .header = [](const scene::Quantities& q) { return io::Trajectory<Observables>(q).names(); },
           .needed = reduced_needed,
           .skipped = reduced_skipped,
           .refuses = refuses_motion},
          run_reduced,
          run_reduced_in_lanes};
}

}  // namespace pseudorigid::app
