#include "scene/analyses_of_ball.h"

#include <algorithm>
#include <string>
#include <vector>

#include "entries/matrix3.h"
#include "materials/rest_moduli.h"
#include "scene/models.h"
#include "scene/scales.h"

namespace pseudorigid::scene {
namespace {

template <class Load>
std::string first_entry(const Load& load) {
  std::string path;
  const auto note = [&](const auto&, const auto&, const About& about) {
    if (path.empty()) path = about.path;
  };
  Load::visit_entries(load, note);
  return path;
}

/// Refuses the first load that acts and for which `is_refused` holds.
template <class Predicate>
std::optional<Refusal> refuses_load(const Scene& scene, Predicate&& is_refused) {
  std::optional<Refusal> refusal;
  scene.loads.for_each([&]<class Load>(const Load& load) {
    if (!refusal && loads::present(load) && is_refused(load))
      refusal = Refusal{first_entry(load), std::string(Load::no_equilibria)};
  });
  return refusal;
}

/// Relative equilibria are known for the ball under potentials that depend on its shape alone.
std::optional<Refusal> refuses_relative_equilibrium(const Scene& scene) {
  if (scene.body.inertia || scene.body.semi_axes != std::vector<double>{1, 1, 1})
    return Refusal{"Body/Semi-axes",
                   "relative equilibria are offered for a ball",
                   {{{"Body/Semi-axes", "1, 1, 1"}, {"Body/Inertia", "auto"}}}};
  if (auto refusal = refuses_load(scene, []<class Load>(const Load&) { return !Load::no_equilibria.empty(); })) {
    if (scene.analysis == Analysis::equilibrium) refusal->remedies = {{{"Equilibrium/Family", "static"}}};
    return refusal;
  }
  if (is_fluid(scene) && !scene.body.incompressible)
    return Refusal{"Material/Law",
                   "none has no relative equilibrium if Incompressible = false: nothing resists gravity"};
  if (is_fluid(scene) && !loads::present(scene.loads.get<loads::SelfGravity>()))
    return Refusal{"Gravity/Constant", "a fluid without gravity has no relative equilibrium; give it a constant > 0"};
  return {};
}

/// A body can be at rest under every load that has a potential; dissipation changes the rates alone.
std::optional<Refusal> refuses_static_equilibria(const Scene& scene) {
  const auto finds = [](const ModelDescription& model) { return model.static_equilibria != nullptr; };
  if (!std::ranges::all_of(models_of(scene), [&](const auto* model) { return finds(*model); }))
    return Refusal{"Equilibrium/Family", "static is", {}, names_where(scene, finds)};
  if (auto refusal = refuses_load(scene, []<class Load>(const Load&) {
        if constexpr (requires { Load::has_static_equilibria; }) return !Load::has_static_equilibria;
        return loads::DependsOnTime<Load>;
      }))
    return refusal;
  const loads::Forcing forcing = loads::constant_forcing(scene.loads);
  const bool shaped = forcing.gravity_constant != 0 || !forcing.quadratic.isZero(0) ||
                      !forcing.nominal_traction.isZero(0) || (forcing.pressure != 0 && !scene.body.incompressible);
  if (is_fluid(scene) && !shaped)
    return Refusal{"Material/Law", "a fluid on which nothing acts rests in every shape; give it gravity or a load"};
  return {};
}

std::optional<Refusal> refuses_equilibria(const Scene& scene) {
  if (!std::ranges::all_of(models_of(scene), &ModelDescription::has_equilibria))
    return Refusal{"Analysis", "equilibrium is", {}, names_where(scene, &ModelDescription::has_equilibria)};
  return finds_static_equilibria(scene) ? refuses_static_equilibria(scene) : refuses_relative_equilibrium(scene);
}

/// Modes are those of small motions about rest, and take the symmetry of the ball themselves.
std::optional<Refusal> refuses_modes(const Scene& scene) {
  if (has_mesh_file(scene))
    return Refusal{"Continuum/Mesh", "modes are those of the ball", {{{"Continuum/Mesh", "builtin"}}}};
  if (std::ranges::none_of(models_of(scene), &ModelDescription::has_modes))
    return Refusal{"Analysis", "modes are", {}, names_where(scene, &ModelDescription::has_modes)};
  const auto& state = scene.initial_state;
  if (state.equilibrium != Family::none)
    return Refusal{"Initial state/Equilibrium", "modes are small motions about rest; leave the entry out"};
  if (state.deformation != identity3)
    return Refusal{"Initial state/Deformation", "modes are small motions about rest, Q0 = 1; leave the entry out"};
  if (largest_entry(state.velocity) != 0)
    return Refusal{"Initial state/Velocity", "modes are small motions about rest; leave the entry out"};
  if (!scene.body.incompressible && materials::pressure_at_rest(law_of(scene)) != 0)
    return Refusal{"Material/Law", scene.material.law +
                                       " is stressed at rest, so a compressible ball does not stay "
                                       "there and has no modes about rest"};
  const bool centered = state.center == std::vector<double>{0, 0, 0} && state.center_velocity == state.center;
  loads::Forcing others = loads::constant_forcing(scene.loads);
  others.gravity_constant = 0;
  if (others.present() || loads::depend_on_time(scene.loads) || !centered)
    return Refusal{"Analysis",
                   "modes are those of the ball alone, with self-gravity or without; leave out other loads, "
                   "viscosity, drag and motions of the centre"};
  if (scene.continuum.symmetry != Symmetry::automatic && scene.continuum.symmetry != Symmetry::octant)
    return Refusal{"Continuum/Symmetry",
                   "modes are computed on one octant, with every choice of signs at its planes",
                   {{{"Continuum/Symmetry", "auto"}}}};
  if (is_fluid(scene))
    return Refusal{"Material/Law",
                   "modes are those of an elastic ball: a fluid has infinitely many motions of frequency 0"};
  return {};
}

}  // namespace

std::optional<Refusal> refuses_analysis_of_ball(const Scene& scene) {
  if (scene.analysis == Analysis::equilibrium)
    if (auto refusal = refuses_equilibria(scene)) return refusal;
  // Whatever is looked for, the initial state may be a member of a family.
  if (scene.initial_state.equilibrium != Family::none)
    if (auto refusal = refuses_relative_equilibrium(scene)) return refusal;
  return scene.analysis == Analysis::modes ? refuses_modes(scene) : std::nullopt;
}

}  // namespace pseudorigid::scene
